#include "app/commands/expected_error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "app/polynomial/body_setup.h"
#include "app/run/small_pulsation.h"
#include "materials/rest_moduli.h"
#include "mechanics/core/principal_axes.h"
#include "polynomial/rest_modes.h"

namespace pseudorigid::app {
namespace {

/// Bounds of the initial states in the sweeps of docs/adequacy.md. `largest_amplitude` is the largest |ln stretch|. Let
/// L = Q̇Q⁻¹ be the velocity gradient, c the speed of shear waves and r the radius. `largest_rate` is half of the
/// largest Frobenius norm |L| in units of c/r. A value of |L − Lᵀ|/(1 + |L|) up to `no_spin` counts as round-off.
constexpr double largest_amplitude = 0.25, largest_rate = 0.75, no_spin = 1e-9;

/// True if the initial state has no spin and is in the range of the sweeps of docs/adequacy.md. Without spin, the
/// velocity gradient L = Q̇Q⁻¹ is symmetric. The argument c is the speed of shear waves in internal units.
bool is_moderate(const scene::Scene& scene, double c) {
  const Eigen::Matrix3d Q = loads::to_eigen(scene.initial_state.deformation);
  const Eigen::Matrix3d L = loads::to_eigen(scene.initial_state.velocity) * Q.inverse() * units_of(scene).time;
  const Eigen::Vector3d stretches = mechanics::singular_values(Q);
  return stretches.array().log().abs().maxCoeff() <= largest_amplitude && L.norm() <= 2 * largest_rate * c &&
         (L - L.transpose()).norm() <= no_spin * (1 + L.norm());
}

/// Angular frequency of the slowest pulsation (spheroidal, degree 2) of the polynomial body of degree N, in internal
/// units. Empty if the computation fails, or if the pulsation is not among the six lowest frequencies.
std::optional<double> pulsation_of_polynomial(const scene::Scene& scene, int N) {
  constexpr std::size_t n_frequencies = 6;
  std::vector<polynomial::RestFrequency> found;
  if (!polynomial::rest_frequencies(body_setup(scene, {}, N), scene.body.incompressible, n_frequencies, found))
    return {};
  for (const polynomial::RestFrequency& f : found)
    if (f.spheroidal && f.degree == 2 && f.overtone == 0) return f.omega;
  return {};
}

/// The relative error `excess` of a frequency as text in per cent. If |excess| < 1e-7, the text is a bound, because the
/// frequencies are not computed more accurately.
std::string in_per_cent(double excess) {
  return std::abs(excess) < 1e-7 ? "0.00001 % or less" : fmt::format("{:+.2g} %", 100 * excess);
}

/// The matrix T of the potential (T:x⊗x)/2 per mass that shapes the figures of the scene, in units of c²/r²: the tide
/// for a figure at rest, and the centrifugal potential of the largest spin for the family `spinning`. Empty if the
/// scene has other figures or other loads. c is the speed of shear waves in internal units.
std::optional<Eigen::Matrix3d> potential_of_figures(const scene::Scene& scene, double c) {
  const loads::Forcing forcing = loads::constant_forcing(internal_loads(scene));
  if (!forcing.nominal_traction.isZero(0) || !forcing.acceleration.isZero(0)) return {};
  if (scene::finds_static_equilibria(scene)) return forcing.quadratic / (c * c);
  const auto& [family, first, last, number, axis_ratio, small_motions] = scene.equilibria;
  if (family != scene::Family::spinning) return {};
  const double spin = number == 1 ? first : std::max(std::abs(first), std::abs(last));
  const double squared = std::pow(spin * units_of(scene).time / c, 2);
  return Eigen::Vector3d(-squared, -squared, 0).asDiagonal().toDenseMatrix();
}

/// The relative error of the bulge (head of expected_error.h). Empty for other bodies, for a sweep, and outside the
/// range of the sweeps of docs/adequacy.md. c is the speed of shear waves in internal units.
std::optional<double> error_of_bulge(const scene::Scene& scene, double c) {
  constexpr double largest_strength = 0.1, least_held = -2, largest_gamma = 1000;
  const double gamma = gravity_to_elasticity(scene);
  const bool is_ball = scene.body.semi_axes == std::vector<double>{1, 1, 1} && !scene.body.inertia;
  if (!is_ball || !scene.body.incompressible || scene::is_fluid(scene) || !scene.sweep.empty()) return {};
  const std::optional<Eigen::Matrix3d> T = potential_of_figures(scene, c);
  if (!T) return {};
  const double K = T->trace() / 3, held = gamma + 2.5 * K;
  if (gamma > largest_gamma || held < least_held || held > largest_gamma) return {};
  const double stiffness = 10 + 0.8 * held;
  const double strength = mechanics::singular_values(*T - K * Eigen::Matrix3d::Identity())[0];
  if (strength == 0 || strength > largest_strength * stiffness) return {};
  return -3 / (12.5 + held);
}

}  // namespace

void describe_expected_error(const scene::Scene& scene, scene::Needs& needs) {
  if (needs.system) return;
  const double c = std::sqrt(materials::moduli_at_rest(internal_law(scene), scene.body.incompressible).shear);
  if (scene.analysis == scene::Analysis::equilibrium)
    if (const auto error = error_of_bulge(scene, c))
      needs.expected.push_back(
          fmt::format("error of the bulge of the figure: pseudo-rigid {} (docs/adequacy.md)", in_per_cent(*error)));
  if (scene.analysis != scene::Analysis::motion || !is_moderate(scene, c)) return;
  const auto small = small_pulsation(scene);
  if (!small) return;
  std::vector<std::string> errors{fmt::format("pseudo-rigid {}", in_per_cent(small->ratio() - 1))};
  for (const int N : {3, 5})
    if (const auto omega = pulsation_of_polynomial(scene, N))
      errors.push_back(fmt::format("polynomial N = {} {}", N, in_per_cent(*omega / (c * small->exact) - 1)));
  needs.expected.push_back(fmt::format("error of the slowest pulsation's frequency{}: {} (docs/adequacy.md)",
                                       scene.sweep.empty() ? "" : " in the first run", fmt::join(errors, ", ")));
}

}  // namespace pseudorigid::app
