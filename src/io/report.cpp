#include "io/report.h"

#include <algorithm>

#include "io/files.h"
#include "io/manifest.h"
#include "io/report_frames.h"

namespace pseudorigid::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view before_name = "data-file=\"", after_name = "\">";

/// The text with & and < escaped as in HTML. Otherwise the text could contain the end of its element.
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

/// The page with the names in `movers` in place of the placeholder {mover}. Each element must be on a line of its own.
/// A line with {mover} in the file name of its element is repeated for every name.
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

/// The text of the element with the file name `name`. For "frames-….csv" it is the result of table_of_frames, and
/// otherwise the text of the file of the run, or an empty text if the file does not exist. `affine` has the names of
/// the trajectories whose motion is affine. Throws UserError if an existing file other than a picture cannot be read.
std::string text_of(const RunDirectory& directory, std::string_view name, std::span<const std::string> affine) {
  constexpr std::string_view frames = "frames-", csv = ".csv";
  if (name.starts_with(frames)) {
    const std::string mover(name.substr(frames.size(), name.size() - frames.size() - csv.size()));
    return table_of_frames(directory.pvd(mover), std::ranges::find(affine, mover) != affine.end());
  }
  const fs::path path = directory.path() / name;
  return is_there(path) ? read_file(path) : std::string();
}

}  // namespace

std::string report_of(const RunDirectory& directory, std::span<const std::string> movers, std::string_view empty) {
  const std::string page = page_of(empty, movers);
  const std::vector<std::string> affine = affine_movers_in(directory.manifest());
  std::string report;
  std::string_view rest = page;
  for (std::size_t at = rest.find(before_name); at != rest.npos; at = rest.find(before_name)) {
    at += before_name.size();
    const std::size_t end = rest.find(after_name, at);
    const std::string_view name = rest.substr(at, end - at);
    report.append(rest.substr(0, end + after_name.size()));
    report += escaped(text_of(directory, name, affine));
    rest.remove_prefix(end + after_name.size());
  }
  return report.append(rest);
}

void write_report(const RunDirectory& directory, std::span<const std::string> movers) {
  write_file_atomically(directory.report(), {report_of(directory, movers)});
}

}  // namespace pseudorigid::io
