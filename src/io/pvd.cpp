#include "io/pvd.h"

#include <fmt/format.h>

#include <regex>

#include "io/files.h"

namespace pseudorigid::io {

PvdCollection PvdCollection::resume(std::filesystem::path path, double until) {
  PvdCollection collection(std::move(path));
  if (!std::filesystem::exists(collection.path_)) return collection;
  // Of its own files alone: one frame a line, as `add` writes them.
  const std::string text = read_file(collection.path_);
  static const std::regex frame(R"re(<DataSet timestep="([^"]*)" part="0" file="([^"]*)"/>)re");
  for (std::sregex_iterator match(text.begin(), text.end(), frame), end; match != end; ++match)
    if (const double time = std::stod((*match)[1]); time < until)
      collection.frames_.push_back({time, collection.path_.parent_path() / (*match)[2].str()});
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
