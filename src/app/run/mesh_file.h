#pragma once
/// The mesh file of the entry Continuum/Mesh. The file has the unit of length of Body/Radius. The program converts it
/// to internal units (X/r) and shifts its centre of mass to the origin.

#include <string>

#include "io/hexahedral_mesh.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

struct CenteredMesh {
  io::HexahedralMesh mesh;           ///< internal units
  io::HexahedralMesh::Point center;  ///< centre of mass in the units of the file
  bool is_moved;                     ///< true if the shift exceeds round-off
};

/// Reads, converts and shifts the mesh. Throws UserError.
CenteredMesh read_mesh_file(const scene::Scene& scene);

/// Number of cells of the scene's mesh file, 0 for the builtin mesh. If the mesh cannot be used, throws a UserError
/// that names the entry.
std::size_t require_mesh_file(const scene::Scene& scene, const scene::Origins& origins);

/// Text for the mesh in the scene of a checkpoint: a checksum of the bytes of the file, so that its path does not
/// matter.
std::string mesh_identity(const scene::Scene& scene);

}  // namespace pseudorigid::app
