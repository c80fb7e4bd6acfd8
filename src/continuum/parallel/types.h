#pragma once
/// Vectors of the finite-element ball, with the operations that the mechanics core requires.

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "mechanics/core/vector_space.h"

namespace pseudorigid::continuum {

/// A vector whose entries are distributed over the ranks. Positions, velocities and forces have the entry 3·node +
/// component. Multipliers have the entry n_pressure·cell + function.
class Vector : public dealii::LinearAlgebra::distributed::Vector<double> {
  using Base = dealii::LinearAlgebra::distributed::Vector<double>;

 public:
  using Base::Base;
  using Base::operator=;

  /// The internal metrics of viscoelastic branches at the Gauss points of the own cells (kernels/cell_branches.h), if
  /// the vector is a position. A copy of the position has a copy of the metrics. Sums and multiples of vectors do not
  /// change the metrics.
  std::vector<double> metrics;
};

/// Σ x_i y_i, computed as eight independent sums, which the processor can add in parallel.
inline double dot(const double* x, const double* y, std::size_t n) {
  constexpr std::size_t n_sums = 8;
  double sums[n_sums] = {};
  std::size_t i = 0;
  for (; i + n_sums <= n; i += n_sums)
    for (std::size_t k = 0; k < n_sums; ++k) sums[k] += x[i + k] * y[i + k];
  for (; i < n; ++i) sums[0] += x[i] * y[i];
  double sum = 0;
  for (const double of_lane : sums) sum += of_lane;
  return sum;
}

/// x_i ← d_i x_i for the entries of this rank. The function uses a loop of its own, because the threads of deal.II are
/// slower for a small vector.
inline void scale_by(const Vector& d, Vector& x) {
  const double* factors = d.begin();
  double* values = x.begin();
  for (std::size_t i = 0, n = x.locally_owned_size(); i < n; ++i) values[i] *= factors[i];
}

}  // namespace pseudorigid::continuum

template <>
struct pseudorigid::mechanics::VectorSpace<pseudorigid::continuum::Vector> {
  using Vector = pseudorigid::continuum::Vector;
  static constexpr bool dense = false;
  /// The integrators do not use compensated sums for this type. Runs of the ball have too few steps for such sums to be
  /// useful.
  static constexpr bool compensated = false;
  static void axpy(double a, const Vector& x, Vector& y) {
    const double* from = x.begin();
    double* to = y.begin();
    for (std::size_t i = 0, n = y.locally_owned_size(); i < n; ++i) to[i] += a * from[i];
  }
  /// x ← a x. The factor a = 0 sets x to 0, even if x contains NaN.
  static void scale(double a, Vector& x) {
    if (a == 0)
      x = 0.0;
    else
      for (double& value : x) value *= a;
  }
  /// The largest |x_i| on all ranks. NaN counts as infinite, so that the caller detects it; linfty_norm of deal.II
  /// would ignore NaN. Collective.
  static double max_norm(const Vector& x) {
    double norm = 0;
    for (const double value : x)
      if (!(std::abs(value) <= norm)) norm = std::isnan(value) ? HUGE_VAL : std::abs(value);
    return dealii::Utilities::MPI::max(norm, x.get_mpi_communicator());
  }
  /// Σ x_i y_i over the entries of all ranks. Collective.
  static double dot(const Vector& x, const Vector& y) { return x * y; }
  /// Sets products_k = x_k·y. Collective.
  static void dots(std::span<const Vector* const> x, const Vector& y, std::span<double> products) {
    std::ranges::fill(products, 0.0);
    in_pieces(y.locally_owned_size(), [&](std::size_t first, std::size_t n) {
      for (std::size_t k = 0; k < x.size(); ++k)
        products[k] += pseudorigid::continuum::dot(x[k]->begin() + first, y.begin() + first, n);
    });
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(products.data(), products.size()),
                                y.get_mpi_communicator(), dealii::ArrayView<double>(products.data(), products.size()));
  }
  /// y ← s (y + Σ a_k x_k)
  static void combine(double s, Vector& y, std::span<const double> a, std::span<const Vector* const> x) {
    in_pieces(y.locally_owned_size(), [&](std::size_t first, std::size_t n) {
      double* to = y.begin() + first;
      for (std::size_t k = 0; k < x.size(); ++k) {
        const double* from = x[k]->begin() + first;
        for (std::size_t i = 0; i < n; ++i) to[i] += a[k] * from[i];
      }
      for (std::size_t i = 0; i < n; ++i) to[i] *= s;
    });
  }
  static std::span<double> local_values(Vector& x) { return {x.begin(), x.locally_owned_size()}; }

 private:
  /// Calls use(first, n) for short pieces of a vector. One piece remains in the first-level cache while pieces of many
  /// other vectors are read.
  template <class Use>
  static void in_pieces(std::size_t size, const Use& use) {
    constexpr std::size_t piece = 1024;
    for (std::size_t first = 0; first < size; first += piece) use(first, std::min(piece, size - first));
  }
};
