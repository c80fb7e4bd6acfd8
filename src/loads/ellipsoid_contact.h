#pragma once
/// Contact of an ellipsoid x = c + Q S ξ, |ξ| = 1, with a plane in closed form. The matrix S is the reference shape, Q
/// the affine deformation and c the centre. The plane n·x = z₀ (plane.h) has the unit normal n toward the body, the
/// position z₀, the stiffness k and the damping coefficient β. The area element of the sphere |ξ| = 1 is dA. With
///
///   g = SᵀQᵀn,   G = |g|,   h = z₀ − n·c,   u = −g·ξ/G,   d(ξ) = h + G u,
///
/// the penetration of the point ξ is d(ξ). The largest penetration is δ = h + G. If the whole body is behind the plane,
/// the least penetration is μ = h − G; otherwise μ = 0. If δ ≤ 0, there is no contact, and V = 0. The points with u >
/// −h/G are in contact. The integral over the angle about g gives dA = 2π du. The energy V and its derivatives are
///
///   V = πk (δ³ − μ³)/(3G),
///   ∂V/∂h = N = πk (δ² − μ²)/G,                 the force along n,
///   ∂V/∂G = πk [(δ² + μ²)/G − (δ³ − μ³)/(3G²)],
///   −∂V/∂c = N n,   −∂V/∂Q = −∂V/∂G n (S g/G)ᵀ.
///
/// The contact area on the sphere |ξ| = 1 is 2πδ/G, at most 4π. For a rigid unit ball and small δ, it is the area of a
/// disk of radius √(2δ), which is the intersection of the ball and the plane. When contact begins, the second
/// derivative of N = πkδ²/G with respect to δ jumps. The damping force with the coefficient β needs the rate ḋ = ż₀ −
/// n·(ċ + Q̇ S ξ) with the speed ż₀ of the plane, and the moments
///
///   I_j = 2π ∫ d u^j du,   ∫d dA = I₀,   ∫d ξ dA = −I₁ ĝ,   ∫d ξξᵀ dA = I₂ ĝĝᵀ + ½(I₀ − I₂)(Id − ĝĝᵀ),   ĝ = g/G.
///
/// These integrals are over the points in contact.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loads/contact.h"

namespace pseudorigid::loads {

/// Generalised forces on Q and c, or the rates of these forces. Forces F at the points x = c + Q X give the sum of F Xᵀ
/// on Q and the sum of F on c.
struct AffineForce {
  Eigen::Matrix3d on_Q = Eigen::Matrix3d::Zero();
  Eigen::Vector3d on_center = Eigen::Vector3d::Zero();
};

/// The contact for given Q and c. The object keeps a reference to S, which must outlive it. A plane that moves must be
/// a result of Plane::at.
class EllipsoidContact {
 public:
  EllipsoidContact(const Plane& plane, const Eigen::Matrix3d& S, const Eigen::Matrix3d& Q, const Eigen::Vector3d& c)
      : plane_(plane), S_(S), Q_(Q), c_(c), h_(-plane.height(c)) {
    const Eigen::Vector3d g = S.transpose() * (Q.transpose() * plane.normal);
    G_ = g.norm();
    direction_ = g / G_;
    deepest_ = h_ + G_;
    least_ = std::max(0.0, h_ - G_);
  }

  bool touches() const { return deepest_ > 0; }
  const Plane& plane() const { return plane_; }
  const Eigen::Matrix3d& shape() const { return S_; }
  const Eigen::Matrix3d& deformation() const { return Q_; }
  const Eigen::Vector3d& direction() const { return direction_; }  ///< unit vector ĝ = g/G
  double slope() const { return G_; }                              ///< norm G = |g|
  double deepest() const { return deepest_; }                      ///< largest penetration δ
  /// Returns the power N ż₀ that a plane with the speed ż₀ transmits, without the damping force. It is 0 without
  /// contact.
  double given() const { return touches() ? by_h() * plane_.speed : 0; }

  /// Returns the sums of contact.h in closed form, without the damping force. Without contact, only `height` is set.
  PlaneContact contact() const {
    PlaneContact result;
    result.height = -deepest_;
    if (!touches()) return result;
    result.energy = strength() * (cube(deepest_) - cube(least_)) / (3 * G_);
    result.force = by_h();
    result.area = 2 * std::numbers::pi * std::min(2.0, deepest_ / G_);
    // The moment is N c + Q S ∫p ξ dA, and ∫p ξ dA = −ĝ ∂V/∂G since ∂d/∂G = u.
    result.moment = result.force * c_ - by_G() * (Q_ * (S_ * direction_));
    // Let c_t and T be the projections of c and Q S onto the plane, so that c_t + Tξ is the projection of x. The
    // integral of p |c_t + Tξ|² is N|c_t|² + 2c_t·T∫p ξ dA + tr(T ∫p ξξᵀ dA Tᵀ). The factor 1 − u² is computed as 2t −
    // t² with t = 1 − u, which has no cancellation for small penetrations.
    const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - plane_.normal * plane_.normal.transpose();
    const Eigen::Matrix3d T = along * Q_ * S_;
    const Eigen::Vector3d of_center = along * c_, of_axis = T * direction_, of_t = strength() * moments_of_t();
    const double across = of_t[1] - 0.5 * of_t[2], whole = of_t[0];  // ½∫p (1 − u²) dA and ∫p dA
    result.spread = result.force * of_center.squaredNorm() - 2 * by_G() * of_center.dot(of_axis) +
                    across * T.squaredNorm() + (whole - 3 * across) * of_axis.squaredNorm();
    return result;
  }

