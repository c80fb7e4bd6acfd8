#include "scene/scale_numbers.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <string_view>

#include "loads/forcing.h"
#include "scene/scales.h"

namespace pseudorigid::scene {
namespace {

/// The numbers of a scene. The head of scale_numbers.h defines the symbols.
struct ScaleNumbers {
  bool is_fluid = false, moves = false;  ///< true if the body is a fluid; true if the analysis is a motion
  double c = 1, time = 1;                ///< √(μ/ρ) and r/c; for a fluid r/t and t
  double duration = 0, gamma = 0, spin = 0, speed = 0;  ///< Time/End in the unit `time`, γ, ω²r²/c², v/c
};

/// Computes the dimensionless numbers of a scene. For a fluid, γ is not defined, and the member `gamma` is 0.
ScaleNumbers scale_numbers(const Scene& scene) {
  const auto& [radius, density, incompressible, semi_axes, inertia] = scene.body;
  ScaleNumbers n{.is_fluid = is_fluid(scene), .moves = scene.analysis == Analysis::motion};
  const double mu = scene.material.shear_modulus;
  n.c = n.is_fluid ? radius / time_scale(scene) : std::sqrt(mu / density);
  n.time = radius / n.c;
  n.duration = scene.time.end / n.time;
  n.gamma = gamma_of(scene);
  const Eigen::Matrix3d Q = loads::to_eigen(scene.initial_state.deformation),
                        Qdot = loads::to_eigen(scene.initial_state.velocity);
  const Eigen::Matrix3d L = Qdot * Q.inverse();
  n.spin = 0.5 * (L - L.transpose()).squaredNorm() / 4 * n.time * n.time;
  n.speed = Qdot.operatorNorm() * n.time;
  return n;
}

constexpr std::string_view advice = "; are lengths, masses, times and pressures given in one system of units?";

}  // namespace

double gamma_of(const Scene& scene) {
  if (is_fluid(scene)) return 0;
  const double g = 4 * std::numbers::pi / 3 * loads::constant_forcing(scene.loads).gravity_constant *
                   scene.body.density * scene.body.radius;
  return scene.body.density * g * scene.body.radius / scene.material.shear_modulus;
}

std::vector<std::string> scale_lines(const Scene& scene) {
  const ScaleNumbers n = scale_numbers(scene);
  std::vector<std::string> lines;
  const std::string_view unit = n.is_fluid ? "t" : "r/c";
  if (n.is_fluid)
    lines.push_back(fmt::format("unit of time t = {:.6g}, of self-gravity or of the loads", n.time));
  else
    lines.push_back(fmt::format("c = sqrt(mu/rho) = {:.6g}, r/c = {:.6g}", n.c, n.time));
  if (n.moves) lines.push_back(fmt::format("Time/End = {:.6g} {}", n.duration, unit));
  if (n.gamma > 0) lines.push_back(fmt::format("gamma = rho g r/mu = {:.4g}, g = (4/3) pi G rho r", n.gamma));
  const std::string_view speed = n.is_fluid ? "(r/t)" : "c";
  if (n.moves && n.spin > 0) lines.push_back(fmt::format("omega^2 r^2/{}^2 = {:.4g} at the start", speed, n.spin));
  if (n.moves && n.speed > 0)
    lines.push_back(fmt::format("v/{} = {:.4g} at the start, v the largest speed about the centre", speed, n.speed));
  return lines;
}

std::vector<std::string> unit_warnings(const Scene& scene) {
  const ScaleNumbers n = scale_numbers(scene);
  std::vector<std::string> warnings;
  if (n.is_fluid) return warnings;
  const auto warn = [&](const std::string& sentence) { warnings.push_back(sentence + std::string(advice)); };
  const bool is_shorter = n.moves && n.duration < 1e-2, is_longer = n.moves && n.duration > 1e7;
  if (is_shorter || is_longer)
    warn(
        fmt::format("Time/End = {:.3g} is {:.2g} times r/c = {:.3g}, the time that a shear wave takes along the radius",
                    scene.time.end, n.duration, n.time));
  if (n.moves && n.speed > 100)
    warn(fmt::format("Initial state/Velocity: the largest speed is {:.2g} times the speed of shear waves, c = {:.3g}",
                     n.speed, n.c));
  if (n.gamma > 1e4 || (n.gamma > 0 && n.gamma < 1e-8))
    warn(fmt::format("{}: gamma = rho g r/mu = {:.2g}, so that {} hardly counts",
                     scene.gamma > 0 ? "Gravity/Gamma" : "Gravity/Constant", n.gamma,
                     n.gamma > 1 ? "elasticity" : "self-gravity"));
  return warnings;
}

}  // namespace pseudorigid::scene
