#include "scene/companions.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>

#include "mechanics/core/principal_axes.h"
#include "scene/models.h"
#include "scene/scene.h"

namespace pseudorigid::scene {
namespace {

constexpr const char *masses_path = "Companions/Masses", *positions_path = "Companions/Positions",
                     *velocities_path = "Companions/Velocities", *axes_path = "Companions/Semi-major axes",
                     *eccentricities_path = "Companions/Eccentricities", *full_path = "Companions/Full potential";

/// An entry with orbital elements: its path, and one value for each companion.
struct ElementsEntry {
  const char* path;
  const std::vector<double>& values;
};
std::vector<ElementsEntry> elements_of(const loads::CompanionMasses& load) {
  return {{axes_path, load.semi_major_axes},
          {eccentricities_path, load.eccentricities},
          {"Companions/Inclinations", load.inclinations},
          {"Companions/Ascending nodes", load.ascending_nodes},
          {"Companions/Arguments of pericentre", load.arguments_of_pericentre},
          {"Companions/Mean anomalies", load.mean_anomalies}};
}
bool has_any_elements(const loads::CompanionMasses& load) {
  return std::ranges::any_of(elements_of(load), [](const ElementsEntry& entry) { return !entry.values.empty(); });
}

/// Refuses elements in addition to positions or velocities, incomplete elements, and a semi-major axis of 0. Also
/// refuses an eccentricity outside [0, 1) if the semi-major axis is positive, and at most 1 if this axis is negative.
std::optional<Refusal> refuses_elements(const loads::CompanionMasses& load) {
  const std::size_t n = load.masses.size();
  for (const auto& [path, values] : {ElementsEntry{positions_path, load.positions}, {velocities_path, load.velocities}})
    if (!values.empty())
      return Refusal{path, fmt::format("the orbits of companions are given twice: give either {} and velocities, or "
                                       "{} and other elements",
                                       positions_path, axes_path)};
  for (const auto& [path, values] : elements_of(load))
    if (!values.empty() && !load.has_elements())
      return Refusal{path, fmt::format("elements of an orbit include {}, which is missing", axes_path)};
  for (const auto& [path, values] : elements_of(load))
    if (values.size() != n && (path == axes_path || !values.empty()))
      return Refusal{path, fmt::format("expected {}a row for each of {}, got {} for {}",
                                       path == axes_path ? "" : "no row, or ", masses_path, values.size(), n)};
  for (std::size_t i = 0; i < n; ++i) {
    const double a = load.semi_major_axes[i], e = load.eccentricities.empty() ? 0 : load.eccentricities[i];
    if (a == 0) return Refusal{axes_path, "expected numbers > 0, or < 0 for a hyperbola, got 0"};
    if (a > 0 && !(e >= 0 && e < 1))
      return Refusal{eccentricities_path,
                     fmt::format("an ellipse, with a semi-major axis > 0, has an eccentricity from 0 to less than 1, "
                                 "got {}",
                                 print_number(e))};
    if (a < 0 && !(e > 1))
      return Refusal{eccentricities_path, fmt::format("a hyperbola, with a semi-major axis < 0, has an eccentricity > "
                                                      "1, got {}",
                                                      print_number(e))};
  }
  return {};
}

/// Refuses too many masses and masses that are not positive. If the scene has elements, also refuses the cases of
/// refuses_elements. Otherwise also refuses wrong numbers of positions or velocities.
std::optional<Refusal> refuses_rows(const loads::CompanionMasses& load) {
  const std::size_t n = load.masses.size(), n_positions = load.positions.size() / 3,
                    n_velocities = load.velocities.size() / 3, most = mechanics::Orbit::most_companions;
  if (n > most) return Refusal{masses_path, fmt::format("expected at most {} companions, got {}", most, n)};
  for (const double mass : load.masses)
    if (mass <= 0) return Refusal{masses_path, fmt::format("expected numbers > 0, got {}", print_number(mass))};
  if (has_any_elements(load)) return refuses_elements(load);
  if (n_positions != n)
    return Refusal{positions_path,
                   fmt::format("expected a row for each of {}, got {} for {}", masses_path, n_positions, n)};
  if (n_velocities != 0 && n_velocities != n)
    return Refusal{velocities_path,
                   fmt::format("expected no row, or one for each of {}, got {} for {}", masses_path, n_velocities, n)};
  return {};
}

/// Refuses drag, planes and tidal matrices, which would exert a force on the body but not on the companions. Also
/// refuses a scene without gravity.
std::optional<Refusal> refuses_loads(const Scene& scene) {
  const auto only = [](const char* path) {
    return Refusal{path, "it acts on the body alone and would change the orbit; it is not offered with companions"};
  };
  if (loads::present(scene.loads.get<loads::Drag>())) return only("Material/Drag");
  if (loads::present(scene.loads.get<loads::RigidPlanes>())) return only("Loads/Plane normals");
  if (loads::present(scene.loads.get<loads::Tide>())) return only("Loads/Tidal matrix");
  if (loads::present(scene.loads.get<loads::PeriodicTide>())) return only("Loads/Tidal amplitude");
  if (!loads::present(scene.loads.get<loads::SelfGravity>()))
    return Refusal{masses_path, "a companion acts by gravity; give Gravity/Constant or Gravity/Gamma a value > 0"};
  return {};
}

/// Refuses the full potential in a scene without companions, and in a scene without a finite-element model.
std::optional<Refusal> refuses_full_potential(const Scene& scene, const loads::CompanionMasses& load) {
  if (!load.full_potential) return {};
  if (load.masses.empty()) return Refusal{full_path, fmt::format("the scene has no companion; give {}", masses_path)};
  if (!is_discretized(scene)) return Refusal{full_path, "the other models have degree 2 only; add continuum to Models"};
  return {};
}

/// The largest distance of a point of the initial body from its centre, in the units of the user. It is the radius
/// times the largest singular value of Q₀ diag(semi-axes), with the initial deformation Q₀.
double reach(const Scene& scene) {
  const Eigen::Matrix3d Q = loads::to_eigen(scene.initial_state.deformation);
  const Eigen::Vector3d axes(scene.body.semi_axes[0], scene.body.semi_axes[1], scene.body.semi_axes[2]);
  return scene.body.radius * mechanics::singular_values(Q * axes.asDiagonal())[0];
}

/// The mass of the body, in the units of the user.
double mass_of(const Scene& scene) {
  double volume = 4 * std::numbers::pi / 3 * scene.body.radius * scene.body.radius * scene.body.radius;
  for (const double axis : scene.body.semi_axes) volume *= axis;
  return scene.body.density * volume;
}

/// Whether r, the position relative to the centre of the orbit, is nearly parallel to the z axis. A circular orbit
/// about this axis has a velocity along e_z × r. This vector is then small, and its direction is sensitive to
/// round-off.
bool is_on_axis(const Eigen::Vector3d& r) {
  constexpr double near = 1e-4;
  return r.head<2>().norm() <= near * r.norm();
}

}  // namespace

std::optional<Refusal> refuses_companions(const Scene& scene) {
  const auto& load = scene.loads.get<loads::CompanionMasses>();
  if (auto refusal = refuses_full_potential(scene, load)) return refusal;
  if (load.masses.empty() && load.positions.empty() && load.velocities.empty() && !has_any_elements(load)) return {};
  if (auto refusal = refuses_rows(load)) return refusal;
  if (auto refusal = refuses_loads(scene)) return refusal;
  const mechanics::Companions companions = load.forcing().companions;
  constexpr double round_off = 1e-14;
  const double least = reach(scene);
  double mass = mass_of(scene);                       // mass of the body and of the companions before companion i
  const mechanics::Orbit orbit(companions, 1, mass);  // positions do not depend on the constant of gravity
  const mechanics::Orbit::Columns positions = orbit.relative(orbit.position());
  const char* const path = load.has_elements() ? axes_path : positions_path;
  // Centre of mass of the body and of the companions before companion i, relative to the body.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < companions.size(); ++i) {
    const Eigen::Vector3d r = positions.col(static_cast<Eigen::Index>(i));
    if (!r.allFinite()) return Refusal{path, fmt::format("companion {} is beyond the range of numbers", i + 1)};
    if (r.norm() <= least)
      return Refusal{path, fmt::format("companion {} is within {} of the centre, where the body is", i + 1,
                                       print_upper_bound(least))};
    for (std::size_t j = 0; j < i; ++j)
      if (const Eigen::Vector3d other = positions.col(static_cast<Eigen::Index>(j));
          (r - other).norm() <= round_off * r.norm())
        return Refusal{path, fmt::format("companions {} and {} are at one place", j + 1, i + 1)};
    if (!companions[i].velocity && !companions[i].elements && is_on_axis(r - center))
      return Refusal{positions_path, fmt::format("companion {} is on a z axis with the centre of its orbit, so its "
                                                 "circular orbit about this axis is not defined; give {}",
                                                 i + 1, velocities_path)};
    mass += companions[i].mass;
    center += companions[i].mass / mass * (r - center);
  }
  return {};
}

}  // namespace pseudorigid::scene
