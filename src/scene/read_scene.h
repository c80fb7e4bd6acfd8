#pragma once
/// Reader of a scene from a parameter file and from `--set` overrides. It checks each value by itself. The functions of
/// scene/validate.h check combinations of entries.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The origin of the value of each entry, used in messages.
class Origins {
 public:
  Origins() = default;
  explicit Origins(std::string file) : file_(std::move(file)) {}

  void record(const std::string& path, std::string where) { where_[path] = std::move(where); }

  /// "scene.prm:12", "--set", or the name of the file for an entry with its default value.
  std::string of(const std::string& path) const;
  bool is_override(const std::string& path) const;
  /// The origins of the entries with a value, by path.
  const std::map<std::string, std::string>& all() const { return where_; }

 private:
  std::string file_ = "scene";
  std::map<std::string, std::string> where_;
};

struct ReadScene {
  Scene scene;
  Origins origins;
  std::string name;                     ///< name of the scene: name of the file without ".prm"
  std::vector<std::string> warnings{};  ///< one sentence each
};

/// Reads the file and then the overrides ("Section/Entry=value"). The last value of an entry is used. Throws UserError
/// if a file cannot be read, a name is unknown or a value is out of range. The message is one sentence that begins with
/// file:line or --set. The catalogue must outlive the scene.
ReadScene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     const Catalogue& catalogue);

/// The scene with its expressions evaluated for the given parameters. Throws UserError as read_scene does.
Scene with_parameters(Scene scene, const ParameterValues& parameters, const Origins& origins = {});

}  // namespace pseudorigid::scene
