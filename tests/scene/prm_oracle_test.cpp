/// The reader of .prm files against deal.II's ParameterHandler: both accept a text and find the same values, or both
/// refuse it. The only difference provoked here is the documented one, blanks inside names.

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "support/prm_oracle.h"

namespace pseudorigid::scene {
namespace {

const testing::PrmOracle oracle(
    {{"A", "unset"}, {"B C", "unset"}, {"S/A", "unset"}, {"S/T/D", "unset"}, {"U V/A", "unset"}});

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
  for (const std::string& text : tricky_texts) EXPECT_TRUE(oracle.agree(text));
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
    ASSERT_TRUE(oracle.agree(text));
    n_accepted += oracle.by_reader(text).has_value();
  }
  // The comparison is worth something only if both outcomes are frequent.
  EXPECT_GT(n_accepted, n_texts / 50);
  EXPECT_LT(n_accepted, n_texts - n_texts / 50);
}

TEST(PrmOracle, RandomTexts) { compare_many(4000, random_text); }

TEST(PrmOracle, MutatedTexts) { compare_many(4000, mutated_text); }

}  // namespace
}  // namespace pseudorigid::scene
