#include "app/run/continuum_module.h"

#ifdef PSEUDORIGID_CHOLMOD
#include <cholmod.h>
#endif
#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>
#include <fmt/format.h>
#include <mpi.h>

#include <cstdio>
#include <new>
#include <string>

#include "app/ranks/on_all_ranks.h"
#include "app/run/run_models.h"
#include "continuum/kernels/kernel_table.h"
#include "io/manifest.h"
#include "io/run_lock.h"

namespace pseudorigid::app {
namespace {

/// The processes that a launcher, for example mpirun, has started.
class MpiRanks final : public Ranks {
 public:
  MpiRanks(int argc, char** argv) : session_(argc, argv, 1) {}
  int rank() const override { return static_cast<int>(dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)); }
  int size() const override { return static_cast<int>(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)); }
  bool any(bool mine) const override { return dealii::Utilities::MPI::max(mine ? 1 : 0, MPI_COMM_WORLD) != 0; }
  int first_where(bool mine) const override {
    return dealii::Utilities::MPI::min(mine ? rank() : size(), MPI_COMM_WORLD);
  }
  int number_of(int rank, int mine) const override {
    MPI_Bcast(&mine, 1, MPI_INT, rank, MPI_COMM_WORLD);
    return mine;
  }
  std::string text_of(int rank, std::string mine) const override {
    mine.resize(static_cast<std::size_t>(number_of(rank, static_cast<int>(mine.size()))));
    MPI_Bcast(mine.data(), static_cast<int>(mine.size()), MPI_CHAR, rank, MPI_COMM_WORLD);
    return mine;
  }
  void abort(int exit_code) const override { MPI_Abort(MPI_COMM_WORLD, exit_code); }

 private:
  dealii::Utilities::MPI::MPI_InitFinalize session_;
};

/// Runs the finite-element model, and replaces deal.II's exception for exhausted memory by std::bad_alloc.
ModelOutcome run_within_memory(const RunContext& context) try {
  return run_continuum(context);
} catch (const dealii::StandardExceptions::ExcOutOfMemory&) {
  throw std::bad_alloc();
}

/// Runs the finite-element model on all ranks. If only one rank fails, this rank writes the failure to standard error
/// and to the manifest, removes the lock of the run directory, and aborts all ranks. The first rank usually does this,
/// but it may wait in a collective operation for the failed rank. Collective.
ModelOutcome run_on_all_ranks(const RunContext& context) {
  return together_or_not_at_all(
      *context.ranks, [&] { return run_within_memory(context); },
      [&](const Failure& failure) {
        std::fprintf(stderr, "error: %s (on rank %d, which ends the run)\n", failure.message.c_str(),
                     context.ranks->rank());
        pseudorigid::io::note_failure(context.directory.manifest(), failure.exit_code, failure.message);
        pseudorigid::io::RunLock::remove(context.directory.path());
      });
}

/// The versions of deal.II and, if the library uses it, CHOLMOD.
std::map<std::string, std::string> libraries() {
  std::map<std::string, std::string> versions{{"deal.II", DEAL_II_PACKAGE_VERSION}};
#ifdef PSEUDORIGID_CHOLMOD
  versions["CHOLMOD"] = fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION);
#endif
  return versions;
}

}  // namespace
}  // namespace pseudorigid::app

const pseudorigid::app::ContinuumModule* pseudorigid_continuum() {
  using namespace pseudorigid::app;
  // The kernels use SIMD in a single thread. With several threads, the sums of deal.II's vectors would not be
  // reproducible.
  dealii::MultithreadInfo::set_thread_limit(1);
  static constexpr ContinuumModule module{
      .run = run_on_all_ranks,
      .libraries = libraries,
      .instructions = [] { return pseudorigid::continuum::chosen_kernels().instructions; },
      .start_ranks = [](int argc, char** argv) -> std::unique_ptr<Ranks> {
        return std::make_unique<MpiRanks>(argc, argv);
      }};
  return &module;
}
