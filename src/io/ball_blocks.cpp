#include "io/ball_blocks.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace pseudorigid::io {
namespace {

/// Half the length of an edge of the cube in the unit ball. With this value, the thickness of the shells is between
/// 0.31 at the corners of the cube and 0.6 at the centres of its faces.
constexpr double half_edge = 0.4;

/// The coordinate of a point of the cube, divided by half the length of an edge. An edge has n intervals between
/// points. The index `twice_index_from_middle` goes from −n on one face to n on the opposite face, in steps of 2. Equal
/// steps of this index are equal angles seen from the centre. The coordinate is an odd function of the index, so that
/// the points have exactly the symmetry of the cube.
double face_coordinate(int twice_index_from_middle, int n) {
  return std::tan(std::numbers::pi / 4 * twice_index_from_middle / n);
}

/// The list of all points. A point gets its number when it is used for the first time.
class Points {
 public:
  Points(int n_intervals, int n_layers, std::vector<Eigen::Vector3d>& points)
      : n_intervals_(n_intervals), n_layers_(n_layers), points_(points) {}

  /// The number of a point in the list. The components of `cube` are the indices (face_coordinate, n = n_intervals) of
  /// a point of the cube. Layer 0 is this point. For the layers 1 to n_layers, the point of the cube must be on its
  /// surface. The points of the layers divide the ray from this point to the surface of the ball into equal parts. The
  /// last layer is on the surface of the ball.
  std::int64_t number(const std::array<int, 3>& cube, int layer) {
    const auto [found, is_new] =
        numbers_.try_emplace({cube[0], cube[1], cube[2], layer}, static_cast<std::int64_t>(points_.size()));
    if (is_new) {
      Eigen::Vector3d q;
      for (int d = 0; d < 3; ++d) q[d] = face_coordinate(cube[d], n_intervals_);
      const double s = static_cast<double>(layer) / n_layers_;
      points_.push_back(layer == 0           ? Eigen::Vector3d(half_edge * q)
                        : layer == n_layers_ ? Eigen::Vector3d(q.normalized())
                                             : Eigen::Vector3d((1 - s) * half_edge * q + s * q.normalized()));
    }
    return found->second;
  }

 private:
  int n_intervals_, n_layers_;
  std::vector<Eigen::Vector3d>& points_;
  std::map<std::array<int, 4>, std::int64_t> numbers_;
};

/// Calls append(i, j, k) for the indices, from 0 to `degree`, of the (degree + 1)³ points of a block. The first index
/// varies fastest, as PointBlocks requires.
template <class Append>
void visit_block(int degree, Append&& append) {
  for (int k = 0; k <= degree; ++k)
    for (int j = 0; j <= degree; ++j)
      for (int i = 0; i <= degree; ++i) append(i, j, k);
}

}  // namespace

BallBlocks ball_blocks(int degree, int n) {
  BallBlocks ball{.points = {}, .blocks = {.degree = degree, .points = {}}};
  const int n_intervals = degree * n;
  Points points(n_intervals, degree, ball.points);
  const auto place = [&](int block, int i) { return 2 * (block * degree + i) - n_intervals; };
  for (int c = 0; c < n; ++c)
    for (int b = 0; b < n; ++b)
      for (int a = 0; a < n; ++a)
        visit_block(degree, [&](int i, int j, int k) {
          ball.blocks.points.push_back(points.number({place(a, i), place(b, j), place(c, k)}, 0));
        });
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      // The axes (u, v, outward normal) are right-handed.
      const int u = (axis + (side > 0 ? 1 : 2)) % 3, v = (axis + (side > 0 ? 2 : 1)) % 3;
      for (int b = 0; b < n; ++b)
        for (int a = 0; a < n; ++a)
          visit_block(degree, [&](int i, int j, int layer) {
            std::array<int, 3> cube;
            cube[axis] = side * n_intervals;
            cube[u] = place(a, i);
            cube[v] = place(b, j);
            ball.blocks.points.push_back(points.number(cube, layer));
          });
    }
  return ball;
}

}  // namespace pseudorigid::io
