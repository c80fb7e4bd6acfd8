#include "scene/companions.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>

#include "scene/scene.h"

namespace pseudorigid::scene {
namespace {

constexpr const char *masses_path = "Companions/Masses", *positions_path = "Companions/Positions",
                     *velocities_path = "Companions/Velocities";

std::optional<Refusal> refuses_rows(const loads::CompanionMasses& load) {
  const std::size_t n = load.masses.size(), n_positions = load.positions.size() / 3,
                    n_velocities = load.velocities.size() / 3, most = mechanics::Orbit::most_companions;
  if (n > most) return Refusal{masses_path, fmt::format("expected at most {} companions, got {}", most, n)};
  for (const double mass : load.masses)
    if (mass <= 0) return Refusal{masses_path, fmt::format("expected numbers > 0, got {}", print_number(mass))};
  if (n_positions != n)
    return Refusal{positions_path,
                   fmt::format("expected a row for each of {}, got {} for {}", masses_path, n_positions, n)};
  if (n_velocities != 0 && n_velocities != n)
    return Refusal{velocities_path,
                   fmt::format("expected no row, or one for each of {}, got {} for {}", masses_path, n_velocities, n)};
  return {};
}

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

/// The largest distance of a point of the initial body from its centre.
double reach(const Scene& scene) {
  const Eigen::Matrix3d Q = loads::to_eigen(scene.initial_state.deformation);
  const Eigen::Vector3d axes(scene.body.semi_axes[0], scene.body.semi_axes[1], scene.body.semi_axes[2]);
  return scene.body.radius * (Q * axes.asDiagonal()).jacobiSvd().singularValues()[0];
}

double mass_of(const Scene& scene) {
  double volume = 4 * std::numbers::pi / 3 * scene.body.radius * scene.body.radius * scene.body.radius;
  for (const double axis : scene.body.semi_axes) volume *= axis;
  return scene.body.density * volume;
}

/// Whether r is so near to the z axis that the direction of a circular orbit is round-off or the error of a mesh.
bool is_on_axis(const Eigen::Vector3d& r) {
  constexpr double near = 1e-4;
  return r.head<2>().norm() <= near * r.norm();
}

}  // namespace

std::optional<Refusal> refuses_companions(const Scene& scene) {
  const auto& load = scene.loads.get<loads::CompanionMasses>();
  if (load.masses.empty() && load.positions.empty() && load.velocities.empty()) return {};
  if (auto refusal = refuses_rows(load)) return refusal;
  if (auto refusal = refuses_loads(scene)) return refusal;
  const mechanics::Companions companions = load.forcing().companions;
  const double least = reach(scene);
  double mass = mass_of(scene);  // of the body and the companions before
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < companions.size(); ++i) {
    const Eigen::Vector3d& r = companions[i].position;
    if (r.norm() <= least)
      return Refusal{positions_path, fmt::format("companion {} is within {} of the centre, where the body is", i + 1,
                                                 print_upper_bound(least))};
    for (std::size_t j = 0; j < i; ++j)
      if (r == companions[j].position)
        return Refusal{positions_path, fmt::format("companions {} and {} are at one place", j + 1, i + 1)};
    if (!companions[i].velocity && is_on_axis(r - center))
      return Refusal{positions_path, fmt::format("companion {} is on a z axis with the centre of its orbit, so its "
                                                 "circular orbit about this axis is not defined; give {}",
                                                 i + 1, velocities_path)};
    mass += companions[i].mass;
    center += companions[i].mass / mass * (r - center);
  }
  return {};
}

}  // namespace pseudorigid::scene
