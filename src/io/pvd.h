#pragma once
/// ParaView's list of the frames of a run: (time, file), rewritten atomically after each frame.

#include <filesystem>
#include <string>
#include <vector>

namespace pseudorigid::io {

class PvdCollection {
 public:
  struct Frame {
    double time;
    std::filesystem::path file;
  };
  /// `frames`: those written before a resume.
  explicit PvdCollection(std::filesystem::path path, std::vector<Frame> frames = {});

  /// Files are listed relative to the collection, so that a run directory can be moved.
  void add(double time, const std::filesystem::path& file);
  std::size_t n_frames() const { return frames_.size(); }

 private:
  std::filesystem::path path_;
  std::vector<Frame> frames_;
};

}  // namespace pseudorigid::io
