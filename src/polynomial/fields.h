#pragma once
/// Fields of a polynomial body for pictures, at points that the caller chooses. With the reference position X and the
/// position x, they include
///
///   F = ∂x/∂X,   σ = (P(F) − (λ − ρ(φ − φ̄)) F⁻ᵀ)Fᵀ / det F
///
/// σ is the Cauchy stress. P is the first Piola–Kirchhoff stress of the law and of the viscoelastic branches, without
/// volumetric stabilisation and viscosity. λ is the multiplier of the motion, or 0 without constraint. With
/// self-gravity, φ is the potential per mass. The constant φ̄ follows from ρφ̄V = (5/3)Ê with the volume V and the
/// energy Ê of self-gravity. The forces of Ê act on the surface (gravity/surface_gravity.h), and true gravity acts in
/// the interior. Therefore λ contains ρ(φ − φ̄) in addition to the Kirchhoff pressure. Without self-gravity, this term
/// is 0. The points may also be outside the computed sector, because the polynomials are known in the whole body. All
/// quantities are in internal units.

#include <Eigen/Core>
#include <vector>

#include "mechanics/core/body_fields.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

class FieldsAtPoints {
 public:
  /// `points` are points ξ of the unit ball. The reference positions are X = S ξ, with the diagonal matrix S of the
  /// semi-axes.
  FieldsAtPoints(const PolynomialSpace& space, const std::vector<Eigen::Vector3d>& points);

  /// Sets `fields` to the centre of mass x_c, the moment ∫ρ (x − x_c) Xᵀ dX and the fields at the points. With
  /// self-gravity, the fields include the potential. q and v are the coefficients of the position and of the velocity.
  /// `lambda` has the coefficients of λ, and is empty for a body without constraint. Fails if det F is not positive and
  /// finite at a point.
  mechanics::Status fields(const PolynomialBody& body, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           const Eigen::VectorXd& lambda, mechanics::BodyFields& fields) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::vector<Jet>> functions_;  ///< values and gradients of all basis functions at each point
};

}  // namespace pseudorigid::polynomial
