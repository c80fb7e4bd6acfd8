/// The reader of .prm files by itself: syntax, includes, and files that are no parameter files.

#include "scene/prm_reader.h"

#include "scene_files.h"

namespace pseudorigid::scene {
namespace {

using test::SceneFiles;

/// "path=value@line" for each setting.
std::vector<std::string> settings(const std::string& text) {
  std::vector<std::string> result;
  read_prm_text(text, "f", [&](const Statement& s) {
    if (s.value) result.push_back(s.path + "=" + *s.value + "@" + std::to_string(s.line));
  });
  return result;
}

using List = std::vector<std::string>;

TEST(PrmReader, ReadsSettingsWithPathAndLine) {
  EXPECT_EQ(settings("set A = 1\nsubsection S\n  set B = x y\n  subsection T\n set C=\n end\nend\nset D = 4"),
            (List{"A=1@1", "S/B=x y@3", "S/T/C=@5", "D=4@8"}));
}

TEST(PrmReader, ReportsSubsectionsToo) {
  List sections;
  read_prm_text("subsection S\nsubsection  T  U\nend\nend", "f", [&](const Statement& s) {
    if (!s.value) sections.push_back(s.path + "@" + s.where());
  });
  EXPECT_EQ(sections, (List{"S@f:1", "S/T U@f:2"}));
}

TEST(PrmReader, DropsCommentsAndWhiteSpace) {
  EXPECT_EQ(settings("# all\n\n  \t set\tA\t = x # y # z\r\n#set B = 1\nset C = # nothing"), (List{"A=x@3", "C=@5"}));
}

TEST(PrmReader, CollapsesBlanksInNamesButNotInValues) {
  EXPECT_EQ(settings("subsection  S \t T\nset A   B = 1  2\nend"), (List{"S T/A B=1  2@2"}));
}

TEST(PrmReader, ContinuesLines) {
  EXPECT_EQ(settings("set A = 1, \\\n    2,\\\n\t3\nset B = 4"), (List{"A=1, 2,3@1", "B=4@4"}));
  EXPECT_EQ(settings("# comment \\\nmore of it\nset B = x\\"), (List{"B=x@3"}));
  EXPECT_EQ(settings("set A = the \\\nend of it"), (List{"A=the end of it@1"}));
  EXPECT_EQ(settings("\\\nset A = 1"), (List{"A=1@1"}));
  EXPECT_EQ(settings("set A = x\\\\\ny"), (List{"A=x\\y@1"}));
}

TEST(PrmReader, KnowsKeywordsInCapitals) { EXPECT_EQ(settings("SUBSECTION S\nSET A = 1\nEND"), (List{"S/A=1@2"})); }

TEST(PrmReader, SkipsByteOrderMark) { EXPECT_EQ(settings("\xEF\xBB\xBFset A = 1"), (List{"A=1@1"})); }

class PrmSyntaxErrors : public ::testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(PrmSyntaxErrors, NameFileLineAndExpectation) {
  const auto& [text, expected] = GetParam();
  try {
    settings(text);
    FAIL() << "accepted: " << text;
  } catch (const UserError& error) {
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

const std::string nul_byte = std::string("set A = x") + '\0' + "y";

INSTANTIATE_TEST_SUITE_P(
    All, PrmSyntaxErrors,
    ::testing::Values(std::pair{"set A = 1\ngarbage",
                                "f:2: expected \"set Name = value\", \"subsection Name\", \"end\" or "
                                "\"include FILE\", got \"garbage\""},
                      std::pair{"Set A = 1", "f:1: expected \"set Name = value\""},
                      std::pair{"set", "f:1: expected \"set Name"}, std::pair{"subsection", "f:1: expected \"set Name"},
                      std::pair{"include", "f:1: expected \"set Name"},
                      std::pair{"set A 1", "f:1: expected \"set Name = value\", but there is no \"=\" in \"A 1\""},
                      std::pair{"set = 1", "f:1: the name of the entry is missing"},
                      std::pair{"set S/A = 1", "f:1: a name holds no \"/\", got \"S/A\""},
                      std::pair{"subsection S\nend of S", "f:2: expected \"end\" alone, got \"end of S\""},
                      std::pair{"subsection S\nendS", "f:2: expected \"end\" alone"},
                      std::pair{"set A = 1\nend", "f:2: this \"end\" closes no subsection"},
                      std::pair{"\nsubsection S\nset A = 1", "f:2: the subsection \"S\" is not closed by an \"end\""},
                      std::pair{"set A = \\\n1\n2", "f:3: expected \"set Name"},
                      std::pair{nul_byte, "f:1: expected text, got control characters"},
                      std::pair{"\x7f"
                                "ELF\x02\x01",
                                "f:1: expected text"},
                      std::pair{"\nset A = C:\\out\\\nset B = 1", "f:2: the backslash at the end of this line"},
                      std::pair{"# C:\\\n\tSET B = 1 # b", "f:1: the backslash at the end of this line"},
                      std::pair{"subsection S\nset A = 1, \\\n 2, \\\n end", "f:3: the backslash"},
                      std::pair{"set A = x\\\nsubsection S", "joins the next one to it, \"subsection S\""},
                      std::pair{"include /dev/null", "f:1: expected a file to include"},
                      std::pair{"set\u00A0A = 1", "f:1: expected \"set Name = value\""},
                      std::pair{"set\u00A0A = 1", "the no-break space U+00A0"},
                      std::pair{"include no such file", "f:1: cannot open the parameter file \"no such file\""}));

using PrmFiles = SceneFiles;

std::vector<std::string> settings_of(const std::filesystem::path& file) {
  List result;
  read_prm_text(text_of_prm(file), file, [&](const Statement& s) {
    if (s.value) result.push_back(s.path + "=" + *s.value);
  });
  return result;
}

TEST_F(PrmFiles, IncludeIsRelativeToTheIncludingFile) {
  write("sub/material.prm", "subsection Material\ninclude deep/er.prm\nend");
  write("sub/deep/er.prm", "set Law = x");
  const auto file = write("scene.prm", "include sub/material.prm\nset A = 1");
  EXPECT_EQ(settings_of(file), (List{"Material/Law=x", "A=1"}));
}

TEST_F(PrmFiles, ErrorsInIncludedFilesNameThatFile) {
  write("part.prm", "\nset A");
  const auto file = write("scene.prm", "include part.prm");
  EXPECT_EQ(complaint([&] { settings_of(file); }).substr(0, 11), "part.prm:2:");
}

TEST_F(PrmFiles, IncludedFileMustCloseItsSubsections) {
  write("open.prm", "subsection S");
  const auto opens = write("scene.prm", "include open.prm\nend");
  EXPECT_EQ(complaint([&] { settings_of(opens); }), "open.prm:1: the subsection \"S\" is not closed by an \"end\"");
  write("close.prm", "end");
  const auto closes = write("scene.prm", "subsection S\ninclude close.prm");
  EXPECT_EQ(complaint([&] { settings_of(closes); }),
            "close.prm: this included file closes a subsection that it did not open");
}

TEST_F(PrmFiles, CyclesAreRefused) {
  write("a.prm", "include b.prm");
  write("b.prm", "set X = 1\ninclude ./a.prm");
  EXPECT_EQ(complaint([&] { settings_of(folder_ / "a.prm"); }), "b.prm:2: the file \"./a.prm\" includes itself");
}

TEST_F(PrmFiles, ADiamondIsNoCycle) {
  write("leaf.prm", "set X = 1");
  const auto file = write("scene.prm", "include leaf.prm\ninclude leaf.prm");
  EXPECT_EQ(settings_of(file), (List{"X=1", "X=1"}));
}

TEST_F(PrmFiles, ExponentialIncludesEnd) {
  for (int i = 0; i < 40; ++i) {
    const std::string next = "include " + std::to_string(i + 1) + ".prm\n";
    write(std::to_string(i) + ".prm", next + next);
  }
  write("40.prm", "");
  EXPECT_NE(complaint([&] { settings_of(folder_ / "0.prm"); }).find("more than 100 files"), std::string::npos);
}

TEST_F(PrmFiles, ThingsThatAreNoParameterFiles) {
  EXPECT_NE(complaint([&] { settings_of(folder_.path()); }).find("is a directory"), std::string::npos);
  EXPECT_EQ(complaint([&] { settings_of(folder_ / "none.prm"); }),
            "none.prm: cannot open the parameter file \"none.prm\"");
  EXPECT_NE(complaint([&] { settings_of("/dev/zero"); }).find("larger than 1 MiB"), std::string::npos);
  EXPECT_EQ(settings_of("/dev/null"), List{});
  EXPECT_EQ(settings_of(write("empty.prm", "")), List{});
}

TEST_F(PrmFiles, HugeLinesAreRead) {
  const std::string value(1'000'000, 'x');
  EXPECT_EQ(settings_of(write("scene.prm", "set A = " + value)), List{"A=" + value});
  std::string continued = "set A = ";
  for (int i = 0; i < 300'000; ++i) continued += "\\\n";
  EXPECT_EQ(settings_of(write("scene.prm", continued)), List{"A="});
  EXPECT_LT(complaint([&] { settings_of(write("scene.prm", value)); }).size(), 400U);
}

}  // namespace
}  // namespace pseudorigid::scene
