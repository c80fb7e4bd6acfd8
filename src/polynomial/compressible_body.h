#pragma once
/// The compressible polynomial body, q̈ = f without a constraint. The body of degree 1 is the compressible pseudo-rigid
/// body.

#include "mechanics/core/unconstrained.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

class CompressibleBody : public PolynomialBody, public mechanics::Unconstrained {
 public:
  struct Workspace : mechanics::Unconstrained::Workspace {
    /// If not null, springs replace the contact (PolynomialBody::applied_force), and these are the coefficients of the
    /// position at which the springs have no force. Null means contact with the planes.
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
