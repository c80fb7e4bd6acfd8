#pragma once
/// Ranks of a communicator, and sums over them. In a process that has not started MPI there is one rank.

#include <deal.II/base/mpi.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

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

/// The least over the ranks, a NaN counting as −∞.
inline double least_over_ranks(double value, MPI_Comm communicator) {
  return dealii::Utilities::MPI::min(std::isnan(value) ? -std::numeric_limits<double>::infinity() : value,
                                     communicator);
}

}  // namespace pseudorigid::continuum
