#include "app/commands/program.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command_line.h"
#include "app/commands/continuum_executable.h"
#include "app/commands/disk_use.h"
#include "app/commands/kept_trajectories.h"
#include "app/commands/report_command.h"
#include "app/commands/resume.h"
#include "app/commands/run_command.h"
#include "app/commands/scene_to_run.h"
#include "app/commands/stack_limit.h"
#include "app/commands/sweep.h"
#include "app/models/catalogue.h"
#include "app/ranks/failure.h"
#include "app/ranks/launch.h"
#include "app/ranks/on_all_ranks.h"
#include "app/ranks/same_on_all_ranks.h"
#include "app/run/mesh_file.h"
#include "app/search/effort.h"
#include "io/build_info.h"
#include "io/standard_streams.h"
#include "mechanics/core/kernel_builds.h"
#include "scene/models.h"
#include "scene/print_scene.h"
#include "scene/read_scene.h"
#include "scene/user_error.h"
#include "scene/validate.h"

namespace pseudorigid::app {
namespace {

/// The scene as it was read and as it can be run; of a sweep, the first run, after the ends of its ranges have been
/// checked.
struct Input {
  scene::ReadScene raw, read;
};

/// To a later Time/End, if it is.
void go_on(scene::Scene& scene, const Options& options) {
  try {
    keep_sampling(scene, io::RunDirectory(scene.output.directory, options.scene, options.output));
  } catch (const UserError& error) {
    throw UserError(std::string("--resume: ") + error.what());
  }
}

Input read_and_validate(const Options& options, const scene::Catalogue& catalogue, int n_ranks) {
  Input input{scene::read_scene(options.scene, options.overrides, catalogue, scene_text_handed_over()), {}};
  input.read = input.raw;
  scene::Scene scene = input.raw.scene;
  if (options.resume) go_on(scene, options);
  input.read.scene = scene_to_run(scene, input.raw.origins);
  check_sweep(input.raw);
  require_room_for_trajectories(input.read.scene, input.read.origins,
                                {input.read.scene.output.directory, options.scene, options.output});
  const std::size_t n_coarse_cells = require_mesh_file(input.read.scene, input.read.origins);
  if (n_ranks != Launch::unknown)
    require_memory(input.read.scene, input.read.origins, n_coarse_cells,
                   static_cast<double>(Launch().n_ranks_here) / n_ranks);
  return input;
}

/// Of several processes pseudorigid, which has no MPI, leaves it to pseudorigid-continuum to say how many they are.
int n_ranks_known(const Executable& executable, const Launch& launch) {
  if (executable.runs_discretized) return executable.ranks->size();
  return launch.n_ranks == 1 ? 1 : Launch::unknown;
}

/// Processes that were started together compute together only if MPI knows of all of them.
void require_mpi_of(const Launch& launch, const Ranks& ranks) {
  if (ranks.rank() == launch.rank && (ranks.size() == launch.n_ranks || launch.n_ranks == Launch::unknown)) return;
  throw UserError(
      fmt::format("the process of rank {} finds {} rank{} of MPI; the launcher must be that of the MPI which "
                  "pseudorigid is linked with (its mpirun, or srun --mpi=pmix)",
                  launch.rank, ranks.size(), ranks.size() == 1 ? "" : "s"));
}

/// All that decides what a process does: the scene with what it includes and the options change, the options, the file
/// of the mesh and the environment.
std::vector<std::string> identity_of(const Options& options, const scene::ReadScene& read) {
  const io::RunDirectory directory(read.scene.output.directory, options.scene, options.output);
  std::vector<std::string> lines{fmt::format("results in {}", directory.path().string()),
                                 fmt::format("--resume {}", options.resume ? "given" : "not given"),
                                 fmt::format("the instructions '{}'", mechanics::wanted_instructions()),
                                 fmt::format("the mesh {}", mesh_identity(read.scene))};
  for (const scene::UsedValue& used : scene::used_values(read.scene))
    if (used.path != "Continuum/Mesh")  // its place need not be the same on all machines
      lines.push_back(fmt::format("{} = {}", used.path, used.value));
  return lines;
}

int run(const Options& options, int argc, char** argv, const Executable& executable, const scene::Catalogue& catalogue,
        const Launch& launch) {
  const Ranks& ranks = *executable.ranks;
  Input input;
  on_all_ranks(ranks, [&] {
    executable.instructions();
    input = read_and_validate(options, catalogue, n_ranks_known(executable, launch));
  });
  scene::ReadScene& read = input.read;
  require_same_on_all_ranks(ranks, identity_of(options, read));
  if (!scene::is_discretized(read.scene)) {
    if (launch.rank > 0) return exit_done;
    if (launch.n_ranks != 1 && !executable.runs_discretized)
      read.warnings.push_back(
          "one of the processes that were started together runs the scene; those of the others "
          "have not been compared with it, which needs pseudorigid-continuum");
    return run_scene(input.raw, read, options, {argv, argv + argc}, executable);
  }
  if (!executable.runs_discretized) become_continuum_executable(argv, input.raw);
  if (launch.rank > 0) return assist_scene(read, options, executable);
  // However the run ends, the other ranks are told.
  struct Dismissal {
    const Ranks& ranks;
    ~Dismissal() { ranks.of_first(false); }
  } const dismissal{ranks};
  return run_scene(input.raw, read, options, {argv, argv + argc}, executable);
}

int dispatch(const Options& options, int argc, char** argv, const Executable& executable, const Launch& launch) {
  const scene::Catalogue catalogue = catalogue_with(executable.models);
  switch (options.command) {
    case Command::run:
      return run(options, argc, argv, executable, catalogue, launch);
    case Command::check: {
      const scene::ReadScene read = read_and_validate(options, catalogue, n_ranks_known(executable, launch)).read;
      scene::Needs needs = needs_with_effort(read.scene);
      describe_disk_use(read.scene, {read.scene.output.directory, options.scene, options.output}, needs);
      needs.warnings.insert(needs.warnings.begin(), read.warnings.begin(), read.warnings.end());
      io::print(scene::describe(read.scene, needs));
      return exit_done;
    }
    case Command::parameters:
      io::print(scene::parameters(options.format, catalogue));
      return exit_done;
    case Command::report:
      if (launch.rank == 0) report_run(options);
      return exit_done;
    case Command::version: {
      const io::BuildInfo build = io::build_info();
      io::print(fmt::format("pseudorigid {} ({})\n", build.version, build.git_hash));
      return exit_done;
    }
    case Command::help:
      io::print(options.help);
      return exit_done;
  }
  return exit_defect;
}

}  // namespace

int run_program(int argc, char** argv, const Executable& executable) {
  const Launch launch;
  const bool is_run = argc > 1 && std::string_view(argv[1]) == "run";
  // Whether all were given the same scene is seen with MPI alone.
  if (is_run && launch.n_ranks != 1 && !executable.runs_discretized) try_to_become_continuum_executable(argv);
  try {
    require_stack();
    if (is_run && executable.runs_discretized) require_mpi_of(launch, *executable.ranks);
    Options options;
    on_all_ranks(*executable.ranks, [&] { options = parse_command_line(argc, argv); });
    return dispatch(options, argc, argv, executable, launch);
  } catch (const std::exception& error) {
    const Failure failure = failure_of(error);
    const Ranks& ranks = *executable.ranks;
    // What all ranks have the first says; what another has alone would leave the first waiting.
    const bool alone = ranks.rank() > 0 && !dynamic_cast<const FailureOnAllRanks*>(&error);
    const bool unconnected = executable.runs_discretized && ranks.size() == 1 && launch.n_ranks == Launch::unknown;
    const bool is_first = ranks.rank() == 0 && launch.rank == 0;
    if (is_first || unconnected || alone) std::fprintf(stderr, "error: %s\n", failure.message.c_str());
    if (alone) ranks.abort(failure.exit_code);
    return failure.exit_code;
  }
}

}  // namespace pseudorigid::app
