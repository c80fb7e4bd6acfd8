#pragma once
/// How a point of a material surface is written to shapes.csv by every model that has such surfaces: number of the
/// face, plane (0: the surface; 1, 2, 3: the coordinate plane with this normal), X and x. The points of a face follow
/// one another.

#include <array>
#include <cstddef>

namespace pseudorigid::mechanics {

inline constexpr std::array<const char*, 8> shape_columns{"face", "plane", "X1", "X2", "X3", "x1", "x2", "x3"};
inline constexpr std::size_t first_length_of_shapes = 2;  ///< from this column on, values are lengths

}  // namespace pseudorigid::mechanics
