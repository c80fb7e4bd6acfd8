#pragma once
/// Rigid planes n·x = z₀, with the body on the side n·x > z₀, and the law of contact with a plane. At a point of the
/// surface with the penetration d = z₀ − n·x > 0, the pressure of the plane is
///
///   p = k d (1 + β ḋ)   along n, per area of the reference surface,
///
/// without friction. For a reference ellipsoid X = S ξ, the reference area is the area of the sphere |ξ| = 1. The
/// energy k d²/2 of the contact is a penalty for d > 0, and k → ∞ enforces n·x ≥ z₀. The coefficient β of Hunt and
/// Crossley (1975) is 0 for a conservative contact. The damping dissipates the power k β d ḋ² per area. At fast
/// separation, ḋ < −1/β, the plane attracts the body.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

namespace pseudorigid::loads {

struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit normal n, pointing to the side of the body
  double position = 0;                                ///< position z₀
  double stiffness = 0;                               ///< stiffness k
  double damping = 0;                                 ///< damping coefficient β

  double height(const Eigen::Vector3d& x) const { return normal.dot(x) - position; }
  /// The pressure p at a point of the surface with the position x and the velocity v.
  double pressure(const Eigen::Vector3d& x, const Eigen::Vector3d& v) const {
    const double d = std::max(0.0, -height(x));
    return stiffness * d * (1 - damping * normal.dot(v));
  }
  bool operator==(const Plane& other) const {
    return normal == other.normal && position == other.position && stiffness == other.stiffness &&
           damping == other.damping;
  }
};

/// A list of planes. The sum of two lists has the planes of both.
struct Planes : std::vector<Plane> {
  using std::vector<Plane>::vector;

  Planes& operator+=(const Planes& others) {
    insert(end(), others.begin(), others.end());
    return *this;
  }
  bool damped() const {
    for (const Plane& plane : *this)
      if (plane.damping != 0) return true;
    return false;
  }
  /// Returns an upper bound for the contact stiffness of a point of the surface, in any direction and with any number
  /// of planes. The stiffnesses of planes with the same normal n add up. A point cannot touch two planes that face each
  /// other, so the larger sum counts for n and −n. The bound is the smaller of the Frobenius norm of Σ k n nᵀ and its
  /// largest sum of absolute values in a row.
  double stiffness_of_all() const {
    constexpr double parallel = 1 - 1e-12;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < size(); ++i) {
      double same = 0, facing = 0;
      bool is_first = true;
      for (std::size_t j = 0; j < size(); ++j) {
        const double cosine = (*this)[i].normal.dot((*this)[j].normal);
        if (std::abs(cosine) <= parallel) continue;
        (cosine > 0 ? same : facing) += (*this)[j].stiffness;
        is_first = is_first && j >= i;
      }
      if (is_first) sum += std::max(same, facing) * (*this)[i].normal * (*this)[i].normal.transpose();
    }
    return std::min(sum.norm(), sum.cwiseAbs().rowwise().sum().maxCoeff());
  }
};

}  // namespace pseudorigid::loads
