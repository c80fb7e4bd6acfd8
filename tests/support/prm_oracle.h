#pragma once
/// The reader of .prm files beside deal.II's ParameterHandler: both accept a text and find the same values, or both
/// refuse it, but for two documented differences: blanks inside names, and a statement that a backslash joins to the
/// line before, which deal.II takes for a part of it.

#include <deal.II/base/parameter_handler.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/prm_reader.h"
#include "scene/user_error.h"

namespace pseudorigid::testing {

class PrmOracle {
 public:
  using Values = std::map<std::string, std::string>;
  using Outcome = std::optional<Values>;  ///< empty: refused

  /// Of a language with these entries, path → default.
  explicit PrmOracle(Values defaults) : defaults_(std::move(defaults)) {
    for (const auto& [path, value] : defaults_)
      for (auto slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
        sections_.insert(path.substr(0, slash));
  }

  Outcome by_dealii(const std::string& text) const {
    dealii::ParameterHandler handler;
    for (const auto& [path, value] : defaults_)
      at(handler, path, [&](const std::string& name) { handler.declare_entry(name, value); });
    try {
      std::istringstream stream(text);
      handler.parse_input(stream, "f");
    } catch (const std::exception&) {
      return std::nullopt;
    }
    Values values;
    for (const auto& [path, unused] : defaults_)
      at(handler, path, [&](const std::string& name) { values[path] = handler.get(name); });
    return values;
  }

  Outcome by_reader(const std::string& text) const {
    Values values = defaults_;
    try {
      scene::read_prm_text(text, "f", [&](const scene::Statement& statement) {
        // deal.II also lets one enter an entry as if it were a subsection; which names exist is not the reader's
        // business.
        const bool known =
            defaults_.contains(statement.path) || (!statement.value && sections_.contains(statement.path));
        if (!known) throw UserError("unknown name");
        if (statement.value) values[statement.path] = *statement.value;
      });
    } catch (const UserError&) {
      return std::nullopt;
    }
    return values;
  }

  /// deal.II looks names up as written, so where it refuses it is asked again with blanks collapsed.
  ::testing::AssertionResult agree(const std::string& text) const {
    const Outcome ours = by_reader(text), theirs = by_dealii(text);
    if (ours == theirs || joins_statement(text)) return ::testing::AssertionSuccess();
    if (!theirs && collapsed(ours) == collapsed(by_dealii(collapsed(text)))) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "text:\n"
                                         << text << "\nreader:  " << shown(ours) << "\ndeal.II: " << shown(theirs);
  }

 private:
  static bool joins_statement(const std::string& text) try {
    scene::read_prm_text(text, "f", [](const scene::Statement&) {});
    return false;
  } catch (const UserError& error) {
    return std::string_view(error.what()).find("the backslash at the end of this line") != std::string_view::npos;
  }

  static std::vector<std::string> parts(const std::string& path) {
    std::vector<std::string> result{""};
    for (const char c : path) {
      if (c == '/')
        result.emplace_back();
      else
        result.back().push_back(c);
    }
    return result;
  }

  /// Calls `action(entry)` inside the subsections of the path.
  template <class Action>
  static void at(dealii::ParameterHandler& handler, const std::string& path, const Action& action) {
    const auto names = parts(path);
    for (std::size_t i = 0; i + 1 < names.size(); ++i) handler.enter_subsection(names[i]);
    action(names.back());
    for (std::size_t i = 0; i + 1 < names.size(); ++i) handler.leave_subsection();
  }

  /// Runs of blanks and tabs made one blank.
  static std::string collapsed(const std::string& text) {
    std::string result;
    for (const char c : text) {
      const char letter = c == '\t' ? ' ' : c;
      if (letter != ' ' || result.empty() || result.back() != ' ') result += letter;
    }
    return result;
  }

  static Outcome collapsed(Outcome outcome) {
    if (outcome)
      for (auto& [path, value] : *outcome) value = collapsed(value);
    return outcome;
  }

  static std::string shown(const Outcome& outcome) {
    if (!outcome) return "refused";
    std::string text;
    for (const auto& [path, value] : *outcome) text += path + "=[" + value + "] ";
    return text;
  }

  Values defaults_;
  std::set<std::string> sections_;
};

}  // namespace pseudorigid::testing
