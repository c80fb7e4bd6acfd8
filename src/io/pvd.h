#pragma once
/// ParaView's list of the pictures of a run, with the time and file of each. Each new picture replaces the list
/// atomically.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pseudorigid::io {

class PvdCollection {
 public:
  struct Frame {
    double time;
    std::filesystem::path file;
    long number() const;  ///< number at the end of the name: 12 for "reduced-000012.vtu"
  };
  explicit PvdCollection(std::filesystem::path path) : path_(std::move(path)) {}
  /// Reads the list of an earlier run, if one exists, and removes the pictures from the time `until` on. UserError
  /// "path:line: …" for a line that `add` does not write.
  static PvdCollection resume(std::filesystem::path path, double until);

  /// Adds a picture. The list has paths relative to its folder, so that the run directory can be moved.
  void add(double time, const std::filesystem::path& file);
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  std::filesystem::path path_;
  std::vector<Frame> frames_;
};

}  // namespace pseudorigid::io
