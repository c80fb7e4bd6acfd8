#pragma once
/// Rank and number of processes under mpirun or srun, from what the launchers leave in the environment: a process that
/// needs no MPI does not start it.

#include <cstdlib>

namespace pseudorigid::app {

struct Launch {
  int rank = 0, n_ranks = 1;

  Launch() {
    constexpr const char* variables[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"}, {"PMI_RANK", "PMI_SIZE"}};
    for (const auto& [rank_name, size_name] : variables)
      if (const char* r = std::getenv(rank_name))
        if (const char* n = std::getenv(size_name)) {
          rank = std::atoi(r);
          n_ranks = std::atoi(n);
          return;
        }
  }
};

}  // namespace pseudorigid::app
