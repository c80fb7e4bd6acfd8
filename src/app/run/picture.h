#pragma once
/// Output of a picture of a body, common to all models.

#include <filesystem>

#include "app/run/run_context.h"
#include "mechanics/core/body_fields.h"

namespace pseudorigid::app {

/// Writes the fields at this physical time as a picture. If Output/Cells = lagrange, the points of a block are
/// equidistant. A run on several ranks writes a piece for each rank, and a file that lists the pieces. Collective.
void write_picture(const RunContext& context, const std::filesystem::path& path, double time,
                   const mechanics::PointBlocks& blocks, const mechanics::BodyFields& fields);

}  // namespace pseudorigid::app
