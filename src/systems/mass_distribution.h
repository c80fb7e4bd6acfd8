#pragma once
/// Mass, centre of mass and second moment of a body (Oliva, Geometric Mechanics, 5.6). The body is a set S of points ξ
/// in its own space K, with the mass measure m. The body has the mass m(S), the centre of mass G, the second moment E₀
/// and the inertia operator A:
///
///   m(S),   G = ∫ξ dm/m(S)   (5.72),   E₀ = ∫ξξᵀ dm,
///   A = ∫ξ × (· × ξ) dm = tr(E₀)Id − E₀   (5.80),   E₀ = ½tr(A)Id − A.
///
/// The moment of inertia about the axis through c with unit direction e is ∫|e × (ξ − c)|² dm (5.6.10). The second
/// moment about another point c is E₀ − m(Gcᵀ + cGᵀ) + m ccᵀ with m = m(S) (Steiner's theorem, 5.6.11).

#include <Eigen/Dense>
#include <span>

namespace pseudorigid::systems {

/// A mass point at the body point ξ = `xi`.
struct WeightedPoint {
  Eigen::Vector3d xi;
  double mass = 0;
};

struct MassDistribution {
  double mass = 0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  // centre of mass G
  Eigen::Matrix3d E0 = Eigen::Matrix3d::Zero();      // second moment about the origin of K

  /// The distribution of mass points. The sum of the masses must be positive.
  static MassDistribution of_points(std::span<const WeightedPoint> points) {
    MassDistribution d;
    for (const auto& p : points) {
      d.mass += p.mass;
      d.center += p.mass * p.xi;
      d.E0 += p.mass * p.xi * p.xi.transpose();
    }
    d.center /= d.mass;
    return d;
  }
  /// The distribution of the same body in coordinates whose origin is the point c of K.
  MassDistribution about(const Eigen::Vector3d& c) const {
    const Eigen::Matrix3d mixed = mass * center * c.transpose();
    return {mass, center - c, E0 - mixed - mixed.transpose() + mass * c * c.transpose()};
  }
};

/// The inertia operator A for the second moment E₀, about the same point.
inline Eigen::Matrix3d inertia_operator(const Eigen::Matrix3d& E0) {
  return E0.trace() * Eigen::Matrix3d::Identity() - E0;
}
/// The second moment E₀ for the inertia operator A, about the same point.
inline Eigen::Matrix3d second_moment(const Eigen::Matrix3d& A) {
  return 0.5 * A.trace() * Eigen::Matrix3d::Identity() - A;
}

}  // namespace pseudorigid::systems
