#pragma once
/// The compressible elastic ball: the finite-element ball without constraint,
///
///   M ẍ = −∫P:∇φ + loads,
///
/// whose restriction to x = QX is the pseudo-rigid body on GL⁺(3). No pressure and no Gram solver are made.

#include "continuum/body/ball_body.h"

namespace pseudorigid::continuum {

class CompressibleBall : public BallBody {
 public:
  using Multiplier = mechanics::NoMultiplier;
  struct Workspace {};
  static constexpr int n_constraints = 0;

  using BallBody::BallBody;

  mechanics::Status force(double t, const Vector& x, const Vector& v, Workspace&, Vector& f) const {
    return applied_force(t, x, v, f);
  }
  mechanics::Status constraint(const Vector&, Multiplier&) const { return {}; }
  void constraint_rate(const Vector&, const Vector&, Multiplier&) const {}
  void constraint_curvature(const Vector&, const Vector&, Multiplier&) const {}
  void add_reaction(const Vector&, const Multiplier&, Vector&) const {}
  mechanics::SolveReport solve_gram(const Vector&, const Vector&, const Multiplier&, Workspace&, Multiplier&) const {
    return {};
  }
  double constraint_tolerance() const { return 0; }

  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return {}; }
};

}  // namespace pseudorigid::continuum
