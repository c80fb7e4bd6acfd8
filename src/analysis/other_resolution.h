#pragma once

#include "io/csv.h"

namespace pseudorigid::analysis {

/// Samples of the same scene on another discretisation in space, at the same times. The columns are the time and Q11 to
/// Q33.
struct OtherResolution {
  io::Table samples;
  double factor;  ///< ratio of the error in space to the difference of the two motions (space_error.h)
};

}  // namespace pseudorigid::analysis
