#include "app/commands/program.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command_line.h"
#include "app/commands/disk_use.h"
#include "app/commands/expected_error.h"
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
#include "io/signals.h"
#include "io/standard_streams.h"
#include "mechanics/core/kernel_builds.h"
#include "scene/advice.h"
#include "scene/models.h"
#include "scene/print_scene.h"
#include "scene/read_scene.h"
#include "scene/user_error.h"
#include "scene/validate.h"

namespace pseudorigid::app {
namespace {

/// The scene before validation (`raw`) and the validated scene (`read`). For a sweep, `read` is the scene of the first
/// run. The runs in which every parameter has its first or last value are then valid as well.
struct Input {
  scene::ReadScene raw, read;
};

/// Sets the number of samples of a resumed scene, which may have a later Time/End. Throws UserError in the cases of
/// keep_sampling.
void go_on(scene::Scene& scene, const Options& options) {
  try {
    keep_sampling(scene, io::RunDirectory(scene.output.directory, options.scene, options.output));
  } catch (const UserError& error) {
    throw UserError(std::string("--resume: ") + error.what());
  }
}

/// Reads and validates the scene. Checks the sweep and the disk space for its samples, the mesh file and the memory.
/// The memory is not checked if `n_ranks` is Launch::unknown. Throws UserError if the scene cannot run.
Input read_and_validate(const Options& options, const scene::Catalogue& catalogue, int n_ranks) {
  Input input{scene::read_scene(options.scene, options.overrides, catalogue), {}};
  input.read = input.raw;
  scene::Scene scene = input.raw.scene;
  if (options.resume) go_on(scene, options);
  input.read.scene = scene_to_run(scene, input.raw.origins);
  check_sweep(input.raw);
  require_room_for_trajectories(input.read.scene, input.read.origins,
                                {input.read.scene.output.directory, options.scene, options.output});
  const std::size_t n_coarse_cells = require_mesh_file(input.read.scene, input.read.origins);
  if (n_ranks != Launch::unknown)
    require_memory(input.read.scene, input.read.origins, n_coarse_cells, Launch().n_ranks_here, n_ranks);
  return input;
}

/// Throws UserError if MPI and the launcher give this process a different rank or a different number of ranks. If the
/// launcher does not give the number, the number is not compared. Processes can compute together only if MPI connects
/// all processes that the launcher started.
void require_mpi_of(const Launch& launch, const Ranks& ranks) {
  if (ranks.rank() == launch.rank && (ranks.size() == launch.n_ranks || launch.n_ranks == Launch::unknown)) return;
  throw UserError(
      fmt::format("the process of rank {} finds {} rank{} of MPI; the launcher must be that of the MPI which "
                  "pseudorigid is linked with (its mpirun, or srun --mpi=pmix)",
                  launch.rank, ranks.size(), ranks.size() == 1 ? "" : "s"));
}

/// The executable with the library that this process has opened, and the ranks of this process.
struct Process {
  Executable executable;
  Launch launch{};
  bool has_continuum = false;        ///< true if the finite-element library is open
  std::unique_ptr<Ranks> several{};  ///< the ranks of MPI; null if MPI has not been started

  /// Opens the finite-element library, unless it is open. If the process may be one of several, also starts MPI, which
  /// takes 0.3 s. Throws NoContinuum if the library is missing or cannot be opened, and std::system_error if the limit
  /// of the address space is too low. Throws UserError if MPI does not fit the launcher.
  void open_continuum(int argc, char** argv) {
    if (has_continuum) return;
    const ContinuumModule& module = *executable.open_continuum();
    has_continuum = true;
    for (BallModel& model : executable.models)
      if (model.description.discretized) model.run = module.run;
    executable.libraries.merge(module.libraries());
    executable.instructions = module.instructions;
    if (launch.n_ranks == 1) return;
    several = module.start_ranks(argc, argv);
    executable.ranks = several.get();
    require_mpi_of(launch, *several);
  }

