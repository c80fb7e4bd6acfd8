#pragma once
/// Runs `Analysis = modes` for the polynomial model, and writes the frequencies about the undeformed ball at rest into
/// modes.csv. If the scene also has the finite-element model, the file is modes-polynomial.csv.

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// Computes the modes of the body whose degree the scene gives. A mode of degree n has 2n + 1 copies, which have the
/// same exact frequency. The outcome is `failed` if the computation fails or the ball is unstable at rest. It is also
/// `failed` if the computed frequencies of copies differ by more than a hundredth. In these cases, the run does not
/// write the file.
ModelOutcome run_polynomial_modes(const RunContext& context);

}  // namespace pseudorigid::app
