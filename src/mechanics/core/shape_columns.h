#pragma once
/// Columns of the output file shapes.csv, the same for every model. A row is a point of a material surface. Each
/// surface is divided into faces, which have numbers. The row contains the number of the face, the number of the plane,
/// the reference position X and the position x. The plane is 0 for the surface of the body, and k for the coordinate
/// plane with the normal e_k, k = 1, 2, 3. The points of a face are consecutive rows.

#include <array>
#include <cstddef>

namespace pseudorigid::mechanics {

inline constexpr std::array<const char*, 8> shape_columns{"face", "plane", "X1", "X2", "X3", "x1", "x2", "x3"};
inline constexpr std::size_t first_length_of_shapes = 2;  ///< index of the first column with a length

}  // namespace pseudorigid::mechanics
