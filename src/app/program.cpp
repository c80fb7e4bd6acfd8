#include "app/program.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>

#include "app/catalogue.h"
#include "app/command_line.h"
#include "app/launch.h"
#include "app/mesh_file.h"
#include "app/run_command.h"
#include "app/scene_to_run.h"
#include "app/sweep.h"
#include "io/build_info.h"
#include "io/files.h"
#include "scene/needs.h"
#include "scene/print_scene.h"
#include "scene/read_scene.h"
#include "scene/user_error.h"
#include "scene/validate.h"

namespace pseudorigid::app {
namespace {

constexpr int exit_done = 0, exit_defect = 1, exit_wrong_input = 2, exit_stopped = 3;

/// Becomes pseudorigid-continuum, which stands beside this executable, with the same arguments.
[[noreturn]] void become_continuum_executable(char** argv) {
  const std::filesystem::path program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "pseudorigid-continuum";
  std::fflush(nullptr);
  execv(program.c_str(), argv);
  throw UserError("the scene needs the continuum model, but " + program.string() + " cannot be started (" +
                  std::strerror(errno) + "); build the preset release, or set Models = reduced");
}

/// The scene as it was read and as it can be run; of a sweep, the first run, after all have been checked.
struct Input {
  scene::ReadScene raw, read;
};

Input read_and_validate(const Options& options) {
  Input input{scene::read_scene(options.scene, options.overrides, program_catalogue()), {}};
  input.read = input.raw;
  input.read.scene = scene_to_run(input.raw.scene, input.raw.origins);
  check_sweep(input.raw);
  require_mesh_file(input.read.scene, input.read.origins);
  return input;
}

int run(const Options& options, int argc, char** argv, const Executable& executable, const Launch& launch) {
  const Input input = read_and_validate(options);
  const scene::ReadScene& read = input.read;
  if (!read.scene.models.continuum)
    return launch.rank > 0 ? exit_done : run_scene(input.raw, read, options, {argv, argv + argc}, executable);
  if (!executable.run_continuum) become_continuum_executable(argv);
  if (launch.rank > 0) return assist_scene(read, options, executable);
  // However the run ends, the other ranks are told.
  struct Dismissal {
    const Ranks& ranks;
    ~Dismissal() { ranks.of_first(false); }
  } const dismissal{*executable.ranks};
  return run_scene(input.raw, read, options, {argv, argv + argc}, executable);
}

int dispatch(const Options& options, int argc, char** argv, const Executable& executable, const Launch& launch) {
  switch (options.command) {
    case Command::run:
      return run(options, argc, argv, executable, launch);
    case Command::check: {
      const scene::ReadScene read = read_and_validate(options).read;
      std::fputs(scene::describe(read.scene, scene::needs(read.scene)).c_str(), stdout);
      return exit_done;
    }
    case Command::parameters:
      std::fputs(scene::parameters(options.format, program_catalogue()).c_str(), stdout);
      return exit_done;
    case Command::version: {
      const io::BuildInfo build = io::build_info();
      std::printf("pseudorigid %s (%s)\n", std::string(build.version).c_str(), std::string(build.git_hash).c_str());
      return exit_done;
    }
    case Command::help:
      std::fputs(options.help.c_str(), stdout);
      return exit_done;
  }
  return exit_defect;
}

}  // namespace

int run_program(int argc, char** argv, const Executable& executable) {
  const Launch launch;
  try {
    return dispatch(parse_command_line(argc, argv), argc, argv, executable, launch);
  } catch (const UserError& error) {
    if (launch.rank == 0) std::fprintf(stderr, "error: %s\n", error.what());
    return exit_wrong_input;
  } catch (const io::WriteError& error) {  // before there was a log to tell it
    std::fprintf(stderr, "error: %s\n", error.what());
    return exit_stopped;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: a defect of pseudorigid, please report it: %s\n", error.what());
    return exit_defect;
  }
}

}  // namespace pseudorigid::app
