#pragma once
/// Fields of a polynomial body for pictures, at points that the caller chooses:
///
///   F = ∂x/∂X,   σ = (P(F) − (λ − ρ(φ − φ̄)) F⁻ᵀ)Fᵀ / det F,   P without the stabilisation's and a viscosity's part
///
/// with the multiplier λ of the motion, if there is one, and the potential φ of self-gravity, whose gauge is taken out
/// of the pressure (gravity/surface_gravity.h). Polynomials do not depend on the computed sector: a point may
/// be anywhere in the body. In internal units.

#include <Eigen/Core>
#include <vector>

#include "mechanics/core/body_fields.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

class FieldsAtPoints {
 public:
  /// Points of the unit ball, X = S ξ.
  FieldsAtPoints(const PolynomialSpace& space, const std::vector<Eigen::Vector3d>& points);

  /// `lambda`: empty of a body without constraint. Fails if det F ≤ 0.
  mechanics::Status fields(const PolynomialBody& body, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                           const Eigen::VectorXd& lambda, mechanics::BodyFields& fields) const;

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::vector<Jet>> functions_;  ///< of each point
};

}  // namespace pseudorigid::polynomial
