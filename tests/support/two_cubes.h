#pragma once
/// The smallest mesh of Gmsh's with a face inside.

#include <string>

namespace pseudorigid::testing {

/// Two unit cubes side by side along x.
inline const std::string two_cubes =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$Nodes\n12\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n"
    "7 0 0 1\n8 1 0 1\n9 2 0 1\n10 0 1 1\n11 1 1 1\n12 2 1 1\n$EndNodes\n"
    "$Elements\n2\n1 5 2 0 1 1 2 5 4 7 8 11 10\n2 5 2 0 1 2 3 6 5 8 9 12 11\n$EndElements\n";

}  // namespace pseudorigid::testing
