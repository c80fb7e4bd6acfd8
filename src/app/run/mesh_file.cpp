#include "app/run/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "entries/entry_kinds.h"
#include "io/checkpoint.h"
#include "io/files.h"
#include "io/gmsh.h"
#include "scene/models.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

/// Limits of the largest distance of a node from the centre of mass, in the unit Body/Radius. Lengths in internal units
/// are then of order 1.
constexpr double largest_radius = 10, least_radius = 0.1;

}  // namespace

CenteredMesh read_mesh_file(const scene::Scene& scene) {
  const double unit = scene.body.radius;
  CenteredMesh body{io::read_gmsh(scene.continuum.mesh), {}, false};
  const io::MeshSize size = io::size_of(body.mesh);
  if (!(size.radius >= least_radius * unit && size.radius <= largest_radius * unit))
    throw UserError(
        fmt::format("{}: its nodes reach {} from the centre of mass, expected {} to {} of Body/Radius = {}; "
                    "coordinates are in the same unit of length",
                    scene.continuum.mesh, scene::print_number(size.radius), least_radius, largest_radius,
                    scene::print_number(unit)));
  body.center = size.center;
  body.is_moved = std::hypot(size.center[0], size.center[1], size.center[2]) > 1e-12 * size.radius;
  for (auto& X : body.mesh.vertices)
    for (int c = 0; c < 3; ++c) X[c] = (X[c] - size.center[c]) / unit;
  return body;
}

std::size_t require_mesh_file(const scene::Scene& scene, const scene::Origins& origins) {
  if (!scene::is_discretized(scene) || !scene::has_mesh_file(scene)) return 0;
  constexpr const char* entry = "Continuum/Mesh";
  try {
    return read_mesh_file(scene).mesh.cells.size();
  } catch (const UserError& error) {
    throw UserError(fmt::format("{}: {}: {}", origins.of(entry), entry, error.what()));
  }
}

std::string mesh_identity(const scene::Scene& scene) {
  if (!scene::is_discretized(scene) || !scene::has_mesh_file(scene)) return scene.continuum.mesh;
  return fmt::format("{:016x}.msh", io::checksum(io::read_file(scene.continuum.mesh)));
}

}  // namespace pseudorigid::app
