#pragma once
/// The folder of one run's results, `<Output/Directory>/<scene name>/` or the argument of --output, and the names in
/// it.
///
/// Constructing one touches nothing (ranks other than 0 need only the names); prepare_fresh and prepare_resume do, and
/// are called once the input is known to be valid.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/run_lock.h"

namespace pseudorigid::io {

/// The scene's name: the file's name without `.prm`.
std::string scene_name(const std::filesystem::path& scene_file);

class RunDirectory {
 public:
  explicit RunDirectory(std::filesystem::path path) : path_(std::move(path)) {}
  RunDirectory(const std::filesystem::path& output_directory, const std::filesystem::path& scene_file,
               const std::optional<std::filesystem::path>& output_option);

  /// Creates the folder and removes the results of an earlier run: files that bear one of our names, those of the
  /// `movers` included (names of models and systems: `<name>.csv`, pictures, `comparison-<name>.csv`,
  /// `modes-<name>.csv` …), nothing else. UserError with path and reason if the folder cannot be created or written, if
  /// a pipe or a device has such a name, or if another run is at work in it. It is the caller's as long as he keeps the
  /// lock.
  RunLock prepare_fresh(std::span<const std::string> movers = {}) const;
  /// The same. UserError also if the folder does not have a checkpoint.
  RunLock prepare_resume(std::span<const std::string> movers = {}) const;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path used_prm() const { return path_ / "used.prm"; }
  std::filesystem::path manifest() const { return path_ / "manifest.json"; }
  std::filesystem::path log() const { return path_ / "log.txt"; }
  std::filesystem::path report() const { return path_ / "report.html"; }
  std::filesystem::path comparison_json() const { return path_ / "comparison.json"; }
  /// `name`: a model, a system, comparison, modes, …
  std::filesystem::path csv(std::string_view name) const;
  std::filesystem::path pvd(std::string_view model) const;
  std::filesystem::path checkpoint(std::string_view model) const;
  /// `graphics/<model>-000012.vtu`; the folder graphics is created by prepare_graphics, only for runs that want it.
  std::filesystem::path frame(std::string_view model, int index) const;
  void prepare_graphics() const;

 private:
  void require_writable() const;
  std::filesystem::path path_;
};

}  // namespace pseudorigid::io
