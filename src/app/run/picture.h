#pragma once
/// A picture of a model's body, the same for all models.

#include <filesystem>

#include "app/run/run_context.h"
#include "mechanics/core/body_fields.h"

namespace pseudorigid::app {

/// Writes the fields, where Output/Cells = lagrange at equidistant points of the blocks, as the picture of this
/// (physical) time: one file, or of several ranks a piece each and beside them the file that names the pieces.
/// Collective.
void write_picture(const RunContext& context, const std::filesystem::path& path, double time,
                   const mechanics::PointBlocks& blocks, const mechanics::BodyFields& fields);

}  // namespace pseudorigid::app
