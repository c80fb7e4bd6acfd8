#pragma once
/// Conversion of the command line of `pseudorigid` to options. `pseudorigid --help` lists the commands.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/log.h"
#include "scene/print_scene.h"

namespace pseudorigid::app {

enum class Command { run, check, parameters, report, version, help };

struct Options {
  Command command = Command::help;
  std::filesystem::path scene;         ///< path of the parameter file, for the commands `run` and `check`
  std::vector<std::string> overrides;  ///< arguments of --set, for example "Time/End=10"
  std::optional<std::filesystem::path>
      output;  ///< argument of --output: the results directory of `run`, or the path of the page of `report`
  std::filesystem::path run_directory;              ///< argument DIR of `report`
  bool resume = false;                              ///< --resume: true if the run continues from its last checkpoint
  io::Verbosity verbosity = io::Verbosity::normal;  ///< changed by --quiet and --verbose
  scene::Format format = scene::Format::markdown;   ///< argument of --format, for the command `parameters`
  std::string help;  ///< text that Command::help prints: help for the program, or for a command followed by --help
};

/// Returns the options of the command line. An empty command line and --help give Command::help, and --version gives
/// Command::version. Throws UserError if the command line is wrong. The function does not read any file.
Options parse_command_line(int argc, const char* const* argv);

}  // namespace pseudorigid::app
