#pragma once
/// A symmetric matrix in single precision, lower triangle by rows, and its product with a vector: half the bytes of a
/// full matrix, and they are what the product waits for.

#include <cstddef>
#include <vector>

namespace pseudorigid::continuum {

class PackedSymmetric {
 public:
  PackedSymmetric() = default;
  /// Of the lower triangle of `matrix`, n × n by columns.
  PackedSymmetric(const double* matrix, std::size_t n);

  /// y = A x
  void multiply(const double* x, double* y) const;
  std::size_t memory() const { return entries_.size() * sizeof(float); }

 private:
  std::size_t n_ = 0;
  std::vector<float> entries_;
  mutable std::vector<float> x_, y_;
};

}  // namespace pseudorigid::continuum
