#include "io/run_directory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "io/files.h"
#include "scene/user_error.h"

namespace pseudorigid::io {

namespace fs = std::filesystem;

namespace {

/// Names of results that do not depend on models or systems. The function `owns` also accepts the names of checkpoints,
/// of the files of each model or system, of temporary files of a lock, and of incomplete files (partial_suffix).
constexpr std::array<std::string_view, 15> owned_names{
    "used.prm",      "manifest.json",   "log.txt",        "comparison.csv", "comparison.json",
    "modes.csv",     "modes.pvd",       "equilibria.csv", "shapes.csv",     "sweep.csv",
    "manifolds.csv", "connections.csv", "section.csv",    "report.html",    "trajectories.csv"};

/// Prefix of the temporary file from which RunLock makes the lock. A killed run may leave this file.
constexpr std::string_view abandoned_lock = "run.lock-";

bool matches(std::string_view name, std::string_view prefix, std::string_view suffix) {
  return name.size() >= prefix.size() + suffix.size() && name.starts_with(prefix) && name.ends_with(suffix);
}

std::string_view without_partial_suffix(std::string_view name) {
  if (name.ends_with(partial_suffix)) name.remove_suffix(partial_suffix.size());
  return name;
}

UserError cannot(const char* what, const fs::path& path, const std::string& reason) {
  return UserError(fmt::format("cannot {} the output directory '{}': {}", what, path.native(), reason));
}

/// Throws UserError if a pipe, a socket or a device in `directory` has a name for which owned(name) is true. A run
/// would wait for the other end of a pipe, and must not remove a device.
void require_no_pipes(const fs::path& directory, const auto& owned) {
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string kind = kind_unless_file(entry.path());
    if (!kind.empty() && !entry.is_directory() && owned(entry.path().filename().native()))
      throw UserError(fmt::format("'{}' has the name of a result and is {}; remove it, or choose another directory",
                                  entry.path().native(), kind));
  }
}

/// Removes the files and links in `directory` for whose names owned(name) is true. Folders are not removed.
void remove_files(const fs::path& directory, const auto& owned) {
  for (const auto& entry : fs::directory_iterator(directory))
    if (!fs::is_directory(entry.symlink_status()) && owned(entry.path().filename().native())) fs::remove(entry.path());
}

/// True if a new run may remove a file of this name from the run directory.
bool owns(std::string_view name, std::span<const std::string> movers) {
  name = without_partial_suffix(name);
  const auto is_of = [&](const std::string& mover) {
    return name == mover + ".csv" || name == mover + ".pvd" || name == "shapes-" + mover + ".csv" ||
           name == "comparison-" + mover + ".csv" || name == "modes-" + mover + ".csv" ||
           name == "equilibria-" + mover + ".csv" || name == "love-" + mover + ".csv" ||
           name == "comparison-" + mover + ".json";
  };
  return std::ranges::find(owned_names, name) != owned_names.end() || std::ranges::any_of(movers, is_of) ||
         matches(name, "checkpoint-", ".bin") || matches(name, abandoned_lock, "");
}

/// True if a new run may remove a file of this name from the folder graphics.
bool owns_graphics(std::string_view name, std::span<const std::string> movers) {
  name = without_partial_suffix(name);
  const auto is_frame_of = [&](const std::string& mover) {
    return matches(name, mover + "-", ".vtu") || matches(name, mover + "-", ".pvtu");
  };
  return is_frame_of("modes") || std::ranges::any_of(movers, is_frame_of);
}

/// The folder of the results, as the constructor of RunDirectory defines it.
fs::path locate(const fs::path& output_directory, const fs::path& scene_file, const std::optional<fs::path>& option) {
  if (option) return *option;
  const std::string name = scene_name(scene_file);
  if (name == "." || name == "..")
    throw UserError(
        fmt::format("{}: the name of this file without .prm, \"{}\", names no directory for the results below {}; "
                    "rename the file, or give --output",
                    scene_file.native(), name, output_directory.native()));
  return output_directory / name;
}

}  // namespace

std::string scene_name(const fs::path& scene_file) {
  const fs::path name = scene_file.filename();
  return name.extension() == ".prm" ? name.stem().native() : name.native();
}

RunDirectory::RunDirectory(const fs::path& output_directory, const fs::path& scene_file,
                           const std::optional<fs::path>& output_option)
    : path_(locate(output_directory, scene_file, output_option)) {}

void RunDirectory::require_writable() const {
  if (::access(path_.c_str(), W_OK | X_OK) != 0) throw cannot("write to", path_, std::strerror(errno));
}

RunLock RunDirectory::prepare_fresh(std::span<const std::string> movers) const {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw cannot("create", path_, error.message());
  require_writable();
  RunLock lock(path_);
  try {
    const auto is_ours = [&](std::string_view name) { return owns(name, movers); };
    const auto is_our_picture = [&](std::string_view name) { return owns_graphics(name, movers); };
    const fs::path graphics = path_ / "graphics";
    const bool has_graphics = fs::is_directory(graphics);
    require_no_pipes(path_, is_ours);
    if (has_graphics) require_no_pipes(graphics, is_our_picture);
    remove_files(path_, is_ours);
    if (has_graphics) {
      remove_files(graphics, is_our_picture);
      if (!fs::is_symlink(graphics) && fs::is_empty(graphics)) fs::remove(graphics);
    }
  } catch (const fs::filesystem_error& failure) {
    throw cannot("clear earlier results from", path_, failure.code().message());
  }
  return lock;
}

RunLock RunDirectory::prepare_resume(std::span<const std::string> movers) const {
  std::error_code error;
  const auto is_checkpoint = [](const fs::directory_entry& entry) {
    return matches(entry.path().filename().native(), "checkpoint-", ".bin");
  };
  if (std::none_of(fs::directory_iterator(path_, error), fs::directory_iterator(), is_checkpoint))
    throw UserError(fmt::format("nothing to resume: '{}' holds no checkpoint", path_.native()));
  require_writable();
  RunLock lock(path_);
  try {
    require_no_pipes(path_, [&](std::string_view name) { return owns(name, movers); });
    remove_files(path_, [](std::string_view name) { return matches(name, abandoned_lock, partial_suffix); });
  } catch (const fs::filesystem_error& failure) {
    throw cannot("clear abandoned locks from", path_, failure.code().message());
  }
  return lock;
}

void RunDirectory::require_place_for_graphics() const {
  const fs::path graphics = path_ / "graphics";
  std::error_code error;
  if (fs::exists(graphics, error) && !fs::is_directory(graphics, error))
    throw cannot("create", graphics, "another file has this name");
}

void RunDirectory::prepare_graphics() const {
  std::error_code error;
  fs::create_directory(path_ / "graphics", error);
  if (error) throw cannot("create", path_ / "graphics", error.message());
}

fs::path RunDirectory::csv(std::string_view name) const { return path_ / fmt::format("{}.csv", name); }
fs::path RunDirectory::pvd(std::string_view model) const { return path_ / fmt::format("{}.pvd", model); }
fs::path RunDirectory::checkpoint(std::string_view model) const {
  return path_ / fmt::format("checkpoint-{}.bin", model);
}
fs::path RunDirectory::frame(std::string_view model, int index) const {
  return path_ / "graphics" / fmt::format("{}-{:06}.vtu", model, index);
}

}  // namespace pseudorigid::io
