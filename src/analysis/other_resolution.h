#pragma once

#include "io/csv.h"

namespace pseudorigid::analysis {

/// Samples of a second run of a scene, on a coarser or finer discretisation in space than a given run
/// (RunErrors::other). Both runs have the same sample times. The columns are the time, the entries Q11 to Q33 of the
/// affine part Q of the motion, and the other compared quantities that the second run has.
struct OtherResolution {
  io::Table samples;
  double factor;  ///< ratio of the error in space of the given run to the difference of the two runs (space_error.h)
  double factor_of_stress;  ///< the same ratio for a stress
};

}  // namespace pseudorigid::analysis
