#pragma once
/// Printers of a scene as text: used.prm, and the list of all entries in three formats.

#include <string>
#include <vector>

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// A parameter file with all entries that concern the scene. It reads back to exactly the same scene. A comment marks
/// the entries from the command line.
std::string to_prm(const Scene& scene, const Origins& origins = {});

/// An entry and its value in a run, in canonical form.
struct UsedValue {
  std::string path, value;
};

/// All entries that concern the scene, including those with default values. If a value varies in a sweep, the result
/// contains its expression.
std::vector<UsedValue> used_values(const Scene& scene);

enum class Format { prm, markdown, json };

/// A list of all entries with default, range, unit and documentation. The format prm is a parameter file with the
/// default values.
std::string parameters(Format format, const Catalogue& catalogue);

}  // namespace pseudorigid::scene
