#include "io/ellipsoid_surface.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace pseudorigid::io {

namespace {

/// Equiangular: equal steps of the index are equal angles seen from the centre. Odd in the index, so that the grid
/// has the symmetry of the cube to the last bit.
double face_coordinate(int twice_index_from_middle, int n) {
  return std::tan(std::numbers::pi / 4 * twice_index_from_middle / n);
}

}  // namespace

CubedSphere::CubedSphere(int n) {
  using Lattice = std::array<int, 3>;  // a point of the cube [-n, n]³ in steps of 2
  std::map<Lattice, std::int64_t> index;
  const auto point = [&](const Lattice& lattice) {
    const auto [found, is_new] = index.try_emplace(lattice, static_cast<std::int64_t>(points.size()));
    if (is_new) {
      Eigen::Vector3d X;
      for (int d = 0; d < 3; ++d) X[d] = face_coordinate(lattice[d], n);
      points.push_back(X.normalized());
    }
    return found->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {-n, n})
      for (int j = -n; j < n; j += 2)
        for (int i = -n; i < n; i += 2) {
          // (axis, u, v) is right-handed: going round in (u, v) is counter-clockwise seen from +axis.
          const int u = (axis + (side > 0 ? 1 : 2)) % 3, v = (axis + (side > 0 ? 2 : 1)) % 3;
          for (const auto& [di, dj] : {std::array{0, 0}, std::array{2, 0}, std::array{2, 2}, std::array{0, 2}}) {
            Lattice lattice;
            lattice[axis] = side;
            lattice[u] = i + di;
            lattice[v] = j + dj;
            connectivity.push_back(point(lattice));
          }
        }
}

UnstructuredGrid ellipsoid_surface(const CubedSphere& sphere, const HomogeneousState& state) {
  const std::size_t n_points = sphere.points.size();
  const Eigen::Matrix3d& stress = state.cauchy_stress;
  const Eigen::Matrix3d deviator = stress - stress.trace() / 3 * Eigen::Matrix3d::Identity();
  std::vector<double> points, displacement;
  points.reserve(3 * n_points);
  displacement.reserve(3 * n_points);
  for (const Eigen::Vector3d& direction : sphere.points) {
    const Eigen::Vector3d X = state.shape * direction;
    const Eigen::Vector3d x = state.center + state.radius * (state.Q * X);
    const Eigen::Vector3d u = x - state.radius * X;
    points.insert(points.end(), {x[0], x[1], x[2]});
    displacement.insert(displacement.end(), {u[0], u[1], u[2]});
  }
  const auto homogeneous = [&](double value) { return std::vector<double>(n_points, value); };
  return {.points = std::move(points),
          .cell_type = CellType::quad,
          .nodes_per_cell = 4,
          .connectivity = sphere.connectivity,
          .fields = {{"displacement", 3, std::move(displacement)},
                     {"pressure", 1, homogeneous(-stress.trace() / 3)},
                     {"jacobian", 1, homogeneous(state.Q.determinant())},
                     {"von_mises", 1, homogeneous(std::sqrt(1.5) * deviator.norm())}}};
}

}  // namespace pseudorigid::io
