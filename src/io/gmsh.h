#pragma once
/// Reader for meshes of 8-node hexahedra in Gmsh's format 2.2, ASCII ("gmsh -format msh22"):
///
///   $MeshFormat  2.2 0 8                                       $EndMeshFormat
///   $Nodes       count, then a line each: number x y z         $EndNodes
///   $Elements    count, then: number type n_tags tags nodes    $EndElements
///
/// The reader skips other sections, and points, lines and quadrangles, which Gmsh adds on boundaries. A node that
/// belongs only to skipped elements is removed. Other elements, $ParametricNodes, missing or invalid data and files of
/// more than 256 MiB cause a UserError. The message contains the name of the file and, if it is known, the line. Lines
/// may end with LF, CR LF or CR. A byte order mark and comments may come first, and numbers may have Fortran's exponent
/// D. If all cells are left-handed, the reader reverses their orientation.

#include <filesystem>

#include "io/hexahedral_mesh.h"

namespace pseudorigid::io {

/// Reads the mesh of the file. The returned mesh satisfies the conditions of require_one_body; otherwise throws
/// UserError.
HexahedralMesh read_gmsh(const std::filesystem::path& file);

}  // namespace pseudorigid::io
