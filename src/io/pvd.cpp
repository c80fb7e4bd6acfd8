#include "io/pvd.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>

#include "io/files.h"
#include "scene/user_error.h"

namespace pseudorigid::io {

namespace {

/// The number if the whole text is a number of type Number. The result is empty for other texts.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// The number between the last hyphen and the extension in the file name of a picture. The result is empty if there is
/// no number.
std::optional<long> number_of(const std::filesystem::path& file) {
  const std::string name = file.stem().string();
  return number_in<long>(std::string_view(name).substr(name.rfind('-') + 1));
}

/// The picture in a line that `add` wrote. The result is empty for other lines.
std::optional<PvdCollection::Frame> frame_of(const std::string& line, const std::filesystem::path& folder) {
  static const std::regex frame(R"re(\s*<DataSet timestep="([^"]*)" part="0" file="([^"]*)"/>\s*)re");
  std::smatch match;
  if (!std::regex_match(line, match, frame)) return {};
  const auto time = number_in<double>(match[1].str());
  const std::filesystem::path file = folder / match[2].str();
  if (!time || !std::isfinite(*time) || !number_of(file)) return {};
  return PvdCollection::Frame{*time, file};
}

}  // namespace

long PvdCollection::Frame::number() const { return number_of(file).value_or(-1); }

PvdCollection PvdCollection::resume(std::filesystem::path path, double until) {
  PvdCollection collection(std::move(path));
  if (!is_there(collection.path_)) return collection;
  std::istringstream text(read_file(collection.path_));
  int number = 1;
  for (std::string line; std::getline(text, line); ++number) {
    if (line.find("<DataSet") == line.npos) continue;
    const auto frame = frame_of(line, collection.path_.parent_path());
    if (!frame)
      throw UserError(
          fmt::format("{}:{}: expected <DataSet timestep=\"TIME\" part=\"0\" file=\"NAME-NUMBER.vtu\"/>, as the run "
                      "has written it; without this line the picture is left out of the list",
                      collection.path_.native(), number));
    if (frame->time < until) collection.frames_.push_back(*frame);
  }
  return collection;
}

void PvdCollection::add(double time, const std::filesystem::path& file) {
  frames_.push_back({time, file});
  std::string out = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
  for (const auto& frame : frames_)
    out += fmt::format("<DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", frame.time,
                       frame.file.lexically_proximate(path_.parent_path()).generic_string());
  out += "</Collection>\n</VTKFile>\n";
  write_file_atomically(path_, {out});
}

}  // namespace pseudorigid::io
