#pragma once
/// The table of the modes of the ball, as a CSV file and for the terminal. The table compares the frequencies about the
/// undeformed ball at rest with those of the exact sphere (analysis/sphere_frequencies.h) and of the pseudo-rigid ball.

#include <string>
#include <string_view>
#include <vector>

#include "app/run/run_context.h"
#include "materials/rest_moduli.h"

namespace pseudorigid::app {

/// An angular frequency in internal units. The modes with this frequency are called copies. The exact ball has 2n + 1
/// copies for degree n. An unstable motion has ω < 0 and grows at the rate −ω.
struct ModeFrequency {
  double omega;           ///< mean over the copies
  double least, largest;  ///< least and largest frequency among the copies
  bool spheroidal;        ///< true for a spheroidal mode, false for a toroidal mode
  int degree;             ///< degree n of the spherical harmonics
  int overtone;           ///< 0 for the mode of lowest frequency of its kind and degree
  int multiplicity;       ///< number of copies

  /// Difference of the largest and the least frequency, divided by omega.
  double spread() const { return (largest - least) / omega; }
};

/// Data of the ball in internal units: Lamé's moduli λ and μ at rest, and γ = ρgr/μ. Here ρ is the density, r the
/// radius, and g = (4/3)πGρr the gravity at the surface, with Newton's constant G. The modulus λ is not used for an
/// incompressible ball.
struct BallAtRest {
  materials::RestModuli moduli;
  bool incompressible;
  double gamma;
};

/// Text about the first frequency whose spread() exceeds `spread`; empty if there is no such frequency. Example: "the
/// copies of T3 differ by 5.3e-01". Copies have the same exact frequency. A large spread shows that they belong to
/// different modes, or that the mesh is too coarse for the mode.
std::string differing_copies(const std::vector<ModeFrequency>& frequencies, double spread = 1e-2);
/// Text about the fastest growing motion; empty if no motion grows. The text has the rate of growth in the user's unit
/// 1/time. Example: "the ball is unstable at rest: a motion of kind T1 grows at the rate 0.3".
std::string instability(const std::vector<ModeFrequency>& frequencies, const io::Units& units);

/// The name of the CSV file of a model, without ".csv". It is "modes" for the last model of the scene, which is the
/// most accurate one, and "modes-<model>" for any other model.
std::string mode_file(const scene::Needs& needs, std::string_view model);

/// The columns of the file of modes with their units and texts.
std::vector<scene::Column> mode_columns();

/// Writes the CSV file <file>.csv with one row for each frequency, and adds the table for the terminal to the results
/// of `outcome`.
void write_mode_table(const std::vector<ModeFrequency>& frequencies, const BallAtRest& ball, const RunContext& context,
                      std::string_view file, ModelOutcome& outcome);

}  // namespace pseudorigid::app
