#pragma once
/// The folder with the results of one run, and the names of the files in this folder. The folder is
/// `<Output/Directory>/<scene name>/`, or the argument of the option --output.
///
/// The constructors do not access the disk, because ranks other than 0 need only the names. On rank 0, call
/// prepare_fresh or prepare_resume after the checks of the input.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/run_lock.h"

namespace pseudorigid::io {

/// The name of a scene: the name of its file without folders and without `.prm`.
std::string scene_name(const std::filesystem::path& scene_file);

class RunDirectory {
 public:
  explicit RunDirectory(std::filesystem::path path) : path_(std::move(path)) {}
  /// The folder is `output_option` if it is given, and otherwise `output_directory`/<scene name>. Throws UserError if
  /// there is no `output_option` and the scene name is "." or "..".
  RunDirectory(const std::filesystem::path& output_directory, const std::filesystem::path& scene_file,
               const std::optional<std::filesystem::path>& output_option);

  /// Creates and locks the folder, and removes the results of an earlier run. Results have fixed names such as
  /// `manifest.json`, or names such as `<name>.csv` and `modes-<name>.csv` with a model or system <name> in `movers`.
  /// Checkpoints are also results. In the folder graphics, the pictures of these models and of modes are results.
  /// Incomplete files of results and temporary files of locks are removed as well. Other files remain. The folder
  /// graphics is removed if it is then empty and not a link. Throws UserError, with path and reason, if the folder
  /// cannot be created, written or cleared. Also throws UserError if a pipe, a socket or a device has the name of a
  /// result. Throws the UserError of RunLock if another run uses or may use the folder. Throws WriteError if the lock
  /// cannot be written. The folder is locked until the returned object is destroyed.
  RunLock prepare_fresh(std::span<const std::string> movers = {}) const;
  /// Locks the folder for a resumed run. Results remain. Removes the temporary files of locks (RunLock) that killed
  /// runs have left. Throws UserError if the folder does not exist or does not contain a checkpoint. Also throws the
  /// errors of prepare_fresh, but does not examine the folder graphics. The folder is locked until the returned object
  /// is destroyed.
  RunLock prepare_resume(std::span<const std::string> movers = {}) const;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path used_prm() const { return path_ / "used.prm"; }
  std::filesystem::path manifest() const { return path_ / "manifest.json"; }
  std::filesystem::path log() const { return path_ / "log.txt"; }
  std::filesystem::path report() const { return path_ / "report.html"; }
  std::filesystem::path comparison_json() const { return path_ / "comparison.json"; }
  /// The file `<name>.csv`. `name` is the name of the files of a run of a model or system, or the name of another
  /// result such as "comparison" or "modes".
  std::filesystem::path csv(std::string_view name) const;
  /// The file `<model>.pvd` with the list of the pictures.
  std::filesystem::path pvd(std::string_view model) const;
  /// The file `checkpoint-<model>.bin`.
  std::filesystem::path checkpoint(std::string_view model) const;
  /// The picture with the number `index`, for example `graphics/<model>-000012.vtu` for 12.
  std::filesystem::path frame(std::string_view model, int index) const;
  /// Creates the folder graphics if it does not exist. Throws UserError if this fails. A run must call this function
  /// before it writes pictures.
  void prepare_graphics() const;
  /// Throws UserError if `graphics` exists in the run directory and is not a folder.
  void require_place_for_graphics() const;

 private:
  void require_writable() const;  ///< throws UserError if no file can be created in the folder
  std::filesystem::path path_;
};

}  // namespace pseudorigid::io
