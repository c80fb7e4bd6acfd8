#pragma once
/// Reader of meshes of 8-node hexahedra in Gmsh's format 2.2, ASCII ("gmsh -format msh22"):
///
///   $MeshFormat  2.2 0 8                                       $EndMeshFormat
///   $Nodes       count, then a line each: number x y z         $EndNodes
///   $Elements    count, then: number type n_tags tags nodes    $EndElements
///
/// Points, lines and quadrangles, which Gmsh adds on boundaries, and other sections are ignored. Any other type of
/// element and anything missing is a UserError "FILE:line: …" or "FILE: …". Lines may end as they do on other systems,
/// a byte order mark and comments may come first, and numbers may be those of Fortran. A mesh of which all cells are
/// left-handed is turned.

#include <filesystem>

#include "io/hexahedral_mesh.h"

namespace pseudorigid::io {

/// The mesh of the file, one body as require_one_body has it.
HexahedralMesh read_gmsh(const std::filesystem::path& file);

}  // namespace pseudorigid::io
