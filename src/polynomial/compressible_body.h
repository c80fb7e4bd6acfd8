#pragma once
/// The compressible polynomial body. The coefficients q of its position satisfy q̈ = f with the forces f, without a
/// constraint. The body of degree 1 is the compressible pseudo-rigid body.

#include "mechanics/core/unconstrained.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

class CompressibleBody : public PolynomialBody, public mechanics::Unconstrained {
 public:
  struct Workspace : mechanics::Unconstrained::Workspace {
    /// If null, the contact with the planes acts. Otherwise springs replace the contact
    /// (PolynomialBody::applied_force), and `held_at` has the coefficients of the position at which the springs have no
    /// force.
    const Vector* held_at = nullptr;
  };
  using PolynomialBody::PolynomialBody;

  /// Sets f to all forces. Fails if q is not an admissible deformation.
  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& workspace, Vector& f) const {
    return applied_force(t, q, v, workspace.held_at, f);
  }
  Workspace make_workspace() const { return {}; }
};

}  // namespace pseudorigid::polynomial
