#pragma once
/// Functions that print a scene as used.prm, and the list of all entries in three formats.

#include <string>
#include <vector>

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// A parameter file with all entries that have an effect on the scene. The program reads this file as exactly the same
/// scene. A comment marks the entries that the command line sets.
std::string to_prm(const Scene& scene, const Origins& origins = {});

/// An entry and its value in a run, in the canonical form of the kind.
struct UsedValue {
  std::string path, value;
};

/// All entries that have an effect on the scene, including those with default values. If the value varies in a sweep,
/// its expression replaces the value.
std::vector<UsedValue> used_values(const Scene& scene);

enum class Format { prm, markdown, json };

/// A list of all entries with default, range, unit and documentation. In the format prm, the list is a parameter file
/// with the default values.
std::string parameters(Format format, const Catalogue& catalogue);

}  // namespace pseudorigid::scene
