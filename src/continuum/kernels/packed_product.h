#pragma once
/// The product of a vector with a symmetric matrix A in single precision. This function is a kernel (kernel_table.h).

#include <cstddef>

namespace pseudorigid::continuum {

/// y ← A x. `entries` are the rows of the lower triangle of the n × n matrix A, one after the other.
void multiply_packed(const float* entries, std::size_t n, const float* x, float* y);

}  // namespace pseudorigid::continuum
