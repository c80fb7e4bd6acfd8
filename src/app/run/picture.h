#pragma once
/// Output of a picture of a body, for all models.

#include <filesystem>

#include "app/run/run_context.h"
#include "mechanics/core/body_fields.h"

namespace pseudorigid::app {

/// Writes a picture of the fields at the time `time` in the user's units. If Output/Cells = lagrange, the points of
/// each block must be equidistant. If there are several ranks, each rank writes a piece, and the first rank writes a
/// file that lists the pieces. If a file cannot be written, throws io::WriteError in a single process and
/// FailureOnAllRanks on several ranks. Collective.
void write_picture(const RunContext& context, const std::filesystem::path& path, double time,
                   const mechanics::PointBlocks& blocks, const mechanics::BodyFields& fields);

}  // namespace pseudorigid::app
