#include "continuum/constraint/symmetric_matrix.h"

#include <algorithm>

#include "continuum/kernels/cell_products.h"
#include "continuum/kernels/kernel_table.h"

namespace pseudorigid::continuum {

SymmetricMatrix::SymmetricMatrix(const double* matrix, std::size_t n)
    : n_(n), n_rows_((n + rows_together - 1) / rows_together * rows_together), x_(n), y_(n_rows_) {
  if (whole()) {
    entries_.assign(n_rows_ * n, 0);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = j; i < n; ++i)
        entries_[j * n_rows_ + i] = entries_[i * n_rows_ + j] = static_cast<float>(matrix[j * n + i]);
  } else {
    entries_.reserve(n * (n + 1) / 2);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) entries_.push_back(static_cast<float>(matrix[j * n + i]));
  }
}

void SymmetricMatrix::multiply(const double* x, double* y) const {
  std::copy(x, x + n_, x_.begin());
  const KernelTable& products = *chosen_kernels().table;
  if (whole()) {
    std::ranges::fill(y_, 0.0f);
    products.add_product(entries_.data(), n_rows_, n_, x_.data(), y_.data());
  } else {
    products.multiply_packed(entries_.data(), n_, x_.data(), y_.data());
  }
  std::copy_n(y_.begin(), n_, y);
}

}  // namespace pseudorigid::continuum
