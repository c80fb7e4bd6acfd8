#pragma once
/// Vectors of the finite-element ball and what the mechanics core asks of them.

#include <deal.II/lac/la_parallel_vector.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

#include "mechanics/core/vector_space.h"

namespace pseudorigid::continuum {

/// Positions, velocities, forces: entry 3·node + component. Multipliers: entry n_pressure·cell + function.
using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

/// x_i ← d_i x_i for the entries that this rank owns. (A loop: what deal.II does to share it among threads takes longer
/// than a small vector.)
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
  /// Runs of the ball are short enough, and another vector to read and write would cost more than it gives.
  static constexpr bool compensated = false;
  static void axpy(double a, const Vector& x, Vector& y) {
    const double* from = x.begin();
    double* to = y.begin();
    for (std::size_t i = 0, n = y.locally_owned_size(); i < n; ++i) to[i] += a * from[i];
  }
  /// A scale of 0 clears, whatever the old content.
  static void scale(double a, Vector& x) {
    if (a == 0)
      x = 0.0;
    else
      x *= a;
  }
  /// NaN counts as infinite (linfty_norm ignores it).
  static double max_norm(const Vector& x) {
    double norm = 0;
    for (const double value : x)
      if (!(std::abs(value) <= norm)) norm = std::isnan(value) ? HUGE_VAL : std::abs(value);
    return dealii::Utilities::MPI::max(norm, x.get_mpi_communicator());
  }
  static double dot(const Vector& x, const Vector& y) { return x * y; }
  /// products_k = x_k·y
  static void dots(std::span<const Vector* const> x, const Vector& y, std::span<double> products) {
    const std::size_t n = y.locally_owned_size();
    for (std::size_t k = 0; k < x.size(); ++k)
      products[k] = std::inner_product(y.begin(), y.begin() + n, x[k]->begin(), 0.0);
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(products.data(), products.size()),
                                y.get_mpi_communicator(), dealii::ArrayView<double>(products.data(), products.size()));
  }
  static std::span<double> local_values(Vector& x) { return {x.begin(), x.locally_owned_size()}; }
};
