/// docs/data/statements.md against the sources of the tests: what it names exists, and no statement or correction is
/// missing.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace {

/// "Suite.Name in folder/file.cpp"
using Tests = std::set<std::string>;

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Adds what `expression` finds, with the test's name made of the groups 1 and 2 and the file's name given or group 3.
void add_tests(const std::string& text, const std::regex& expression, const std::string& file, Tests& tests) {
  for (std::sregex_iterator match(text.begin(), text.end(), expression), end; match != end; ++match)
    tests.insert((*match)[1].str() + "." + (*match)[2].str() + " in " + (file.empty() ? (*match)[3].str() : file));
}

Tests tests_of_table(const std::string& page) {
  Tests tests;
  add_tests(page, std::regex(R"(\| `(\w+)` `(\w+)` `([\w/]+\.cpp)` \|)"), "", tests);
  return tests;
}

/// The tests of all sources under tests/, those of statements and corrections only if asked for.
Tests tests_of_sources(bool numbered_only) {
  const std::string suite = numbered_only ? "((?:Statement|Correction)_\\w+)" : "(\\w+)";
  const std::regex expression("\\b(?:TYPED_)?TEST(?:_F|_P)?\\(" + suite + ",\\s*(\\w+)\\)");
  const std::filesystem::path root = TESTS_FOLDER;
  Tests tests;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root))
    if (entry.path().extension() == ".cpp")
      add_tests(content(entry.path()), expression, entry.path().lexically_relative(root).generic_string(), tests);
  return tests;
}

/// What is in a and not in b, one a line.
std::string missing(const Tests& a, const Tests& b) {
  std::string list;
  for (const std::string& test : a)
    if (!b.contains(test)) list += test + "\n";
  return list;
}

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), with);
}

TEST(StatementsTable, EveryTestThatItNamesExists) {
  const Tests table = tests_of_table(content(STATEMENTS_PAGE));
  EXPECT_GT(table.size(), 100u);
  EXPECT_EQ(missing(table, tests_of_sources(false)), "");
}

TEST(StatementsTable, EveryTestOfAStatementOrCorrectionIsInIt) {
  EXPECT_EQ(missing(tests_of_sources(true), tests_of_table(content(STATEMENTS_PAGE))), "");
}

TEST(StatementsTable, EveryRowNamesATestAndItsFile) {
  std::string page = content(STATEMENTS_PAGE);
  page.resize(page.find("## Without a test"));  // there rows have a reason in place of a test
  const std::regex row("\n\\| (?!number)"), test("`(Statement|Correction)_\\w+` `\\w+` `");
  const auto count = [&page](const std::regex& expression) {
    return std::distance(std::sregex_iterator(page.begin(), page.end(), expression), std::sregex_iterator());
  };
  EXPECT_EQ(count(row), count(test));
}

/// Propositions, exercises, examples and remarks of the sections 5.1 to 5.8, which the book counts together.
TEST(StatementsTable, EveryNumberedStatementIsInIt) {
  const std::string page = content(STATEMENTS_PAGE);
  constexpr std::array<int, 8> n_statements{2, 2, 1, 1, 2, 20, 12, 9};
  for (int section = 1; section <= 8; ++section)
    for (int n = 1; n <= n_statements[section - 1]; ++n) {
      const std::string number = "5." + std::to_string(section) + "." + std::to_string(n);
      EXPECT_TRUE(std::regex_search(
          page, std::regex("\n\\|[^|]*" + std::regex_replace(number, std::regex("\\."), "\\.") + "(?!\\d)")))
          << number;
    }
}

TEST(StatementsTable, EveryCorrectionHasATest) {
  const std::string page = content(STATEMENTS_PAGE);
  for (int n = 1; n <= 13; ++n) EXPECT_NE(page.find("`Correction_" + std::to_string(n) + "`"), std::string::npos) << n;
}

/// The comparisons see a row that is missing and one that names what does not exist.
TEST(StatementsTable, AMissingTestIsNoticed) {
  const std::string page = content(STATEMENTS_PAGE), test = "SecondMomentOfTheBall";
  const std::string full = "Statement_5_7_2." + test + " in reduced/statements_pseudo_rigid_test.cpp\n";
  const Tests without = tests_of_table(replaced(page, "`" + test + "`", "nothing"));
  EXPECT_EQ(missing(tests_of_sources(true), without), full);
  const Tests misspelt = tests_of_table(replaced(page, test, test + "s"));
  EXPECT_EQ(missing(misspelt, tests_of_sources(false)), replaced(full, test, test + "s"));
}

}  // namespace
