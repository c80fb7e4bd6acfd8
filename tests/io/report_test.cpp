/// The page of a run: every file stands in its element, as in HTML, and nothing else changes.

#include "io/report.h"

#include <gtest/gtest.h>

#include "scratch.h"

namespace pseudorigid::io::test {
namespace {

/// What stands in the element of the file.
std::string element(const std::string& page, const std::string& file) {
  const std::string head = "data-file=\"" + file + "\">";
  const auto begin = page.find(head);
  if (begin == page.npos) return "no element for " + file;
  const auto text = begin + head.size();
  return page.substr(text, page.find("</script>", text) - text);
}

std::string without(std::string page, const std::string& text) {
  const auto at = page.find(text);
  return at == page.npos ? "not there: " + text : page.erase(at, text.size());
}

TEST(Report, HoldsTheFilesOfTheRunInTheirElements) {
  const ScratchDirectory scratch;
  put(scratch / "manifest.json", "{\"title\": \"a < b && c </script>\"}");
  put(scratch / "used.prm", "set Title = x\n");
  write_report(RunDirectory(scratch.path()), {});
  const std::string page = contents(scratch / "report.html");
  const std::string manifest = "{\"title\": \"a &lt; b &amp;&amp; c &lt;/script>\"}";
  EXPECT_EQ(element(page, "manifest.json"), manifest);
  EXPECT_EQ(element(page, "used.prm"), "set Title = x\n");
  EXPECT_EQ(element(page, "comparison.json"), "");

  std::string empty(report_page());
  int n_of_movers = 0;
  for (auto at = empty.find("{mover}"); at != empty.npos; at = empty.find("{mover}"), ++n_of_movers) {
    const auto begin = empty.rfind('\n', at) + 1;
    empty.erase(begin, empty.find('\n', at) + 1 - begin);
  }
  EXPECT_EQ(n_of_movers, 8);
  EXPECT_EQ(without(without(page, manifest), "set Title = x\n"), empty);
}

TEST(Report, TakesTheTablesOfWhatMoves) {
  const ScratchDirectory scratch;
  put(scratch / "torus.csv", "time,theta\n0,1\n");
  put(scratch / "copy.csv", "time,Q11\n0,1\n");
  put(scratch / "shapes-copy.csv", "time,face\n0,1\n");
  write_report(RunDirectory(scratch.path()), std::vector<std::string>{"torus", "copy"});
  EXPECT_EQ(element(contents(scratch / "report.html"), "copy.csv"), "time,Q11\n0,1\n");
  EXPECT_EQ(element(contents(scratch / "report.html"), "torus.csv"), "time,theta\n0,1\n");
  EXPECT_EQ(element(contents(scratch / "report.html"), "shapes-copy.csv"), "time,face\n0,1\n");
}

}  // namespace
}  // namespace pseudorigid::io::test
