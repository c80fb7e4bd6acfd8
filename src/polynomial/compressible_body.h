#pragma once
/// The compressible polynomial body, q̈ = f without a constraint. For degree 1 it is the pseudo-rigid body on GL⁺(3).

#include "mechanics/core/unconstrained.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

class CompressibleBody : public PolynomialBody, public mechanics::Unconstrained {
 public:
  struct Workspace : mechanics::Unconstrained::Workspace {
    const Vector* held_at = nullptr;  ///< see PolynomialBody::applied_force
  };
  using PolynomialBody::PolynomialBody;

  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace& workspace, Vector& f) const {
    return applied_force(t, q, v, workspace.held_at, f);
  }
  Workspace make_workspace() const { return {}; }
};

}  // namespace pseudorigid::polynomial
