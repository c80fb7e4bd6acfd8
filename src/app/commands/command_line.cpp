#include "app/commands/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "entries/entry_kinds.h"
#include "entries/wording.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// Joins the lines of CLI11's text for a wrong command line, because an error message of the program has one line.
/// Appends a hint to use --help.
std::string one_sentence(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text + "; see pseudorigid --help";
}

/// Checks of arguments for CLI11. They refuse an empty argument, which CLI11 would accept. Each check returns the error
/// message, or "" if the argument is valid.
std::string names_a_file(const std::string& scene) {
  return scene.empty() ? "expected the name of a parameter file, got nothing" : "";
}

std::string names_a_directory(const std::string& directory) {
  return directory.empty() ? "expected the directory of a run, got nothing" : "";
}

std::string names_a_new_directory(const std::string& directory) {
  std::string same;
  const scene::Directory kind;
  const auto problem = kind.read(directory, same);
  return problem ? fmt::format("expected {}, {}", kind.expected(), *problem) : "";
}

scene::Format format_of(const std::string& name) {
  if (name == "prm") return scene::Format::prm;
  if (name == "markdown") return scene::Format::markdown;
  if (name == "json") return scene::Format::json;
  throw CLI::ValidationError("--format", "expected prm, markdown or json, got \"" + name + "\"");
}

/// Text for --help with the directory of the installed scenes; empty if this directory does not exist.
std::string note_on_scenes() {
  std::error_code none;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", none);
  const auto scenes = program.parent_path().parent_path() / "share" / "pseudorigid" / "params";
  return std::filesystem::is_directory(scenes, none) ? "\n\nScenes to begin with: " + scenes.string() : "";
}

/// Throws a UserError if the first argument is neither a command nor an option. The message lists the commands, which
/// CLI11's own message does not list. If the argument is a parameter file, the message recommends `pseudorigid run`.
void require_known_command(const CLI::App& app, int argc, const char* const* argv) {
  const std::string_view word = argc > 1 ? argv[1] : "";
  if (word.empty() || word.starts_with('-')) return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  if (word.ends_with(".prm"))
    throw UserError(fmt::format("expected a command before {}: pseudorigid run {}", scene::quote(word), word));
  throw UserError(fmt::format("unknown command {}{}. The commands are {}; see pseudorigid --help", scene::quote(word),
                              scene::did_you_mean(word, {names.begin(), names.end()}), fmt::join(names, ", ")));
}

/// Throws a UserError for `words`, the surplus arguments and unknown options of the command. The message names the
/// first unknown option, or the first argument if all options are known.
[[noreturn]] void refuse_arguments(const CLI::App& command, const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::string help = fmt::format("see pseudorigid {} --help", command.get_name());
  for (const std::string& word : words)
    if (word.starts_with('-'))
      throw UserError(fmt::format("unknown option {}{}; {}", scene::quote(word),
                                  scene::did_you_mean(word, {names.begin(), names.end()}), help));
  throw UserError(fmt::format("expected no further argument, got {}; {}", scene::quote(words.front()), help));
}

}  // namespace

Options parse_command_line(int argc, const char* const* argv) {
  Options options;
  CLI::App app{
      "Elastic bodies as pseudo-rigid and polynomial bodies and by finite elements, and other systems of mechanics",
      "pseudorigid"};
  app.set_version_flag("--version", "version");
  app.require_subcommand(0, 1);
  app.footer(std::string() +
             "Exit codes: 0 done; 2 the input is wrong; 3 the run could not go on or was interrupted (--resume\n"
             "continues a motion, a sweep or a family of equilibria); 1 a defect of the program." +
             note_on_scenes());

  bool quiet = false, verbose = false;
  auto* run = app.add_subcommand("run", "Run a scene and write its results");
  run->add_option("SCENE", options.scene, "parameter file")->required()->check(names_a_file);
  run->add_option("--set", options.overrides, "\"Section/Entry=value\" in place of what the file says (repeatable)")
      ->allow_extra_args(false);
  run->add_option("--output", options.output, "directory of the results, in place of <Output/Directory>/<scene name>")
      ->check(names_a_new_directory);
  run->add_flag("--resume", options.resume, "go on from the last checkpoint");
  auto* quiet_flag = run->add_flag("--quiet", quiet, "print warnings and errors only");
  run->add_flag("--verbose", verbose, "print all that goes into the log")->excludes(quiet_flag);

  auto* check = app.add_subcommand("check", "Validate a scene; print what it needs and what is skipped");
  check->add_option("SCENE", options.scene, "parameter file")->required()->check(names_a_file);
  check->add_option("--set", options.overrides, "as for run")->allow_extra_args(false);

  auto* parameters = app.add_subcommand("parameters", "Print every entry: default, range, unit, documentation");
  parameters
      ->add_option_function<std::string>(
          "--format", [&](const std::string& name) { options.format = format_of(name); },
          "prm, markdown (default) or json")
      ->option_text("FORMAT");

  auto* report = app.add_subcommand("report", "Write report.html of a run from the files in its directory");
  report->add_option("DIR", options.run_directory, "directory of the results of a run")
      ->required()
      ->check(names_a_directory);
  report->add_option("--output", options.output, "name of the page, in place of DIR/report.html");

  require_known_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    options.help = chosen.empty() ? app.help() : chosen.front()->help(app.get_name());
    return options;
  } catch (const CLI::CallForVersion&) {
    options.command = Command::version;
    return options;
  } catch (const CLI::ExtrasError& error) {
    const auto chosen = app.get_subcommands();
    const std::vector<std::string> words = app.remaining(true);
    if (chosen.empty() || words.empty()) throw UserError(one_sentence(error.what()));
    refuse_arguments(*chosen.front(), words);
  } catch (const CLI::ParseError& error) {
    throw UserError(one_sentence(error.what()));
  }
  if (quiet) options.verbosity = io::Verbosity::quiet;
  if (verbose) options.verbosity = io::Verbosity::verbose;
  options.command = run->parsed()          ? Command::run
                    : check->parsed()      ? Command::check
                    : parameters->parsed() ? Command::parameters
                    : report->parsed()     ? Command::report
                                           : Command::help;
  options.help = app.help();
  return options;
}

}  // namespace pseudorigid::app
