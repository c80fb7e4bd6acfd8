#pragma once
/// The stages of a Gauss step of a pseudo-rigid body, in lanes; compiled with the kernels of motion_kernels.h.

#include "reduced/body_of_stages.h"

namespace pseudorigid::reduced {

void solve_stages_in_lanes(const BodyOfStages& body, BodyEntries entries, const AccountsOfStages* accounts,
                           mechanics::GaussStages& stages);

}  // namespace pseudorigid::reduced
