#pragma once
/// Rank and number of processes under mpirun or srun, from the environment variables of the launchers. A process that
/// does not need MPI does not start it.
///
/// Open MPI's mpirun sets OMPI_*, that of MPICH and `srun --mpi=pmi2` PMI_*. PMIx alone (`srun --mpi=pmix`) tells the
/// rank and not the number, which MPI itself must say. SLURM_PROCID is not a rank: it is set in batch scripts and for
/// `srun --mpi=none` too, whose processes are independent. Each of those is a run of its own, and the lock of the
/// results directory keeps them apart.

#include <cstdlib>
#include <initializer_list>

namespace pseudorigid::app {

struct Launch {
  static constexpr int unknown = 0;
  int rank = 0;
  int n_ranks = 1;       ///< or unknown
  int n_ranks_here = 1;  ///< number of ranks on this machine; 1 if the launcher does not tell

  Launch() {
    for (const char* name : {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"})
      if (const char* n = std::getenv(name)) n_ranks_here = std::atoi(n);
    constexpr const char* variables[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, {"PMI_RANK", "PMI_SIZE"}};
    for (const auto& [rank_name, size_name] : variables)
      if (const char* r = std::getenv(rank_name))
        if (const char* n = std::getenv(size_name)) {
          rank = std::atoi(r);
          n_ranks = std::atoi(n);
          return;
        }
    if (const char* r = std::getenv("PMIX_RANK")) {
      rank = std::atoi(r);
      n_ranks = unknown;
    }
  }
};

}  // namespace pseudorigid::app
