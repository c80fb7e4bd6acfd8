#pragma once
/// ParaView's list of the frames of a run: (time, file), rewritten atomically after each frame.

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
    long number() const;  ///< the number at the end of the file's name: 12 of "reduced-000012.vtu"
  };
  explicit PvdCollection(std::filesystem::path path) : path_(std::move(path)) {}
  /// The list that an earlier run has left there, if it has, without its frames from that time on. UserError
  /// "path:line: …" for a line that `add` does not write.
  static PvdCollection resume(std::filesystem::path path, double until);

  /// Files are listed relative to the collection, so that a run directory can be moved.
  void add(double time, const std::filesystem::path& file);
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  std::filesystem::path path_;
  std::vector<Frame> frames_;
};

}  // namespace pseudorigid::io
