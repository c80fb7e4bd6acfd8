#pragma once
/// Reader of a scene from a parameter file and from `--set` overrides. The functions of this file check the value of
/// each single entry, and the functions of scene/validate.h check combinations of entries.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The origins of the values of the entries. Messages about an entry begin with its origin.
class Origins {
 public:
  Origins() = default;
  explicit Origins(std::string file) : file_(std::move(file)) {}

  void record(const std::string& path, std::string where) { where_[path] = std::move(where); }

  /// Returns the origin of the value of an entry, for example "scene.prm:12" or "--set". For an entry that neither the
  /// file nor --set sets, returns the name of the file.
  std::string of(const std::string& path) const;
  /// Returns true if --set sets the entry.
  bool is_override(const std::string& path) const;
  /// The origins of all entries that the file or an override sets, path → origin.
  const std::map<std::string, std::string>& all() const { return where_; }

 private:
  std::string file_ = "scene";
  std::map<std::string, std::string> where_;
};

/// A scene that read_scene has read, and the origins of its values for messages.
struct ReadScene {
  Scene scene;
  Origins origins;
  std::string name;                     ///< name of the scene: name of the file without ".prm"
  std::vector<std::string> warnings{};  ///< one sentence for each entry that has two values in one file
};

/// Reads the file and then the overrides ("Section/Entry=value"). If an entry has several values, the last value is
/// used. In the result, an entry with an expression has its value in the first run of the sweep. Throws UserError if a
/// file cannot be read, a name is unknown, or a value is wrong or out of range. The message is one sentence that begins
/// with file:line or --set. If `file` itself cannot be read, the message begins with the name of the file. The
/// catalogue must outlive the scene.
ReadScene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     const Catalogue& catalogue);

/// Returns the scene in which each entry with an expression has the value of this expression for the given parameters.
/// Throws UserError if an expression cannot be evaluated, or if its value is wrong or out of range. The message begins
/// with the origin of the entry.
Scene with_parameters(Scene scene, const ParameterValues& parameters, const Origins& origins = {});

}  // namespace pseudorigid::scene
