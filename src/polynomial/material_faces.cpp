#include "polynomial/material_faces.h"

#include <cmath>
#include <numbers>

namespace pseudorigid::polynomial {
namespace {

/// Number of intervals along a side of a patch. A quarter circle on the surface crosses two patches and has 12
/// intervals, which are enough for a smooth outline.
constexpr int m = 6;

}  // namespace

MaterialFaces::MaterialFaces(const PolynomialSpace& space) : space_(space) {
  for (int bits = 0; bits < 8; ++bits) {
    Eigen::Vector3d signs;
    bool is_computed = true;
    for (int d = 0; d < 3; ++d) {
      signs[d] = (bits >> d & 1) ? -1 : 1;
      is_computed = is_computed && !(signs[d] < 0 && space.reflect()[d]);
    }
    if (is_computed) add_octant(signs);
  }
}

template <class Place>
void MaterialFaces::add_patch(int plane, const Eigen::Vector3d& signs, const Place& at) {
  ++n_faces_;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i) {
      const Eigen::Vector3d xi = signs.cwiseProduct(at(static_cast<double>(i) / m, static_cast<double>(j) / m));
      points_.push_back(
          {n_faces_, plane, space_.semi_axes().cwiseProduct(xi), space_.functions_at({xi[0], xi[1], xi[2]})});
    }
}

void MaterialFaces::add_octant(const Eigen::Vector3d& signs) {
  using std::numbers::pi;
  for (int axis = 0; axis < 3; ++axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    add_patch(0, signs, [&](double s, double t) {
      Eigen::Vector3d p;
      p[axis] = 1, p[next] = std::tan(pi / 4 * s), p[last] = std::tan(pi / 4 * t);
      return Eigen::Vector3d(p.normalized());
    });
    // Two octants share a quarter of a plane. The octant on the positive side of the plane adds the patches of the
    // quarter.
    if (signs[axis] < 0) continue;
    for (const double inner : {0.0, 0.5})
      add_patch(axis + 1, signs, [&](double s, double t) {
        // The code sets the cosine to 0 at s = 1, so that points on the coordinate axes have no round-off.
        const double r = inner + t / 2, c = s == 1 ? 0 : std::cos(pi / 2 * s), sine = std::sin(pi / 2 * s);
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        p[next] = r * c, p[last] = r * sine;
        return p;
      });
  }
}

std::vector<std::vector<double>> MaterialFaces::rows(const Eigen::VectorXd& q) const {
  const auto coefficients = q.head(space_.n_unknowns());
  std::vector<std::vector<double>> rows;
  rows.reserve(points_.size());
  for (const auto& [face, plane, X, functions] : points_) {
    const Eigen::Vector3d x = space_.value(functions, coefficients);
    rows.push_back({static_cast<double>(face), static_cast<double>(plane), X[0], X[1], X[2], x[0], x[1], x[2]});
  }
  return rows;
}

}  // namespace pseudorigid::polynomial
