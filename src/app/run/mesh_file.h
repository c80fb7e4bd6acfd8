#pragma once
/// The file of Continuum/Mesh: reads a body in the unit of Body/Radius and converts it to internal units (X/r), with
/// its centre of mass at the origin.

#include <string>

#include "io/hexahedral_mesh.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

struct CenteredMesh {
  io::HexahedralMesh mesh;           ///< internal units
  io::HexahedralMesh::Point center;  ///< the centre of mass in the file, in the file's units
  bool is_moved;                     ///< by more than round-off
};

/// Throws UserError.
CenteredMesh read_mesh_file(const scene::Scene& scene);

/// How many cells the file of the scene's mesh has, 0 for the builtin mesh. Throws UserError, of the entry, if the mesh
/// cannot be used.
std::size_t require_mesh_file(const scene::Scene& scene, const scene::Origins& origins);

/// Representation of the mesh in the scene of a checkpoint: the bytes of a file count, not its path.
std::string mesh_identity(const scene::Scene& scene);

}  // namespace pseudorigid::app
