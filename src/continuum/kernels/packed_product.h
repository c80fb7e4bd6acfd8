#pragma once
/// The product with a symmetric matrix in single precision, of which the lower triangle lies in memory by rows. It is
/// one of the kernels (kernel_table.h).

#include <cstddef>

namespace pseudorigid::continuum {

/// y ← A x
void multiply_packed(const float* entries, std::size_t n, const float* x, float* y);

}  // namespace pseudorigid::continuum