  /// Adds the conservative forces −∂V/∂Q and −∂V/∂c to f.
  void add_force(AffineForce& f) const {
    if (!touches()) return;
    f.on_center += by_h() * plane_.normal;
    f.on_Q -= by_G() * plane_.normal * (S_ * direction_).transpose();
  }

  /// Adds the rate of the force of add_force() to f. The rates of Q and c are dQ and dc, and the plane is at rest.
  void add_force_rate(const Eigen::Matrix3d& dQ, const Eigen::Vector3d& dc, AffineForce& f) const {
    if (!touches()) return;
    const Eigen::Vector3d dg = S_.transpose() * (dQ.transpose() * plane_.normal);
    const double dh = -plane_.normal.dot(dc), dG = direction_.dot(dg);
    const double by_hh = 2 * strength() * (deepest_ - least_) / G_;
    const double by_hG = (2 * strength() * (deepest_ + least_) - by_h()) / G_;
    const double by_GG = 2 * strength() / G_ *
                         ((deepest_ - least_) - (square(deepest_) + square(least_)) / G_ +
                          (cube(deepest_) - cube(least_)) / (3 * square(G_)));
    f.on_center += (by_hh * dh + by_hG * dG) * plane_.normal;
    f.on_Q -= (by_hG * dh + by_GG * dG) * plane_.normal * (S_ * direction_).transpose() +
              by_G() / G_ * plane_.normal * (S_ * (dg - direction_ * dG)).transpose();
  }

  /// Adds the damping force for the velocities Qdot and cdot to f. Returns the power that this force dissipates, and
  /// the power that a moving plane transmits by this force. Without contact or damping, adds nothing and returns 0.
  ContactPower add_damping(const Eigen::Matrix3d& Qdot, const Eigen::Vector3d& cdot, AffineForce& f) const {
    if (!touches() || plane_.damping == 0) return {};
    const double factor = plane_.stiffness * plane_.damping;
    const Eigen::Vector3d of_Q = S_.transpose() * (Qdot.transpose() * plane_.normal);  // ḋ = −of_c − of_Q·ξ
    const Eigen::Vector3d I = moments();
    const double of_c = plane_.normal.dot(cdot) - plane_.speed, along = direction_.dot(of_Q);
    const double rate = -of_c * I[0] + along * I[1];  // ∫d ḋ dA
    const Eigen::Vector3d rate_xi =                   // ∫d ḋ ξ dA
        (of_c * I[1] - along * I[2]) * direction_ - 0.5 * (I[0] - I[2]) * (of_Q - along * direction_);
    f.on_center += factor * rate * plane_.normal;
    f.on_Q += factor * plane_.normal * (S_ * rate_xi).transpose();
    // The dissipated power is ∫kβ d ḋ² dA.
    return {.taken = -factor * (of_c * rate + of_Q.dot(rate_xi)), .given = factor * rate * plane_.speed};
  }

 private:
  static double square(double x) { return x * x; }
  static double cube(double x) { return x * x * x; }
  double strength() const { return std::numbers::pi * plane_.stiffness; }
  /// The derivatives of the energy V: by_h() is ∂V/∂h = N, and by_G() is ∂V/∂G.
  double by_h() const { return strength() * (square(deepest_) - square(least_)) / G_; }
  double by_G() const {
    return strength() / G_ * (square(deepest_) + square(least_) - (cube(deepest_) - cube(least_)) / (3 * G_));
  }
  /// Returns the integrals 2∫d t^j dt over 0 ≤ t ≤ T for j = 0, 1, 2, with t = 1 − u and T = min(2, δ/G). Unlike those
  /// of d u^j, the formulas of these integrals have no cancellation for small penetrations.
  Eigen::Vector3d moments_of_t() const {
    const double T = std::min(2.0, deepest_ / G_);
    Eigen::Vector3d of_t;
    for (int j = 0; j < 3; ++j) of_t[j] = 2 * std::pow(T, j + 1) * (deepest_ / (j + 1) - G_ * T / (j + 2));
    return of_t;
  }
  /// Returns the moments (I₀, I₁, I₂) of the penetration, I_j = 2π ∫ d u^j du.
  Eigen::Vector3d moments() const {
    const Eigen::Vector3d of_t = std::numbers::pi * moments_of_t();
    return {of_t[0], of_t[0] - of_t[1], of_t[0] - 2 * of_t[1] + of_t[2]};
  }

  Plane plane_;
  const Eigen::Matrix3d& S_;
  Eigen::Matrix3d Q_;
  Eigen::Vector3d c_, direction_;
  // the numbers h, G, δ and μ of the head of this file, in this order
  double h_, G_, deepest_, least_;
};

}  // namespace pseudorigid::loads
