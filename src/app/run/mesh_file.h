#pragma once
/// The mesh file of the entry Continuum/Mesh. The coordinates in the file have the unit of length of Body/Radius. The
/// program converts the coordinates to internal units (X/r) and shifts the centre of mass to the origin.

#include <string>

#include "io/hexahedral_mesh.h"
#include "scene/read_scene.h"

namespace pseudorigid::app {

/// The mesh of a file, with its centre of mass at the origin.
struct CenteredMesh {
  io::HexahedralMesh mesh;           ///< in internal units
  io::HexahedralMesh::Point center;  ///< centre of mass in the unit of length of the file
  bool is_moved;                     ///< true if the shift exceeds round-off
};

/// Reads, converts and shifts the mesh. Throws UserError if the file cannot be read or is not the mesh of one body.
/// Also throws UserError if the largest distance of a node from the centre of mass is not between 0.1 and 10 times
/// Body/Radius.
CenteredMesh read_mesh_file(const scene::Scene& scene);

/// Returns the number of cells of the scene's mesh file, or 0 if no model of the scene uses a mesh file. If the mesh
/// cannot be used, throws a UserError that names the entry and its origin (`origins`).
std::size_t require_mesh_file(const scene::Scene& scene, const scene::Origins& origins);

/// Text that identifies the mesh in a checkpoint. If the scene uses a mesh file, the text is a checksum of the bytes of
/// the file. The path of the file then does not matter. Otherwise the text is the entry Continuum/Mesh.
std::string mesh_identity(const scene::Scene& scene);

}  // namespace pseudorigid::app
