#pragma once
/// Reader for meshes of 8-node hexahedra in Gmsh's format 2.2, ASCII ("gmsh -format msh22"):
///
///   $MeshFormat  2.2 0 8                                                      $EndMeshFormat
///   $Nodes       count, then for each node: number x y z                      $EndNodes
///   $Elements    count, then for each element: number type n_tags tags nodes  $EndElements
///
/// Each node and each element is on a line of its own. The reader skips other sections, and elements of the types
/// point, line and quadrangle, which Gmsh adds on boundaries. A node that belongs only to skipped elements is removed.
/// Other elements, the section $ParametricNodes, missing or invalid data and files of more than 256 MiB cause a
/// UserError. The message contains the name of the file and, if it is known, the number of the line. Lines may end with
/// LF, CR LF or CR. The UTF-8 byte order mark and a section $Comments may come first. Numbers may have the letter D of
/// Fortran in the exponent. If all cells are left-handed, the reader reverses their orientation.

#include <filesystem>

#include "io/hexahedral_mesh.h"

namespace pseudorigid::io {

/// Reads the mesh of the file. Throws UserError if the file has an error, or if the mesh does not satisfy the
/// conditions of require_one_body.
HexahedralMesh read_gmsh(const std::filesystem::path& file);

}  // namespace pseudorigid::io
