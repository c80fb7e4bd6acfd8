#pragma once
/// Products of small dense matrices with vectors, in single precision. Compared with double precision, the matrices
/// need half the memory, and a SIMD vector has twice as many numbers. The matrices belong to cells
/// (constraint/two_level_gram.h) or are symmetric (constraint/symmetric_matrix.h). A matrix is stored by columns, and
/// the number of rows is a multiple of `rows_together`. These functions are kernels (kernel_table.h).

#include <cstddef>

namespace pseudorigid::continuum {

/// The inner loops of the products treat this number of rows together, one row in each lane of a SIMD vector.
inline constexpr std::size_t rows_together = 8;

/// y ← y + A x
void add_product(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y);
/// y ← Aᵀ x
void multiply_transposed(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y);

}  // namespace pseudorigid::continuum
