#pragma once
/// The command line of `pseudorigid` (README.md), and its conversion to options.

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
  std::filesystem::path scene;
  std::vector<std::string> overrides;           ///< arguments of --set
  std::optional<std::filesystem::path> output;  ///< argument of --output
  std::filesystem::path run_directory;          ///< argument DIR of `report`
  bool resume = false;
  io::Verbosity verbosity = io::Verbosity::normal;
  scene::Format format = scene::Format::markdown;
  std::string help;  ///< text of --help
};

/// Throws a UserError of one sentence for a wrong command line.
Options parse_command_line(int argc, const char* const* argv);

}  // namespace pseudorigid::app
