/// The reader of .prm files against deal.II's ParameterHandler: both accept a text and find the same values, or both
/// refuse it. The only difference provoked here is the documented one, blanks inside names.

#include <deal.II/base/parameter_handler.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "scene/prm_reader.h"
#include "scene/user_error.h"

namespace pseudorigid::scene {
namespace {

using Values = std::map<std::string, std::string>;
using Outcome = std::optional<Values>;  ///< empty: refused

const Values defaults{{"A", "unset"}, {"B C", "unset"}, {"S/A", "unset"}, {"S/T/D", "unset"}, {"U V/A", "unset"}};
const std::vector<std::string> sections{"S", "S/T", "U V"};

std::vector<std::string> parts(const std::string& path) {
  std::vector<std::string> result{""};
  for (const char c : path) {
    if (c == '/')
      result.emplace_back();
    else
      result.back().push_back(c);
  }
  return result;
}

/// Calls `action(handler, entry)` inside the subsections of the path.
template <class Action>
void at(dealii::ParameterHandler& handler, const std::string& path, const Action& action) {
  const auto names = parts(path);
  for (std::size_t i = 0; i + 1 < names.size(); ++i) handler.enter_subsection(names[i]);
  action(names.back());
  for (std::size_t i = 0; i + 1 < names.size(); ++i) handler.leave_subsection();
}

Outcome by_dealii(const std::string& text) {
  dealii::ParameterHandler handler;
  for (const auto& [path, value] : defaults)
    at(handler, path, [&](const std::string& name) { handler.declare_entry(name, value); });
  try {
    std::istringstream stream(text);
    handler.parse_input(stream, "f");
  } catch (const std::exception&) {
    return std::nullopt;
  }
  Values values;
  for (const auto& [path, unused] : defaults)
    at(handler, path, [&](const std::string& name) { values[path] = handler.get(name); });
  return values;
}

Outcome by_reader(const std::string& text) {
  Values values = defaults;
  try {
    read_prm_text(text, "f", [&](const Statement& statement) {
      // deal.II also lets one enter an entry as if it were a subsection; which names exist is not the reader's
      // business.
      const bool is_section = std::find(sections.begin(), sections.end(), statement.path) != sections.end();
      const bool known = defaults.contains(statement.path) || (!statement.value && is_section);
      if (!known) throw UserError("unknown name");
      if (statement.value) values[statement.path] = *statement.value;
    });
  } catch (const UserError&) {
    return std::nullopt;
  }
  return values;
}

/// Runs of blanks and tabs made one blank.
std::string collapsed(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const char letter = c == '\t' ? ' ' : c;
    if (letter != ' ' || result.empty() || result.back() != ' ') result += letter;
  }
  return result;
}

Outcome collapsed(Outcome outcome) {
  if (outcome)
    for (auto& [path, value] : *outcome) value = collapsed(value);
  return outcome;
}

std::string shown(const Outcome& outcome) {
  if (!outcome) return "refused";
  std::string text;
  for (const auto& [path, value] : *outcome) text += path + "=[" + value + "] ";
  return text;
}

/// deal.II looks names up as written, so where it refuses it is asked again with blanks collapsed.
::testing::AssertionResult agree(const std::string& text) {
  const Outcome ours = by_reader(text), theirs = by_dealii(text);
  if (ours == theirs) return ::testing::AssertionSuccess();
  if (!theirs && collapsed(ours) == collapsed(by_dealii(collapsed(text)))) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "text:\n"
                                       << text << "\nreader:  " << shown(ours) << "\ndeal.II: " << shown(theirs);
}

const std::vector<std::string> tricky_texts{
    "",
    "\n\n",
    "set A = 1",
    "set A=x",
    "set\tA = x",
    "set A = a # c",
    "set A = #",
    "set A = \\#",
    "set A = x#\\\ny",
    "set A =",
    "set A",
    "setA = 1",
    "set = 1",
    "set   = 1",
    "set",
    "set ",
    "SET A = 1",
    "Set A = 1",
    "set A = a = b",
    "set A == b",
    "set A = \"x\"",
    "set A = {x|y}",
    "set A = 1\nset A = 2",
    "set B C = 1",
    "set B\tC = 1",
    "set B  C = 1",
    "set b c = 1",
    "set A = a  b\t\tc",
    "  set A = p \\\n  q\n",
    "set A = p\\\nq",
    "set A = p \\ \nq",
    "set A = p \\ # c\nq",
    "set A = p # \\\nq",
    "# com \\\nset A = x",
    "set A = x\\",
    "set A = x\\\\",
    "set A = x\\\n",
    "set A = x\\\n\nset A = y",
    "set A = x\\\n\\\n\\\ny",
    "set A = p\\\\\nq",
    "set A = x\\\n#y",
    "set A = x\\\n#y\\\nz",
    "set\\\n A = 1",
    "set \\\n A = 1",
    "set A = 1\n\\\nset A=3",
    "\\",
    "\\\n\\",
    "set A = x\r\nset B C = y\r\n",
    "set A = a\rb",
    "set A = \vx\f",
    "\vset A = 1",
    "set\vA = 1",
    "set A \v= 1",
    "subsection S\nset A = 1\nend",
    "subsection  S\nset A = 1\nend",
    "subsection U V\nset A = 1\nend",
    "subsection U  V\nset A = 1\nend",
    "subsection S\nsubsection T\nset D = 1\nend\nset A = 2\nend\nset A = 3",
    "subsection S\nset A = 1",
    "subsection S\nend\nend",
    "subsection S # x\nend # x",
    "subsection S\nendx",
    "subsection S\nend x",
    "subsection S\nend\tx",
    "subsection S\nEnd",
    "SUBSECTION S\nEND",
    "Subsection S\nend",
    "subsection",
    "subsection ",
    "subsection #S\nend",
    "subsection Q\nend",
    "subsection T\nend",
    "subsection S\nset D = 1\nend",
    "end",
    "ending",
    "include",
    "include ",
    "include no such file",
    "INCLUDE no such file",
    "garbage",
    "= 1",
    "set A = x\xa0",
    "set A = über",
    "set A = " + std::string(5000, 'x'),
};

TEST(PrmOracle, TrickyTexts) {
  for (const std::string& text : tricky_texts) EXPECT_TRUE(agree(text));
}

/// A text out of pieces of the grammar, most of them right.
std::string random_text(std::mt19937_64& random) {
  static const std::vector<std::string> pieces{
      "set A = 1\n",
      "set B C = x y\n",
      "subsection S\n",
      "subsection T\n",
      "subsection U V\n",
      "end\n",
      "end\n",
      "end\n",
      "set D = 1\n",
      "set A",
      " = ",
      "=",
      "\\\n",
      "\\",
      "# c\n",
      "#",
      "\n",
      "\t",
      "  ",
      " ",
      "set ",
      "subsection ",
      "S",
      "B C",
      "include nothing\n",
      "\r\n",
      "\v",
      "END\n",
      "SET A = 2\n",
      "1, 2; 3",
  };
  std::string text;
  for (std::size_t n = 1 + random() % 14; n > 0; --n) text += pieces[random() % pieces.size()];
  return text;
}

/// A right text with a few letters removed, doubled, exchanged or replaced.
std::string mutated_text(std::mt19937_64& random) {
  std::string text =
      "# head\nset A = 1\nset B C = one \\\n  two # rest\nsubsection S\n  set A = 2\n  subsection T\n    set D = 3\n"
      "  end\nend\nsubsection U V\n  set A = \nend\n";
  static const std::string letters = " \t\n\\#=eEsSdAT;,1\r";
  for (std::size_t n = random() % 4; n > 0; --n) {
    const std::size_t at = random() % text.size();
    switch (random() % 4) {
      case 0:
        text.erase(at, 1);
        break;
      case 1:
        text.insert(at, 1, text[at]);
        break;
      case 2:
        std::swap(text[at], text[random() % text.size()]);
        break;
      default:
        text[at] = letters[random() % letters.size()];
    }
  }
  return text;
}

template <class Generator>
void compare_many(int n_texts, const Generator& generate) {
  std::mt19937_64 random(7);
  int n_accepted = 0;
  for (int i = 0; i < n_texts; ++i) {
    const std::string text = generate(random);
    ASSERT_TRUE(agree(text));
    n_accepted += by_reader(text).has_value();
  }
  // The comparison is worth something only if both outcomes are frequent.
  EXPECT_GT(n_accepted, n_texts / 50);
  EXPECT_LT(n_accepted, n_texts - n_texts / 50);
}

TEST(PrmOracle, RandomTexts) { compare_many(4000, random_text); }

TEST(PrmOracle, MutatedTexts) { compare_many(4000, mutated_text); }

}  // namespace
}  // namespace pseudorigid::scene