  /// The number of ranks that MPI gives, or 1 if the launcher started a single process. Launch::unknown if MPI has not
  /// been started for one of several processes.
  int n_ranks() const { return several ? several->size() : launch.n_ranks == 1 ? 1 : Launch::unknown; }
};

/// Lines with all inputs that determine the actions of a process. All ranks must have the same lines. The inputs are
/// the scene with included files and overrides, the options, the mesh file, and the SIMD instructions that the
/// environment requests.
std::vector<std::string> identity_of(const Options& options, const scene::ReadScene& read) {
  const io::RunDirectory directory(read.scene.output.directory, options.scene, options.output);
  std::vector<std::string> lines{fmt::format("results in {}", directory.path().string()),
                                 fmt::format("--resume {}", options.resume ? "given" : "not given"),
                                 fmt::format("the instructions '{}'", mechanics::wanted_instructions()),
                                 fmt::format("the mesh {}", mesh_identity(read.scene))};
  for (const scene::UsedValue& used : scene::used_values(read.scene))
    if (used.path != "Continuum/Mesh")  // the path of the mesh may differ between machines
      lines.push_back(fmt::format("{} = {}", used.path, used.value));
  return lines;
}

/// Opens the finite-element library for a valid scene. If the library is missing or cannot be opened, throws a
/// UserError, which recommends the models without finite elements that can run this scene.
void open_continuum_for(const scene::ReadScene& read, int argc, char** argv, Process& process) try {
  process.open_continuum(argc, argv);
} catch (const NoContinuum& error) {
  scene::Refusal refusal{
      "Models", fmt::format("the scene needs the continuum model, but {}; build the preset release", error.what())};
  for (const auto name : scene::names_where(read.scene, [](const auto& model) { return !model.discretized; }))
    refusal.remedies.push_back({{refusal.path, std::string(name)}});
  throw UserError(scene::sentence_with_advice(
      refusal, read.scene, [&](scene::Scene trial) { return is_accepted(std::move(trial), read.origins); }));
}

/// The command `run` on this rank. A scene without finite elements runs on the first rank, and the other ranks return
/// at once. Returns the exit code. Throws UserError if the scene cannot run, and mechanics::NoKernels if the processor
/// cannot run the kernels. If there are several ranks, such an exception on one rank makes all ranks throw
/// FailureOnAllRanks. All ranks also throw it if their inputs differ.
int run(const Options& options, int argc, char** argv, Process& process, const scene::Catalogue& catalogue) {
  io::install_signal_handlers();  // before the finite-element library is opened, which takes up to 0.5 s
  Input input;
  on_all_ranks(*process.executable.ranks, [&] {
    process.executable.instructions();
    input = read_and_validate(options, catalogue, process.n_ranks());
  });
  scene::ReadScene& read = input.read;
  require_same_on_all_ranks(*process.executable.ranks, identity_of(options, read));
  const bool is_first = process.launch.rank == 0;
  if (!scene::is_discretized(read.scene)) {
    if (!is_first) return exit_done;
    if (process.launch.n_ranks != 1 && !process.has_continuum)
      read.warnings.push_back(
          "one of the processes that were started together runs the scene; those of the others "
          "have not been compared with it, which needs the library of the finite elements");
    return run_scene(input.raw, read, options, {argv, argv + argc}, process.executable);
  }
  if (!read.scene.sweep.empty() && process.launch.n_ranks != 1)
    on_all_ranks(*process.executable.ranks, [&] {
      throw UserError(
          fmt::format("{}: Sweep/Parameters: a sweep with finite elements uses the cores of one machine by "
                      "itself, without mpirun; Sweep/Part divides it among several",
                      read.origins.of("Sweep/Parameters")));
    });
  open_continuum_for(input.raw, argc, argv, process);
  process.executable.instructions();
  if (!is_first) return assist_scene(read, options, process.executable);
  // The destructor tells the other ranks, which wait in assist_scene, that the run has ended. It does so after an
  // exception as well.
  struct Dismissal {
    const Ranks& ranks;
    ~Dismissal() { ranks.of_first(false); }
  } const dismissal{*process.executable.ranks};
  return run_scene(input.raw, read, options, {argv, argv + argc}, process.executable);
}

/// Executes the command and returns the exit code.
int dispatch(const Options& options, int argc, char** argv, Process& process) {
  const scene::Catalogue catalogue = catalogue_with(process.executable.models);
  switch (options.command) {
    case Command::run:
      return run(options, argc, argv, process, catalogue);
    case Command::check: {
      const auto [raw, read] = read_and_validate(options, catalogue, process.n_ranks());
      scene::Needs needs = needs_with_effort(read.scene);
      describe_disk_use(read.scene, {read.scene.output.directory, options.scene, options.output}, needs);
      describe_expected_error(read.scene, needs);
      needs.gammas = gammas_of_sweep(raw);
      needs.warnings.insert(needs.warnings.begin(), read.warnings.begin(), read.warnings.end());
      io::print(scene::describe(read.scene, needs));
      return exit_done;
    }
    case Command::parameters:
      io::print(scene::parameters(options.format, catalogue));
      return exit_done;
    case Command::report:
      if (process.launch.rank == 0) report_run(options);
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
  Process process{executable};
  const Launch& launch = process.launch;
  try {
    require_stack();
    // Only MPI can compare the scenes of all ranks, so the library is opened before the scene is read.
    if (argc > 1 && std::string_view(argv[1]) == "run" && launch.n_ranks != 1) try {
        process.open_continuum(argc, argv);
      } catch (const NoContinuum&) {  // only scenes that need the library fail later
      }
    Options options;
    on_all_ranks(*process.executable.ranks, [&] { options = parse_command_line(argc, argv); });
    return dispatch(options, argc, argv, process);
  } catch (const std::exception& error) {
    const Failure failure = failure_of(error);
    const Ranks& ranks = *process.executable.ranks;
    // If all ranks have an error, the first rank reports it. If only a later rank has an error, this rank reports it
    // and aborts all ranks, because the first rank would wait for this rank forever. If the launcher does not give the
    // number of ranks, and MPI connects this process to no other process, every process reports its own error.
    const bool alone = ranks.rank() > 0 && !dynamic_cast<const FailureOnAllRanks*>(&error);
    const bool unconnected = process.several && ranks.size() == 1 && launch.n_ranks == Launch::unknown;
    const bool is_first = ranks.rank() == 0 && launch.rank == 0;
    if (is_first || unconnected || alone) std::fprintf(stderr, "error: %s\n", failure.message.c_str());
    if (alone) ranks.abort(failure.exit_code);
    return failure.exit_code;
  }
}

}  // namespace pseudorigid::app
