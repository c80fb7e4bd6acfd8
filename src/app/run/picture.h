#pragma once
/// Output of a picture of a body, for all models.

#include <filesystem>

#include "app/run/run_context.h"
#include "mechanics/core/body_fields.h"

namespace pseudorigid::app {

/// Writes a picture of the fields at the given physical time. If Output/Cells = lagrange, the points of each block must
/// be equidistant. If there are several ranks, each rank writes a piece, and the first rank writes a file that lists
/// the pieces. Throws io::WriteError if a file cannot be written, or FailureOnAllRanks on several ranks. Collective.
void write_picture(const RunContext& context, const std::filesystem::path& path, double time,
                   const mechanics::PointBlocks& blocks, const mechanics::BodyFields& fields);

}  // namespace pseudorigid::app
