#pragma once
/// modes.csv, and a table for the terminal: the frequencies of the ball at rest compared with those of the exact sphere
/// (analysis/sphere_frequencies.h) and of the pseudo-rigid ball.

#include <string>
#include <string_view>
#include <vector>

#include "app/run/run_context.h"
#include "materials/rest_moduli.h"

namespace pseudorigid::app {

/// One frequency with its 2n + 1 modes. Internal units. For unstable motions ω is negative, and −ω is the growth rate.
struct ModeFrequency {
  double omega;           ///< mean of the copies
  double least, largest;  ///< of the copies
  bool spheroidal;
  int degree;
  int overtone;  ///< 0: the fundamental
  int multiplicity;

  double spread() const { return (largest - least) / omega; }
};

/// The ball in internal units: Lamé's moduli at rest and γ = ρgr/μ, g = (4/3)πGρr.
struct BallAtRest {
  materials::RestModuli moduli;
  bool incompressible;
  double gamma;
};

/// The first frequency whose copies differ by more than a part of it: "the copies of T3 differ by 5.3e-01"; empty if
/// there is none. Copies that differ by a hundredth are not those of one mode, or a mesh is too coarse for it.
std::string differing_copies(const std::vector<ModeFrequency>& frequencies, double spread = 1e-2);
/// "the ball is unstable at rest: a motion of kind T1 grows at the rate 0.3"; empty if no motion grows.
std::string instability(const std::vector<ModeFrequency>& frequencies, const io::Units& units);

/// Writes the file, and adds the lines for people to the results.
void write_mode_table(const std::vector<ModeFrequency>& frequencies, const BallAtRest& ball, const RunContext& context,
                      std::string_view file, ModelOutcome& outcome);

}  // namespace pseudorigid::app
