#pragma once
/// Number of ranks of a communicator, number of this rank, and sums and minima over the ranks. Sums and minima are
/// collective, and every rank has the result. If the process has not started MPI, the number of ranks is 1 and this
/// rank is 0.

#include <deal.II/base/mpi.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "continuum/parallel/least_place.h"

namespace pseudorigid::continuum {

inline unsigned int n_ranks(MPI_Comm communicator) {
  return dealii::Utilities::MPI::job_supports_mpi() ? dealii::Utilities::MPI::n_mpi_processes(communicator) : 1;
}

inline unsigned int this_rank(MPI_Comm communicator) {
  return dealii::Utilities::MPI::job_supports_mpi() ? dealii::Utilities::MPI::this_mpi_process(communicator) : 0;
}

inline double sum_over_ranks(double value, MPI_Comm communicator) {
  return dealii::Utilities::MPI::sum(value, communicator);
}

template <int rows, int columns>
Eigen::Matrix<double, rows, columns> sum_over_ranks(const Eigen::Matrix<double, rows, columns>& matrix,
                                                    MPI_Comm communicator) {
  Eigen::Matrix<double, rows, columns> sum;
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(matrix.data(), rows * columns), communicator,
                              dealii::ArrayView<double>(sum.data(), rows * columns));
  return sum;
}

template <std::size_t n>
std::array<double, n> sum_over_ranks(const std::array<double, n>& values, MPI_Comm communicator) {
  std::array<double, n> sum;
  dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(values.data(), n), communicator,
                              dealii::ArrayView<double>(sum.data(), n));
  return sum;
}

/// Replaces each value by its sum over the ranks.
inline void add_over_ranks(std::span<double> values, MPI_Comm communicator) {
  if (n_ranks(communicator) > 1)
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, communicator);
}

/// The least value over the ranks. If a rank has NaN, the result is −∞, so that a test for a positive value fails.
inline double least_over_ranks(double value, MPI_Comm communicator) {
  return dealii::Utilities::MPI::min(std::isnan(value) ? -std::numeric_limits<double>::infinity() : value,
                                     communicator);
}

/// The least value over the ranks with its place, by the rules of LeastPlace.
inline LeastPlace least_over_ranks(const LeastPlace& own, MPI_Comm communicator) {
  const std::array<double, 4> entry{own.value, own.where[0], own.where[1], own.where[2]};
  std::vector<std::array<double, 4>> entries(n_ranks(communicator), entry);
  if (entries.size() > 1)
    MPI_Allgather(entry.data(), entry.size(), MPI_DOUBLE, entries.data(), entry.size(), MPI_DOUBLE, communicator);
  LeastPlace least;
  for (const auto& [value, x, y, z] : entries) least.take(value, {x, y, z});
  return least;
}

}  // namespace pseudorigid::continuum
