#pragma once
/// A symmetric matrix in single precision and its product with a vector. A large matrix is stored as its lower triangle
/// by rows, which halves the memory. The time of its product is mainly the time to read this memory. A small matrix is
/// stored entirely, by columns, because its product then needs no sums across the lanes of a SIMD vector.

#include <cstddef>
#include <vector>

namespace pseudorigid::continuum {

class SymmetricMatrix {
 public:
  SymmetricMatrix() = default;
  /// Uses the lower triangle of `matrix`, an n × n matrix stored by columns.
  SymmetricMatrix(const double* matrix, std::size_t n);

  /// y = A x with this matrix A. x and y have n numbers in double precision. The product is computed in single
  /// precision.
  void multiply(const double* x, double* y) const;
  std::size_t memory() const { return entries_.size() * sizeof(float); }

  /// Largest number of rows of a matrix that is stored entirely. In measurements with 80 rows, a product took 0.14 μs
  /// for an entire matrix, and 0.75 μs for a triangle. With 512 rows, the times were 13 μs and 15 μs.
  static constexpr std::size_t n_whole = 512;

 private:
  bool whole() const { return n_ <= n_whole; }

  std::size_t n_ = 0, n_rows_ = 0;  // n_rows_: n, rounded up to a multiple of rows_together (kernels/cell_products.h);
                                    // the added rows are zero
  std::vector<float> entries_;
  mutable std::vector<float> x_, y_;
};

}  // namespace pseudorigid::continuum
