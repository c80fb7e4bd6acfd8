#include "continuum/constraint/packed_symmetric.h"

#include <algorithm>

#include "continuum/kernels/kernel_table.h"

namespace pseudorigid::continuum {

PackedSymmetric::PackedSymmetric(const double* matrix, std::size_t n) : n_(n), x_(n), y_(n) {
  entries_.reserve(n * (n + 1) / 2);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j <= i; ++j) entries_.push_back(static_cast<float>(matrix[j * n + i]));
}

void PackedSymmetric::multiply(const double* x, double* y) const {
  std::copy(x, x + n_, x_.begin());
  chosen_kernels().table->multiply_packed(entries_.data(), n_, x_.data(), y_.data());
  std::copy(y_.begin(), y_.end(), y);
}

}  // namespace pseudorigid::continuum
