#pragma once
/// Methods and systems as parameter files and `pseudorigid parameters` know them, from their tables
/// (mechanics/methods/methods.h, systems/table.h).

#include "scene/catalogue.h"

namespace pseudorigid::app {

/// Lives as long as the program.
const scene::Catalogue& program_catalogue();

}  // namespace pseudorigid::app
