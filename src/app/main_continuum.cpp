#include <cholmod.h>
#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>
#include <exception>
#include <optional>

#include "app/launch.h"
#include "app/libraries.h"
#include "app/program.h"
#include "app/run_models.h"
#include "io/files.h"
#include "scene/user_error.h"

namespace {

using namespace pseudorigid::app;

/// The processes that mpirun has started.
class MpiRanks final : public Ranks {
 public:
  int rank() const override { return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)); }
  int size() const override { return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)); }
  bool any(bool mine) const override { return dealii::Utilities::MPI::max(mine ? 1 : 0, MPI_COMM_WORLD) != 0; }
  bool of_first(bool mine) const override {
    int value = mine;
    MPI_Bcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return value != 0;
  }
};

/// A defect on one rank must not leave the others waiting for it.
ModelOutcome run_continuum_or_abort(const RunContext& context) {
  if (context.ranks->size() == 1) return run_continuum(context);
  try {
    return run_continuum(context);
  } catch (const pseudorigid::UserError&) {
    throw;
  } catch (const pseudorigid::io::WriteError&) {
    throw;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: a defect of pseudorigid on rank %d, please report it: %s\n", context.ranks->rank(),
                 error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  // The kernels are SIMD within one process; threads in the library's vectors would only make sums irreproducible.
  dealii::MultithreadInfo::set_thread_limit(1);
  auto libraries = common_libraries();
  libraries["deal.II"] = DEAL_II_PACKAGE_VERSION;
  libraries["CHOLMOD"] = fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION);
  // One process starts MPI only if something needs it, which takes 0.3 s.
  std::optional<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
  const MpiRanks several;
  if (Launch().n_ranks > 1) mpi.emplace(argc, argv, 1);
  return run_program(argc, argv, {run_continuum_or_abort, std::move(libraries), mpi ? &several : &one_rank()});
}
