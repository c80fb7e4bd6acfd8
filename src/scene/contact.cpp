#include "scene/contact.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "entries/entry_kinds.h"
#include "scene/discretization.h"
#include "scene/models.h"
#include "scene/scales.h"
#include "scene/scene.h"

namespace pseudorigid::scene {
namespace {

constexpr const char *normals_path = "Loads/Plane normals", *points_path = "Loads/Plane points";

/// An initial penetration counts as round-off if it is at most this fraction of a + b. Here a is the distance of the
/// body's extreme point from its centre along the normal, and b is the distance of the plane from the origin.
constexpr double round_off = 1e-12;

Eigen::Vector3d vector_of(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

/// The depth by which the initial body penetrates a plane, in the units of the user. The result is 0 without
/// penetration, or if the depth is only round-off.
double depth(const Scene& scene, const loads::Plane& plane) {
  const Eigen::Vector3d axes = scene.body.radius * vector_of(scene.body.semi_axes);
  const Eigen::Matrix3d Q = loads::to_eigen(scene.initial_state.deformation);
  const double reach = axes.cwiseProduct(Q.transpose() * plane.normal).norm();
  const double behind = reach - plane.height(vector_of(scene.initial_state.center));
  return behind > round_off * (reach + std::abs(plane.position)) ? behind : 0;
}

/// Refuses different numbers of normals and points, and normals that are zero.
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

/// Refuses a list of speeds or amplitudes that is not empty and does not have one number for each plane.
std::optional<Refusal> refuses_motion_of_planes(const loads::RigidPlanes& load) {
  const std::size_t n_planes = load.normals.size() / 3;
  for (const auto& [path, values] :
       {std::pair{"Loads/Plane speeds", &load.speeds}, std::pair{"Loads/Plane amplitudes", &load.amplitudes}})
    if (!values->empty() && values->size() != n_planes)
      return Refusal{path, fmt::format("expected a number for each plane or nothing, got {} for {} planes",
                                       values->size(), n_planes)};
  return {};
}

/// Refuses bodies with a matrix Body/Inertia or a mesh from a file, because Body/Semi-axes does not describe their
/// surface.
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

namespace {

/// Length of the cells at a pole, along the axis, in radii (continuum/mesh/ball_mesh.h). The outer cells of the
/// unrefined mesh reach from 0.528 to 1 on the axis. Refinement divides an outer cell into n = 2^refinements cells
/// along the axis. With the grading g = 1, these cells have equal lengths. With a grading g < 1, the outermost of these
/// cells has the fraction (exp(β/n) − 1)/(exp β − 1) of the length of the outer cell. A bisection finds β from β/(exp β
/// − 1) = g.
double cell_at_pole(const Scene& scene, int refinements) {
  constexpr double unrefined = 1 - 0.528;
  const double size = scene.continuum.grading, part = std::ldexp(1.0, -refinements);
  if (size == 1) return unrefined * part;
  double least = 0, most = 100;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (least + most);
    (middle / std::expm1(middle) > size ? least : most) = middle;
  }
  return unrefined * std::expm1(most * part) / std::expm1(most);
}

}  // namespace

std::string MeshedContact::line() const {
  return fmt::format(
      "plane stiffness: {:.3g} times N(N + 1) mu/(2 h), which cells of the length h = {:.3g} radii resolve", ratio,
      cell);
}

std::string MeshedContact::warning() const {
  if (ratio <= most) return {};
  return fmt::format(
      "Loads/Plane stiffness: it is {:.3g} times the stiffness that the mesh resolves, so the force of finite elements "
      "oscillates during contact; raise Continuum/Degree or Continuum/Refinements, lower Continuum/Grading, or lower "
      "the stiffness",
      ratio);
}

std::optional<MeshedContact> meshed_contact(const Scene& scene) {
  const auto& load = scene.loads.get<loads::RigidPlanes>();
  const auto mesh = fixed_discretization(scene);
  const auto models = models_of(scene);
  const bool has_elements =
      std::ranges::any_of(models, [](const ModelDescription* model) { return model->discretized; });
  if (load.normals.empty() || !mesh || !has_elements || is_fluid(scene)) return {};
  const double radius = scene.body.radius, modulus = scene.material.shear_modulus, time = time_scale(scene);
  const double usual = loads::RigidPlanes::usual_stiffness * scene.body.density * radius / (time * time);
  const double cell = cell_at_pole(scene, mesh->refinements);
  const double resolved = mesh->degree * (mesh->degree + 1) * modulus / (2 * cell * radius);
  return MeshedContact{cell, load.stiffness.value_or(usual) / resolved};
}

}  // namespace pseudorigid::scene
