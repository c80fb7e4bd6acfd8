#pragma once
/// The planar double pendulum in Lagrange form (Oliva, Geometric Mechanics, 5.5). The points have the masses m₁ and m₂,
/// and the rods have the lengths l₁ and l₂. The coordinates are the angles q = (θ, φ) of the rods from the downward
/// vertical. The y axis points downwards:
///
///   (x₁, y₁) = l₁ (sin θ, cos θ),   (x₂, y₂) = (x₁, y₁) + l₂ (sin φ, cos φ)
///   g_ij = [ (m₁+m₂) l₁²             m₂l₁l₂ cos(θ−φ) ]   U = −(m₁+m₂) g l₁ cos θ − m₂ g l₂ cos φ
///          [ m₂l₁l₂ cos(θ−φ)         m₂ l₂²          ]
///
/// with the metric g_ij of the kinetic energy, the potential U and the acceleration of gravity g. The motions (5.20)
/// satisfy the two equations below. In the book, (5.44) has two additional terms in φ̇θ̇ sin(θ−φ). One of these terms
/// has the wrong sign. If the sign is corrected, the two terms cancel each other.
///
///   (m₁+m₂) l₁² θ̈ + m₂l₁l₂ [φ̈ cos(θ−φ) + φ̇² sin(θ−φ)] + (m₁+m₂) g l₁ sin θ = 0                  (5.44), corrected
///   m₂ l₂² φ̈ + m₂l₁l₂ [θ̈ cos(θ−φ) − θ̇² sin(θ−φ)] + m₂ g l₂ sin φ = 0                             (5.45)

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "mechanics/core/automatic_differentiation.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

struct DoublePendulumChart {
  static constexpr int dimension = 2;
  double m1 = 1, m2 = 1, l1 = 1, l2 = 1, gravity = 1;

  template <class T>
  Eigen::Matrix<T, 2, 2> metric(const mechanics::Coordinates<T, 2>& q) const {
    using std::cos;
    const T coupling = m2 * l1 * l2 * cos(q[0] - q[1]);
    Eigen::Matrix<T, 2, 2> g;
    g << T((m1 + m2) * l1 * l1), coupling, coupling, T(m2 * l2 * l2);
    return g;
  }
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    using std::cos;
    return -(m1 + m2) * gravity * l1 * cos(q[0]) - m2 * gravity * l2 * cos(q[1]);
  }
  /// The positions (x₁, y₁, x₂, y₂) of both points.
  template <class T>
  Eigen::Matrix<T, 4, 1> embedding(const mechanics::Coordinates<T, 2>& q) const {
    using std::cos, std::sin;
    const T x1 = l1 * sin(q[0]), y1 = l1 * cos(q[0]);
    return {x1, y1, x1 + l2 * sin(q[1]), y1 + l2 * cos(q[1])};
  }
  /// The periods of the two angles. A search for critical points identifies points that differ by periods.
  Eigen::Vector2d periods() const { return Eigen::Vector2d::Constant(2 * std::numbers::pi); }
};

}  // namespace pseudorigid::systems
