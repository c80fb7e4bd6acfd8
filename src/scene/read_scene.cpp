#include "scene/read_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <type_traits>
#include <utility>

#include "entries/wording.h"
#include "scene/entries.h"
#include "scene/expressions.h"
#include "scene/prm_reader.h"
#include "scene/user_error.h"

namespace pseudorigid::scene {
namespace {

constexpr std::string_view override_origin = "--set";

/// The paths of all entries, or of all subsections if `sections` is true.
std::vector<std::string_view> known_paths(const Scene& scene, bool sections) {
  std::vector<std::string_view> paths;
  visit_entries(scene, [&](const auto&, const auto&, const About& about) {
    const std::string_view section = about.path.substr(0, std::min(about.path.find('/'), about.path.size()));
    const std::string_view path = sections ? section : about.path;
    const bool counts = !sections || section != about.path;
    if (counts && std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
  });
  return paths;
}

/// Throws UserError if no subsection of this name is known. If a known subsection begins inside another subsection, the
/// message asks for a missing `end`.
void check_subsection(const Statement& statement, const Scene& scene) {
  const std::vector<std::string_view> sections = known_paths(scene, true);
  if (std::find(sections.begin(), sections.end(), statement.path) != sections.end()) return;
  const auto slash = statement.path.rfind('/');
  const bool is_inside = slash != std::string::npos;
  const std::string outer = statement.path.substr(0, is_inside ? slash : 0);
  const std::string_view inner = std::string_view(statement.path).substr(is_inside ? slash + 1 : 0);
  if (is_inside && std::find(sections.begin(), sections.end(), inner) != sections.end())
    throw UserError(fmt::format("{}: subsection {} begins inside subsection {}; is the \"end\" of {} missing?",
                                statement.where(), quote(inner), quote(outer), outer));
  throw UserError(fmt::format("{}: unknown subsection {}{}", statement.where(), quote(statement.path),
                              did_you_mean(statement.path, sections)));
}

/// The absolute path of the mesh file `name`, or `builtin`. A name in a parameter file is relative to the folder of
/// this file. A name in an override is relative to the working directory. Throws UserError if the path contains `#`.
std::string located(const Statement& statement, const BuiltinOrMeshFile& kind, const std::string& name) {
  const bool in_file = statement.line > 0;
  std::string path =
      kind.located(name, in_file ? std::filesystem::path(statement.file).parent_path() : std::filesystem::path());
  if (path.find('#') != std::string::npos)  // used.prm contains the path, and # begins a comment
    throw UserError(fmt::format("{}: {}: expected a file whose path has no \"#\", {}", statement.where(),
                                statement.path, got(path)));
  return path;
}

/// Adds a warning if an entry has two values in one file, which is probably a mistake. A value in the including file
/// may override a value in an included file without a warning.
void warn_of_repetition(const Statement& statement, ReadScene& read) {
  const auto found = read.origins.all().find(statement.path);
  if (statement.line == 0 || found == read.origins.all().end()) return;
  if (const std::string& before = found->second; before.starts_with(statement.file + ":"))
    read.warnings.push_back(fmt::format("{}: {} has a value already, from line {}; this one counts", statement.where(),
                                        statement.path, before.substr(statement.file.size() + 1)));
}

/// Sets the entry of the statement and records its origin. Stores an expression as text, and adds a warning if the
/// entry already has a value in the same file. Throws UserError if the entry is unknown or the value is wrong.
void set_entry(const Statement& statement, ReadScene& read) {
  warn_of_repetition(statement, read);
  bool known = false;
  visit_entries(read.scene, [&](auto& member, const auto& kind, const About& about) {
    if (about.path != statement.path) return;
    known = true;
    read.scene.expressions.erase(statement.path);
    const bool may_have_expression =
        kind.type != Text::type && kind.type != BuiltinOrMeshFile::type && about.path != "Sweep/Parameters";
    // The function with_parameters evaluates an expression after the parameters of the sweep have been read.
    if (may_have_expression && has_expression(*statement.value)) {
      read.scene.expressions[statement.path] = *statement.value;
      read.origins.record(statement.path, statement.where());
      return;
    }
    if (const Problem problem = kind.read(*statement.value, member))
      throw UserError(fmt::format("{}: {}: expected {}, {}", statement.where(), about.path, kind.expected(), *problem));
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(kind)>, BuiltinOrMeshFile>)
      member = located(statement, kind, member);
    read.origins.record(statement.path, statement.where());
  });
  if (!known)
    throw UserError(fmt::format("{}: unknown entry {}{}", statement.where(), quote(statement.path),
                                did_you_mean(statement.path, known_paths(std::as_const(read.scene), false))));
}

/// Throws UserError if the value does not fit on one line of a parameter file, because used.prm contains the value.
void check_fits_file(const Statement& statement) {
  const bool control = std::any_of(statement.value->begin(), statement.value->end(),
                                   [](unsigned char c) { return std::iscntrl(c) != 0; });
  if (control || statement.value->find('#') != std::string::npos)
    throw UserError(fmt::format("{}: {}: expected a value on one line without \"#\", {}", statement.where(),
                                statement.path, got(*statement.value)));
}

/// The statement of an argument "Section/Entry=value" of --set. Throws UserError if the text has another form, or if
/// the value does not fit on one line (check_fits_file).
Statement override_statement(const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos)
    throw UserError(fmt::format("{}: expected \"Section/Entry=value\", {}", override_origin, got(text)));
  std::string path;
  for (const std::string_view part : parts_of(std::string_view(text).substr(0, equals), '/'))
    path.append(path.empty() ? "" : "/").append(normalised_name(part));
  Statement statement{path, std::string(trimmed(std::string_view(text).substr(equals + 1))),
                      std::string(override_origin)};
  check_fits_file(statement);
  return statement;
}

std::string scene_name(const std::filesystem::path& file) {
  return file.extension() == ".prm" ? file.stem().string() : file.filename().string();
}

}  // namespace

std::string Origins::of(const std::string& path) const {
  const auto found = where_.find(path);
  return found != where_.end() ? found->second : file_;
}

bool Origins::is_override(const std::string& path) const { return of(path) == override_origin; }

ReadScene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     const Catalogue& catalogue) {
  ReadScene read{default_scene(catalogue), Origins(file.string()), scene_name(file)};
  read_prm_text(text_of_prm(file), file, [&](const Statement& statement) {
    if (statement.value)
      set_entry(statement, read);
    else
      check_subsection(statement, read.scene);
  });
  for (const std::string& setting : overrides) set_entry(override_statement(setting), read);
  read.scene = with_parameters(read.scene, values_of_run(read.scene.sweep, 0), read.origins);
  return read;
}

Scene with_parameters(Scene scene, const ParameterValues& parameters, const Origins& origins) {
  if (scene.expressions.empty()) return scene;
  const auto expressions = scene.expressions;
  visit_entries(scene, [&](auto& member, const auto& kind, const About& about) {
    const auto found = expressions.find(about.path);
    if (found == expressions.end()) return;
    Problem problem;
    try {
      const bool is_whole = kind.type.find("integer") != std::string_view::npos;
      const std::string text = evaluated(found->second, parameters, is_whole ? Rounding::to_whole : Rounding::none);
      if ((problem = kind.read(text, member)))
        throw UserError(fmt::format("expected {}, {}", kind.expected(), *problem));
    } catch (const UserError& error) {
      throw UserError(fmt::format("{}: {}: {}", origins.of(found->first), found->first, error.what()));
    }
  });
  return scene;
}

}  // namespace pseudorigid::scene
