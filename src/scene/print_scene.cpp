#include "scene/print_scene.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "entries/wording.h"
#include "scene/entries.h"
#include "scene/owners.h"

namespace pseudorigid::scene {
namespace {

constexpr std::size_t comment_width = 100;  // characters of a line of documentation, without "# " and indentation

struct Name {
  std::string_view section, entry;
};

Name split(std::string_view path) {
  const auto slash = path.find('/');
  if (slash == std::string_view::npos) return {"", path};
  return {path.substr(0, slash), path.substr(slash + 1)};
}

/// Makes the text of a parameter file from comments and `set` lines. Before the lines of an entry, the caller calls
/// enter_section_of. If the section of the entry is not open, enter_section_of closes the open section and opens the
/// section of the entry. Muted entries have no effect for the system of the scene, and are written as comments.
class PrmWriter {
 public:
  void comment(std::string_view text) { text_ += fmt::format("{}# {}\n", indent(), text); }

  void enter_section_of(const About& about, bool muted = false) {
    const auto [section, entry] = split(about.path);
    if (section != section_) {
      close_section();
      section_ = section;
      text_ += fmt::format("\n{}subsection {}\n", muted ? "# " : "", section);
    }
    muted_ = muted;
  }

  void set(const About& about, const std::string& value, std::string_view remark = {}) {
    std::string line = fmt::format("{}{}set {} = {}", muted_ ? "# " : "", indent(), split(about.path).entry, value);
    if (value.empty()) line.pop_back();
    // A comment also prevents a backslash at the end of the value from joining the next line.
    if (!remark.empty() || value.ends_with('\\')) line += fmt::format("  # {}", remark);
    text_ += line + "\n";
  }

  std::string finish() {
    close_section();
    return text_;
  }

 private:
  std::string_view indent() const { return section_.empty() ? "" : "  "; }

  void close_section() {
    if (!section_.empty()) text_ += muted_ ? "# end\n" : "end\n";
  }

  std::string text_;
  std::string_view section_;
  bool muted_ = false;
};

/// Breaks a text at blanks into lines of at most `comment_width` characters. A longer word has its own line.
std::vector<std::string> wrapped(std::string_view text) {
  std::vector<std::string> lines;
  while (text.size() > comment_width) {
    auto blank = text.rfind(' ', comment_width);
    if (blank == text.npos) blank = text.find(' ');  // the first word is longer than a line
    if (blank == text.npos) break;
    lines.emplace_back(text.substr(0, blank));
    text.remove_prefix(blank + 1);
  }
  lines.emplace_back(text);
  return lines;
}

std::string in_unit(const About& about) {
  return about.unit.empty() ? "" : fmt::format(" [{}]", std::string_view(about.unit));
}

std::string as_prm(const Scene& scene) {
  PrmWriter writer;
  visit_entries(scene, [&](const auto& member, const auto& kind, const About& about) {
    writer.enter_section_of(about, !concerns(scene, about.path));
    for (const std::string& line : wrapped(about.documentation)) writer.comment(line);
    writer.comment(fmt::format("Expected: {}{}", kind.expected(), in_unit(about)));
    writer.set(about, kind.print(member));
  });
  return writer.finish();
}

/// The text with `\|` in place of `|`, because `|` would end a cell of the table.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped.append(c == '|' ? "\\" : "").push_back(c);
  return escaped;
}

std::string methods_table(const Catalogue& catalogue) {
  std::string text = "\n## Methods\n\n| Name | Method |\n|---|---|\n";
  for (const NamedMethod& method : catalogue.methods)
    text += fmt::format("| `{}` | {} |\n", method.name, cell(method.documentation));
  return text;
}

std::string models_table(const Catalogue& catalogue) {
  std::string text = "\n## Models\n\n| Name | Model |\n|---|---|\n";
  for (const ModelDescription& model : catalogue.models)
    text += fmt::format("| `{}` | {} |\n", model.name, cell(model.documentation));
  return text;
}

std::string columns_table(const std::string& table, const std::string& introduction,
                          const std::vector<Column>& columns) {
  std::string text = fmt::format("\n## Columns of {}\n\n{}\n\n", table, introduction);
  text += "| Column | Unit | Meaning |\n|---|---|---|\n";
  for (const Column& column : columns)
    text += fmt::format("| `{}` | {} | {} |\n", column.name, cell(column.unit), cell(column.documentation));
  return text;
}

std::string file_of(std::string_view name) { return fmt::format("{}.csv", name); }

std::string columns_tables(const Catalogue& catalogue) {
  std::string text;
  for (const ModelDescription& model : catalogue.models)
    text += columns_table(
        file_of(model.name),
        "These are the columns of a ball, in the groups of Output/Quantities. The first column is `time`.",
        model.columns);
  for (const SystemDescription& system : catalogue.systems)
    text += columns_table(file_of(system.file), fmt::format("{} The first column is `time`.", system.documentation),
                          system.columns);
  if (!catalogue.connections.empty())
    text += columns_table(file_of("connections"),
                          "The motions of manifolds.csv of systems other than the ball have their ends here (Analysis "
                          "= manifolds), a row each.",
                          catalogue.connections);
  if (!catalogue.equilibria.empty())
    text += columns_table("equilibria.csv of systems other than the ball",
                          "The critical points of the potential (Analysis = equilibrium), a row each.",
                          catalogue.equilibria);
  for (const ModelDescription& model : catalogue.models)
    if (const auto& [file, introduction, columns] = model.equilibria; model.has_equilibria)
      text += columns_table(file_of(file), std::string(introduction), columns);
  for (const ModelDescription& model : catalogue.models)
    if (model.static_equilibria) {
      const auto [file, introduction, columns] = model.static_equilibria(1);
      if (file != model.equilibria.file || columns.size() != model.equilibria.columns.size())
        text += columns_table(file_of(file) + " of the ball at rest", std::string(introduction), columns);
    }
  return text;
}

std::string as_markdown(const Scene& scene) {
  std::string text =
      "# Parameters\n\n"
      "Every entry of a parameter file; this page is printed by `pseudorigid parameters --format markdown`.\n"
      "Units are the scene's own: any consistent set of length, mass and time.\n";
  std::string_view open = "none yet";
  visit_entries(scene, [&](const auto& member, const auto& kind, const About& about) {
    const auto [section, entry] = split(about.path);
    if (section != open) {
      text += fmt::format("\n## {}\n\n| Entry | Default | Expected | Unit | Meaning |\n|---|---|---|---|---|\n",
                          section.empty() ? "Outside subsections" : section);
      open = section;
    }
    const std::string value = kind.print(member);
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", entry, value.empty() ? "" : "`" + cell(value) + "`",
                        cell(kind.expected()), cell(about.unit), cell(about.documentation));
  });
  return text + models_table(catalogue_of(scene)) + methods_table(catalogue_of(scene)) +
         columns_tables(catalogue_of(scene));
}

