#pragma once
/// ParaView's list of the pictures of a run, with the time and the file of each picture. When a picture is added, a new
/// file replaces the list atomically.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pseudorigid::io {

/// The list of the pictures, in memory and in the file `path`.
class PvdCollection {
 public:
  struct Frame {
    double time;
    std::filesystem::path file;
    long number() const;  ///< number at the end of the name: 12 for "reduced-000012.vtu"; −1 if there is none
  };
  /// Starts an empty list. The file is not written before the first call of `add`.
  explicit PvdCollection(std::filesystem::path path) : path_(std::move(path)) {}
  /// Reads the list of an earlier run, and keeps the pictures before the time `until`. If the file does not exist, the
  /// list is empty. Throws UserError if the file cannot be read. Throws UserError "path:line: …" if an entry does not
  /// have the form that `add` writes.
  static PvdCollection resume(std::filesystem::path path, double until);

  /// Adds a picture and writes the list. The paths in the list are relative to the folder of the list. The run
  /// directory can therefore be moved. Throws WriteError if the list cannot be written.
  void add(double time, const std::filesystem::path& file);
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  std::filesystem::path path_;
  std::vector<Frame> frames_;
};

}  // namespace pseudorigid::io
