#pragma once
/// From a Scene to text: used.prm, and the list of all entries in three formats.

#include <string>
#include <vector>

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// All entries that concern the scene with their values, as a parameter file that reads back to the same scene, bit for
/// bit. Entries that came from the command line are marked by a comment.
std::string to_prm(const Scene& scene, const Origins& origins = {});

/// The value that an entry had in a run, in its canonical form.
struct UsedValue {
  std::string path, value;
};

/// All entries that concern the scene, with default values included. A value that varies in a sweep is printed as its
/// expression.
std::vector<UsedValue> used_values(const Scene& scene);

enum class Format { prm, markdown, json };

/// Every entry with default, range, unit and documentation. The prm format is a parameter file of the defaults.
std::string parameters(Format format, const Catalogue& catalogue);

}  // namespace pseudorigid::scene
