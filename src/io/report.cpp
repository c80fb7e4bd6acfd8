#include "io/report.h"

#include <algorithm>

#include "io/files.h"

namespace pseudorigid::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view before_name = "data-file=\"", after_name = "\">";

/// What cannot be taken for the end of an element.
std::string escaped(const std::string& text) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else
      result += c;
  }
  return result;
}

/// The report template with the placeholders of each trajectory expanded.
std::string page_of(std::string_view page, std::span<const std::string> movers) {
  constexpr std::string_view name = "data-file=\"", of_mover = "{mover}";
  std::string text;
  std::string_view rest = page;
  while (!rest.empty()) {
    const std::size_t newline = std::min(rest.find('\n'), rest.size() - 1);
    const std::string_view line = rest.substr(0, newline + 1);
    rest.remove_prefix(line.size());
    const std::size_t at = line.find(of_mover);
    if (at == line.npos || line.find(name) == line.npos) {
      text += line;
      continue;
    }
    for (const std::string& mover : movers) {
      text += line.substr(0, at);
      text += mover;
      text += line.substr(at + of_mover.size());
    }
  }
  return text;
}

}  // namespace

std::string report_of(const RunDirectory& directory, std::span<const std::string> movers, std::string_view empty) {
  const std::string page = page_of(empty, movers);
  std::string report;
  std::string_view rest = page;
  for (std::size_t at = rest.find(before_name); at != rest.npos; at = rest.find(before_name)) {
    at += before_name.size();
    const std::size_t end = rest.find(after_name, at);
    const std::string_view name = rest.substr(at, end - at);
    report.append(rest.substr(0, end + after_name.size()));
    if (const fs::path path = directory.path() / name; is_there(path)) report += escaped(read_file(path));
    rest.remove_prefix(end + after_name.size());
  }
  return report.append(rest);
}

void write_report(const RunDirectory& directory, std::span<const std::string> movers) {
  write_file_atomically(directory.report(), {report_of(directory, movers)});
}

}  // namespace pseudorigid::io
