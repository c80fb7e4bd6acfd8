#pragma once
/// The catalogue of the models, methods and systems that parameter files and the command `pseudorigid parameters`
/// offer. The catalogue is made from the tables of ball_models.h, mechanics/methods/methods.h and systems/table.h.

#include <vector>

#include "app/models/ball_models.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

/// The catalogue with the descriptions of `models`, and of all methods and systems.
scene::Catalogue catalogue_with(const std::vector<BallModel>& models);

/// The catalogue of the program's own models. The reference is valid until the program ends.
const scene::Catalogue& program_catalogue();

}  // namespace pseudorigid::app
