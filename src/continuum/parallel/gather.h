#pragma once
/// A value of every rank, on the first one.

#include <vector>

#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {

/// Collective; empty on the other ranks.
template <class T>
std::vector<T> gather(MPI_Comm communicator, const T& value) {
  if (n_ranks(communicator) == 1) return {value};
  return dealii::Utilities::MPI::gather(communicator, value);
}

}  // namespace pseudorigid::continuum
