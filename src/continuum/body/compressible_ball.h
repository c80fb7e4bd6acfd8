#pragma once
/// The compressible elastic ball: the finite-element ball without constraint,
///
///   M ẍ = −∫P:∇φ + loads,
///
/// with the lumped mass M, the first Piola–Kirchhoff stress P, and the basis functions φ of the displacements. The
/// restriction to motions x = QX is the pseudo-rigid body with det Q > 0 and without a constraint. This ball has
/// neither a multiplier nor a Gram solver.

#include "continuum/body/ball_body.h"
#include "mechanics/core/unconstrained.h"

namespace pseudorigid::continuum {

class CompressibleBall : public BallBody, public mechanics::Unconstrained {
 public:
  struct Workspace : mechanics::Unconstrained::Workspace {
    /// Null: contact with the planes. Otherwise springs replace the contact (BallBody::applied_force), and `*held_at`
    /// has the nodal positions at which the springs exert no force.
    const Vector* held_at = nullptr;
  };
  using BallBody::BallBody;

  /// f = −∫P:∇φ + loads. Fails if BallBody::judge fails. Collective.
  mechanics::Status force(double t, const Vector& x, const Vector& v, Workspace& workspace, Vector& f) const {
    return applied_force(t, x, v, workspace.held_at, f);
  }
  Workspace make_workspace() const { return {}; }
};

}  // namespace pseudorigid::continuum
