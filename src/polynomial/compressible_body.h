#pragma once
/// The compressible polynomial body, q̈ = f without a constraint. The body of degree 1 is the compressible pseudo-rigid
/// body.

#include "mechanics/core/unconstrained.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

class CompressibleBody : public PolynomialBody, public mechanics::Unconstrained {
 public:
  struct Workspace : mechanics::Unconstrained::Workspace {
    /// Configuration of the springs that replace the contact (PolynomialBody::applied_force), or null for contact.
    const Vector* held_at = nullptr;
  };
  using PolynomialBody::PolynomialBody;

  /// f without reactions. Fails if q is not an admissible deformation.
  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& workspace, Vector& f) const {
    return applied_force(t, q, v, workspace.held_at, f);
  }
  Workspace make_workspace() const { return {}; }
};

}  // namespace pseudorigid::polynomial
