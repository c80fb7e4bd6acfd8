#include "continuum/kernels/cell_products.h"

#include <algorithm>

namespace pseudorigid::continuum {
namespace {

constexpr std::size_t most_rows = 64;  // the sums of 64 rows fit into the vector registers

/// y ← y + A x for a matrix A with n rows and n_columns columns. In memory, consecutive columns of A are `distance`
/// numbers apart.
template <std::size_t n>
void add_rows(const float* A, std::size_t distance, std::size_t n_columns, const float* x, float* y) {
  float sums[n];
  for (std::size_t l = 0; l < n; ++l) sums[l] = y[l];
  for (std::size_t c = 0; c < n_columns; ++c)
    for (std::size_t l = 0; l < n; ++l) sums[l] += A[c * distance + l] * x[c];
  for (std::size_t l = 0; l < n; ++l) y[l] = sums[l];
}

/// Calls add_rows<n_rows> for a number n_rows that is known only at run time. The number must be a multiple of
/// rows_together and at most n. For 0, the function does nothing.
template <std::size_t n>
void add_up_to(std::size_t n_rows, const float* A, std::size_t distance, std::size_t n_columns, const float* x,
               float* y) {
  if constexpr (n > 0) {
    if (n_rows == n) return add_rows<n>(A, distance, n_columns, x, y);
    add_up_to<n - rows_together>(n_rows, A, distance, n_columns, x, y);
  }
}

/// Sets y to the scalar products of x with the first n columns of A. A column has n_rows numbers.
template <std::size_t n>
void multiply_columns(const float* A, std::size_t n_rows, const float* x, float* y) {
  float sums[n][rows_together] = {};
  for (std::size_t r = 0; r < n_rows; r += rows_together)
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t l = 0; l < rows_together; ++l) sums[c][l] += A[c * n_rows + r + l] * x[r + l];
  for (std::size_t c = 0; c < n; ++c) {
    const float* s = sums[c];
    y[c] = ((s[0] + s[4]) + (s[1] + s[5])) + ((s[2] + s[6]) + (s[3] + s[7]));
  }
}

}  // namespace

void add_product(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y) {
  for (std::size_t r = 0; r < n_rows; r += most_rows)
    add_up_to<most_rows>(std::min(most_rows, n_rows - r), A + r, n_rows, n_columns, x, y + r);
}

void multiply_transposed(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y) {
  constexpr std::size_t together = 4;
  std::size_t c = 0;
  for (; c + together <= n_columns; c += together) multiply_columns<together>(A + c * n_rows, n_rows, x, y + c);
  for (; c < n_columns; ++c) multiply_columns<1>(A + c * n_rows, n_rows, x, y + c);
}

}  // namespace pseudorigid::continuum
