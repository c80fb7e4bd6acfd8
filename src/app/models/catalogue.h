#pragma once
/// Catalogue of the models, methods and systems that parameter files and `pseudorigid parameters` offer. It is made
/// from their tables (ball_models.h, mechanics/methods/methods.h, systems/table.h).

#include <vector>

#include "app/models/ball_models.h"
#include "scene/catalogue.h"

namespace pseudorigid::app {

scene::Catalogue catalogue_with(const std::vector<BallModel>& models);

/// The catalogue of the program's own models; it lives as long as the program.
const scene::Catalogue& program_catalogue();

}  // namespace pseudorigid::app
