#pragma once
/// Functions that return a scene as the text of a parameter file, and the list of all entries in three formats. The
/// directory of a run contains the parameter file as used.prm.

#include <string>
#include <vector>

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// A parameter file with all entries that concern the system of the scene. The program reads this file as exactly the
/// same scene. Comments mark the entries that `origins` attributes to the command line.
std::string to_prm(const Scene& scene, const Origins& origins = {});

/// The path of an entry and its value in a run. The value has the canonical form of the kind of the entry.
struct UsedValue {
  std::string path, value;
};

/// All entries that concern the system of the scene, including those with default values. In a sweep, the value of an
/// entry with an expression is the text of the expression.
std::vector<UsedValue> used_values(const Scene& scene);

enum class Format { prm, markdown, json };

/// A list of all entries of the catalogue with default, range, unit and documentation. In the format prm, the list is a
/// parameter file with the default values. In the format markdown, tables of the models, the methods and the columns
/// follow.
std::string parameters(Format format, const Catalogue& catalogue);

}  // namespace pseudorigid::scene
