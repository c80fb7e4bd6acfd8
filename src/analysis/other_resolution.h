#pragma once

#include "io/csv.h"

namespace pseudorigid::analysis {

/// The same motion on another discretisation in space, at the same samples: columns time and Q11 to Q33.
struct OtherResolution {
  io::Table samples;
  double factor;  ///< error in space of a number over its difference there (space_error.h)
};

}  // namespace pseudorigid::analysis
