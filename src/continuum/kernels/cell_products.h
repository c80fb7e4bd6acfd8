#pragma once
/// Products with small dense matrices, of the cells and of a small body's inverse, in single precision: half the bytes,
/// and twice the numbers in a vector. A matrix lies in memory by columns; the number of its rows is a multiple of
/// `rows_together`. It is one of the kernels (kernel_table.h).

#include <cstddef>

namespace pseudorigid::continuum {

inline constexpr std::size_t rows_together = 8;

/// y ← y + A x
void add_product(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y);
/// y ← Aᵀ x
void multiply_transposed(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y);

}  // namespace pseudorigid::continuum
