#pragma once
/// ParaView's list of the pictures of a run (a .pvd file), with the time and the file of each picture. When a picture
/// is added, a new list replaces the file atomically.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pseudorigid::io {

/// The list of the pictures, in memory and in the file `path`.
class PvdCollection {
 public:
  /// The time, in the units of the user, and the file of a picture.
  struct Frame {
    double time;
    std::filesystem::path file;
    long number() const;  ///< number at the end of the file name: 12 for "reduced-000012.vtu"; −1 without a number
  };
  /// Starts an empty list. The file is not written before the first call of `add`.
  explicit PvdCollection(std::filesystem::path path) : path_(std::move(path)) {}
  /// Reads the file of an earlier run. The result contains the pictures before the time `until`. If the file does not
  /// exist, the result is empty. Throws UserError if the file cannot be read. Throws UserError "path:line: …" if a
  /// picture in the file does not have the form that `add` writes.
  static PvdCollection resume(std::filesystem::path path, double until);

  /// Adds a picture and writes the file. The paths in the file are relative to the folder of the file, so that a user
  /// can move the run directory. Throws WriteError if the file cannot be written.
  void add(double time, const std::filesystem::path& file);
  const std::vector<Frame>& frames() const { return frames_; }

 private:
  std::filesystem::path path_;
  std::vector<Frame> frames_;
};

}  // namespace pseudorigid::io
