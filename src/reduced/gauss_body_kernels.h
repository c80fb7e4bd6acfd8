#pragma once
/// Solves for the stages of a Gauss step of a pseudo-rigid body in SIMD lanes, with one stage in each lane. The
/// arguments are those of solve_stages_of_body. The table of motion_kernels.h has a pointer to this function.

#include "reduced/body_of_stages.h"

namespace pseudorigid::reduced {

void solve_stages_in_lanes(const BodyOfStages& body, BodyEntries entries, const AccountsOfStages* accounts,
                           mechanics::GaussStages& stages);

}  // namespace pseudorigid::reduced
