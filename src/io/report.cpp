#include "io/report.h"

#include "io/files.h"

namespace pseudorigid::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view before_name = "data-file=\"", after_name = "\">", of_system = "{system}";

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

std::string with_system(std::string_view name, const std::string& system) {
  return name.starts_with(of_system) ? system + std::string(name.substr(of_system.size())) : std::string(name);
}

}  // namespace

std::string report_of(const RunDirectory& directory, const std::string& system) {
  std::string report;
  std::string_view rest = report_page();
  for (std::size_t at = rest.find(before_name); at != rest.npos; at = rest.find(before_name)) {
    at += before_name.size();
    const std::size_t end = rest.find(after_name, at);
    const std::string name = with_system(rest.substr(at, end - at), system);
    report += std::string(rest.substr(0, at)) + name + std::string(after_name);
    rest.remove_prefix(end + after_name.size());
    if (const fs::path path = directory.path() / name; fs::is_regular_file(path)) report += escaped(read_file(path));
  }
  return report.append(rest);
}

void write_report(const RunDirectory& directory, const std::string& system) {
  write_file_atomically(directory.report(), {report_of(directory, system)});
}

}  // namespace pseudorigid::io
