#pragma once
/// A picture of a model's body, the same for all models.

#include <filesystem>

#include "app/run/run_context.h"
#include "mechanics/core/body_fields.h"

namespace pseudorigid::app {

/// Writes the fields as the picture of this physical time, at equidistant points of the blocks if Output/Cells =
/// lagrange. A run on several ranks writes a piece for each rank and a file that lists them. Collective.
void write_picture(const RunContext& context, const std::filesystem::path& path, double time,
                   const mechanics::PointBlocks& blocks, const mechanics::BodyFields& fields);

}  // namespace pseudorigid::app
