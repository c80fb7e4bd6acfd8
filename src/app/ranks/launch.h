#pragma once
/// Rank and number of processes under mpirun or srun. The environment variables of the launcher give them, so that a
/// process that does not need MPI need not start MPI.
///
/// Open MPI's mpirun sets OMPI_*. MPICH's mpirun and `srun --mpi=pmi2` set PMI_*. With PMIx alone (`srun --mpi=pmix`),
/// the environment has the rank but not the number of processes, which only MPI can give. SLURM_PROCID is not used as a
/// rank: batch scripts and `srun --mpi=none` also set it, and their processes are independent. Each of these processes
/// is a separate run. The lock of the results directory prevents two of them from writing into the same directory.

#include <cstdlib>
#include <initializer_list>

namespace pseudorigid::app {

/// The place of this process among the processes that a launcher has started together. A process without a launcher has
/// the rank 0 of 1.
struct Launch {
  static constexpr int unknown = 0;  ///< value of n_ranks if only MPI can give the number
  int rank = 0;
  int n_ranks = 1;       ///< number of ranks; `unknown` if the launcher gives only the rank
  int n_ranks_here = 1;  ///< number of ranks on this machine; 1 if the launcher does not give it

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
