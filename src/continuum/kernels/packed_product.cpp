#include "continuum/kernels/packed_product.h"

namespace pseudorigid::continuum {
namespace {

/// Adds Σ_r x_of_rows[r] rows[r] to y, and sets dots[r] to the scalar product of rows[r] with x. The rows, x and y have
/// n numbers.
template <int n_rows>
void add_rows(const float* const* rows, std::size_t n, const float* x, const float* x_of_rows, float* y, float* dots) {
  for (int r = 0; r < n_rows; ++r) dots[r] = 0;
  float sum[n_rows][16] = {};
  std::size_t j = 0;
  for (; j + 16 <= n; j += 16)
    for (int l = 0; l < 16; ++l) {
      float s = y[j + l];
      for (int r = 0; r < n_rows; ++r) {
        s += rows[r][j + l] * x_of_rows[r];
        sum[r][l] += rows[r][j + l] * x[j + l];
      }
      y[j + l] = s;
    }
  for (; j < n; ++j)
    for (int r = 0; r < n_rows; ++r) {
      y[j] += rows[r][j] * x_of_rows[r];
      dots[r] += rows[r][j] * x[j];
    }
  for (int r = 0; r < n_rows; ++r)
    for (const float s : sum[r]) dots[r] += s;
}

}  // namespace

void multiply_packed(const float* entries, std::size_t n, const float* x, float* y) {
  for (std::size_t i = 0; i < n; ++i) y[i] = 0;
  const float* row = entries;
  std::size_t i = 0;
  constexpr int n_rows = 4;
  for (; i + n_rows <= n; i += n_rows) {
    const float* rows[n_rows];
    for (int r = 0; r < n_rows; ++r, row += i + r) rows[r] = row;
    float dots[n_rows];
    add_rows<n_rows>(rows, i, x, &x[i], y, dots);
    for (int r = 0; r < n_rows; ++r) {
      y[i + r] += dots[r] + rows[r][i + r] * x[i + r];
      for (int c = 0; c < r; ++c) {
        y[i + c] += rows[r][i + c] * x[i + r];
        y[i + r] += rows[r][i + c] * x[i + c];
      }
    }
  }
  for (; i < n; ++i, row += i) {
    float dot;
    add_rows<1>(&row, i, x, &x[i], y, &dot);
    y[i] += dot + row[i] * x[i];
  }
}

}  // namespace pseudorigid::continuum
