#include "scene/contact.h"

#include <fmt/format.h>

#include <Eigen/Core>

#include "entries/entry_kinds.h"
#include "scene/scene.h"

namespace pseudorigid::scene {
namespace {

constexpr const char *normals_path = "Loads/Plane normals", *points_path = "Loads/Plane points";

/// Initial penetrations below this fraction of the size of the body and the distance of the plane are round-off.
constexpr double round_off = 1e-12;

Eigen::Vector3d vector_of(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

/// The depth by which the initial body penetrates a plane. A depth that is only round-off counts as 0.
double depth(const Scene& scene, const loads::Plane& plane) {
  const Eigen::Vector3d axes = scene.body.radius * vector_of(scene.body.semi_axes);
  const Eigen::Matrix3d Q = loads::to_eigen(scene.initial_state.deformation);
  const double reach = axes.cwiseProduct(Q.transpose() * plane.normal).norm();
  const double behind = reach - plane.height(vector_of(scene.initial_state.center));
  return behind > round_off * (reach + std::abs(plane.position)) ? behind : 0;
}

std::optional<Refusal> refuses_rows(const loads::RigidPlanes& load) {
  const std::size_t n_normals = load.normals.size() / 3, n_points = load.points.size() / 3;
  if (n_normals != n_points)
    return Refusal{points_path, fmt::format("expected a point for each row of {}, got {} points and {} normals",
                                            normals_path, n_points, n_normals)};
  for (std::size_t i = 0; i < load.normals.size(); i += 3)
    if (load.normals[i] == 0 && load.normals[i + 1] == 0 && load.normals[i + 2] == 0)
      return Refusal{normals_path, fmt::format("expected a direction in each row, and row {} is zero", i / 3 + 1)};
  return {};
}

/// Refuses speeds and amplitudes that are not one for each plane.
std::optional<Refusal> refuses_motion_of_planes(const loads::RigidPlanes& load) {
  const std::size_t n_planes = load.normals.size() / 3;
  for (const auto& [path, values] :
       {std::pair{"Loads/Plane speeds", &load.speeds}, std::pair{"Loads/Plane amplitudes", &load.amplitudes}})
    if (!values->empty() && values->size() != n_planes)
      return Refusal{path, fmt::format("expected a number for each plane or nothing, got {} for {} planes",
                                       values->size(), n_planes)};
  return {};
}

std::optional<Refusal> refuses_body(const Scene& scene) {
  if (scene.body.inertia)
    return Refusal{"Body/Inertia",
                   "contact needs the surface of the body, which Semi-axes describe",
                   {{{"Body/Inertia", "auto"}}}};
  if (has_mesh_file(scene))
    return Refusal{"Continuum/Mesh", "contact with planes is offered for the ball", {{{"Continuum/Mesh", "builtin"}}}};
  return {};
}

}  // namespace

std::optional<Refusal> refuses_planes(const Scene& scene) {
  const auto& load = scene.loads.get<loads::RigidPlanes>();
  if (auto refusal = refuses_rows(load)) return refusal;
  if (auto refusal = refuses_motion_of_planes(load)) return refusal;
  if (load.normals.empty()) return {};
  if (auto refusal = refuses_body(scene)) return refusal;
  const loads::Planes planes = load.forcing().planes;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (const double behind = depth(scene, planes[i]); behind > 0)
      return Refusal{points_path, fmt::format("plane {} cuts the body at the start, which reaches {:.4g} behind it; "
                                              "move the plane or Initial state/Center",
                                              i + 1, behind)};
  return {};
}

}  // namespace pseudorigid::scene
