#pragma once
/// The ranks among which an analysis of the finite-element ball distributes the parity sectors.

#include "app/run/run_context.h"
#include "continuum/parallel/sector_ranks.h"

namespace pseudorigid::app {

inline continuum::SectorRanks sector_ranks(const RunContext& context) {
  return {context.ranks->size() > 1 ? MPI_COMM_WORLD : MPI_COMM_SELF};
}

}  // namespace pseudorigid::app
