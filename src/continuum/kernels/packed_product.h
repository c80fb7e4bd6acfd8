#pragma once
/// The product with a symmetric matrix in single precision, whose lower triangle is stored by rows. This function is a
/// kernel (kernel_table.h).

#include <cstddef>

namespace pseudorigid::continuum {

/// y ← A x
void multiply_packed(const float* entries, std::size_t n, const float* x, float* y);

}  // namespace pseudorigid::continuum
