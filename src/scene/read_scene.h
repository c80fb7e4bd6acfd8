#pragma once
/// From a parameter file and `--set` overrides to a Scene. Each value is checked by itself here; scene/validate.h
/// checks combinations of entries.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The origin of the value of each entry, for messages.
class Origins {
 public:
  Origins() = default;
  explicit Origins(std::string file) : file_(std::move(file)) {}

  void record(const std::string& path, std::string where) { where_[path] = std::move(where); }

  /// "scene.prm:12", "--set", or the file's name for an entry left at its default.
  std::string of(const std::string& path) const;
  bool is_override(const std::string& path) const;
  /// The entries that got a value, by path.
  const std::map<std::string, std::string>& all() const { return where_; }

 private:
  std::string file_ = "scene";
  std::map<std::string, std::string> where_;
};

struct ReadScene {
  Scene scene;
  Origins origins;
  std::string name;                     ///< name of the scene: the file's name without ".prm"
  std::vector<std::string> warnings{};  ///< a sentence each
};

/// Reads the file, then the overrides ("Section/Entry=value"); the last setting of an entry wins. Throws UserError, one
/// sentence that begins with file:line or --set, for files that cannot be read, for unknown names and for values out of
/// range. The catalogue must outlive the scene.
ReadScene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     const Catalogue& catalogue);

/// The scene with its expressions evaluated for these parameters. Throws UserError as read_scene does.
Scene with_parameters(Scene scene, const ParameterValues& parameters, const Origins& origins = {});

}  // namespace pseudorigid::scene
