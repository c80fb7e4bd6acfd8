#include "app/run/mode_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analysis/sphere_frequencies.h"

namespace pseudorigid::app {
namespace {

/// The exact angular frequency of the elastic sphere for the kind, degree and overtone of `f`, in internal units
/// (analysis/sphere_frequencies.h).
double exact_frequency(const ModeFrequency& f, const BallAtRest& ball) {
  const auto [mu, lambda] = ball.moduli;
  return std::sqrt(mu) * (ball.incompressible
                              ? analysis::sphere_frequency(f.spheroidal, f.degree, f.overtone, ball.gamma)
                              : analysis::compressible_sphere_frequency(f.spheroidal, f.degree, f.overtone,
                                                                        std::sqrt(mu / (lambda + 2 * mu))));
}

/// The angular frequency of the pseudo-rigid ball for the kind, degree and overtone of `f`, in internal units. If the
/// pseudo-rigid ball does not have the mode, the result is 0. The modes of the pseudo-rigid ball are Q = Id + εH with
///
///   degree 2:   m̄ Ḧ = −(2 + 4γ/25)μ Vol H,   H symmetric and trace-free (five motions),
///   degree 0:   m̄ Ḧ = −(3λ + 2μ) Vol H,      H ∝ Id (compressible balls only).
///
/// The inertia is m̄ = ∫ρX₁² dX over the ball of radius r and density ρ, so the volume is Vol = 5m̄/(ρr²). Lamé's
/// moduli are λ and μ, and γ = ρgr/μ with the gravity g at the surface.
double reduced_frequency(const ModeFrequency& f, const BallAtRest& ball) {
  if (!f.spheroidal || f.overtone != 0) return 0;
  const auto [mu, lambda] = ball.moduli;
  if (f.degree == 2) return std::sqrt((10 + 0.8 * ball.gamma) * mu);
  return f.degree == 0 ? std::sqrt(5 * (3 * lambda + 2 * mu)) : 0;
}

/// The usual name of a mode, for example "S2" or "T3, overtone 1".
std::string name_of(const ModeFrequency& f) {
  return fmt::format("{}{}{}", f.spheroidal ? 'S' : 'T', f.degree,
                     f.overtone == 0 ? "" : fmt::format(", overtone {}", f.overtone));
}

}  // namespace

std::string differing_copies(const std::vector<ModeFrequency>& frequencies, double spread) {
  for (const ModeFrequency& f : frequencies)
    if (f.spread() > spread) return fmt::format("the copies of {} differ by {:.1e}", name_of(f), f.spread());
  return {};
}

std::string instability(const std::vector<ModeFrequency>& frequencies, const io::Units& units) {
  const auto fastest = std::ranges::min_element(frequencies, {}, &ModeFrequency::least);
  if (fastest == frequencies.end() || fastest->least >= 0) return {};
  return fmt::format("the ball is unstable at rest: a motion of kind {} grows at the rate {:.6g}", name_of(*fastest),
                     -fastest->least / units.time);
}

std::string mode_file(const scene::Needs& needs, std::string_view model) {
  return needs.models.back()->name == model ? "modes" : fmt::format("modes-{}", model);
}

std::vector<scene::Column> mode_columns() {
  return {{"index", "", "number of the row, by rising frequency"},
          {"omega", "1/time", "frequency, the mean of the copies"},
          {"kind", "", "1 spheroidal, 2 toroidal"},
          {"degree", "", "degree n"},
          {"overtone", "", "0 for the lowest frequency of its kind and degree"},
          {"multiplicity", "", "number of copies, 2n + 1"},
          {"spread", "", "difference of the largest and the smallest copy, over omega"},
          {"exact", "1/time", "frequency of the exact sphere"},
          {"reduced", "1/time", "frequency of the pseudo-rigid ball, 0 if it has no such mode"}};
}

void write_mode_table(const std::vector<ModeFrequency>& frequencies, const BallAtRest& ball, const RunContext& context,
                      std::string_view file, ModelOutcome& outcome) {
  constexpr double spheroidal = 1, toroidal = 2;  // values of the column kind
  io::ColumnTable table = table_of(context, std::string(file), mode_columns());
  add_result(outcome, context,
             fmt::format("{:>3}  {:<14} {:>16} {:>6} {:>9} {:>16} {:>10} {:>16}", "", "mode", "omega", "copies",
                         "spread", "exact sphere", "difference", "pseudo-rigid"));
  int index = 0;
  for (const ModeFrequency& f : frequencies) {
    const double time = context.units.time, spread = f.spread();
    const double exact = exact_frequency(f, ball), reduced = reduced_frequency(f, ball);
    table.append({static_cast<double>(++index), f.omega, f.spheroidal ? spheroidal : toroidal,
                  static_cast<double>(f.degree), static_cast<double>(f.overtone), static_cast<double>(f.multiplicity),
                  spread, exact, reduced});
    add_result(outcome, context,
               fmt::format("{:>3}  {:<14} {:>16.10g} {:>6} {:>9.1e} {:>16} {:>10} {:>16}", index, name_of(f),
                           f.omega / time, f.multiplicity, spread, fmt::format("{:.10g}", exact / time),
                           fmt::format("{:.1e}", f.omega / exact - 1),
                           reduced == 0 ? "" : fmt::format("{:.10g}", reduced / time)));
  }
  table.flush();
}

}  // namespace pseudorigid::app
