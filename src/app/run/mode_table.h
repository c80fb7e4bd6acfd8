#pragma once
/// modes.csv, and the same for people: the frequencies of the ball at rest beside those of the exact sphere
/// (analysis/sphere_frequencies.h) and of the pseudo-rigid ball.

#include <string_view>
#include <vector>

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// One frequency with its 2n + 1 modes. Internal units.
struct ModeFrequency {
  double omega;           ///< mean of the copies
  double least, largest;  ///< of the copies
  bool spheroidal;
  int degree;
  int overtone;  ///< 0: the fundamental
  int multiplicity;
};

/// The ball in internal units: Lamé's moduli at rest and γ = ρgr/μ, g = (4/3)πGρr.
struct BallAtRest {
  double shear_modulus, lame_lambda;
  bool incompressible;
  double gamma;
};

/// Writes the file, and adds the lines for people to the results.
void write_mode_table(const std::vector<ModeFrequency>& frequencies, const BallAtRest& ball, const RunContext& context,
                      std::string_view file, ModelOutcome& outcome);

}  // namespace pseudorigid::app
