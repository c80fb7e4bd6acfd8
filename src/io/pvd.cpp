#include "io/pvd.h"

#include <fmt/format.h>

#include "io/files.h"

namespace pseudorigid::io {

PvdCollection::PvdCollection(std::filesystem::path path, std::vector<Frame> frames)
    : path_(std::move(path)), frames_(std::move(frames)) {}

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