std::string as_json(const Scene& scene) {
  auto entries = nlohmann::ordered_json::array();
  visit_entries(scene, [&](const auto& member, const auto& kind, const About& about) {
    entries.push_back({{"entry", about.path},
                       {"type", kind.type},
                       {"default", kind.print(member)},
                       {"expected", kind.expected()},
                       {"words", kind.words()},
                       {"unit", std::string_view(about.unit)},
                       {"documentation", about.documentation}});
  });
  return entries.dump(2) + "\n";
}

/// The scene as its author wrote it: a constant of gravity that follows from Gravity/Gamma is set to 0.
Scene as_written(Scene scene) {
  if (scene.gamma != 0) scene.loads.get<loads::SelfGravity>().constant = 0;
  return scene;
}

}  // namespace

std::string to_prm(const Scene& scene, const Origins& origins) {
  PrmWriter writer;
  const Scene written = as_written(scene);
  visit_entries(written, [&](const auto& member, const auto& kind, const About& about) {
    if (!concerns(scene, about.path)) return;
    writer.enter_section_of(about);
    const auto expression = scene.expressions.find(about.path);
    writer.set(about, expression != scene.expressions.end() ? expression->second : kind.print(member),
               origins.is_override(std::string(about.path)) ? "from --set" : "");
  });
  return writer.finish();
}

std::vector<UsedValue> used_values(const Scene& scene) {
  std::vector<UsedValue> values;
  const Scene written = as_written(scene);
  visit_entries(written, [&](const auto& member, const auto& kind, const About& about) {
    if (!concerns(scene, about.path)) return;
    const auto expression = scene.expressions.find(about.path);
    const bool varies = !scene.sweep.empty() && expression != scene.expressions.end();
    values.push_back({std::string(about.path), varies ? expression->second : kind.print(member)});
  });
  return values;
}

std::string parameters(Format format, const Catalogue& catalogue) {
  const Scene scene = default_scene(catalogue);
  switch (format) {
    case Format::prm:
      return as_prm(scene);
    case Format::markdown:
      return as_markdown(scene);
    case Format::json:
      return as_json(scene);
  }
  return {};
}

}  // namespace pseudorigid::scene
