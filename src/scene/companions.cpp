#include "scene/companions.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>

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

}  // namespace

std::optional<Refusal> refuses_companions(const Scene& scene) {
  const auto& load = scene.loads.get<loads::CompanionMasses>();
  if (load.masses.empty() && load.positions.empty() && load.velocities.empty()) return {};
  if (auto refusal = refuses_rows(load)) return refusal;
  if (auto refusal = refuses_loads(scene)) return refusal;
  const mechanics::Companions companions = load.forcing().companions;
  const double least = reach(scene);
  for (std::size_t i = 0; i < companions.size(); ++i) {
    const Eigen::Vector3d& r = companions[i].position;
    if (r.norm() <= least)
      return Refusal{positions_path, fmt::format("companion {} is within {} of the centre, where the body is", i + 1,
                                                 print_upper_bound(least))};
    for (std::size_t j = 0; j < i; ++j)
      if (r == companions[j].position)
        return Refusal{positions_path, fmt::format("companions {} and {} are at one place", j + 1, i + 1)};
    if (!companions[i].velocity && r[0] == 0 && r[1] == 0)
      return Refusal{positions_path, fmt::format("companion {} is on the z axis, so its circular orbit about this "
                                                 "axis is not defined; give {}",
                                                 i + 1, velocities_path)};
  }
  return {};
}

}  // namespace pseudorigid::scene
