#pragma once
/// The compressible polynomial body: without constraint, q̈ = f. Of degree 1 it is the pseudo-rigid body on GL⁺(3).

#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

class CompressibleBody : public PolynomialBody {
 public:
  using Multiplier = mechanics::NoMultiplier;
  struct Workspace {};
  static constexpr int n_constraints = 0;

  using PolynomialBody::PolynomialBody;

  mechanics::Status force(double t, const Vector& q, const Vector& v, Workspace&, Vector& f) const {
    return applied_force(t, q, v, f);
  }
  mechanics::Status constraint(const Vector&, Multiplier&) const { return {}; }
  void constraint_rate(const Vector&, const Vector&, Multiplier&) const {}
  void constraint_curvature(const Vector&, const Vector&, Multiplier&) const {}
  void add_reaction(const Vector&, const Multiplier&, Vector&) const {}
  void add_reaction_rate(const Vector&, const Vector&, const Multiplier&, Vector&) const {}
  mechanics::SolveReport solve_gram(const Vector&, const Vector&, const Multiplier&, Workspace&, Multiplier&) const {
    return {};
  }
  double constraint_tolerance() const { return 0; }

  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return {}; }
};

}  // namespace pseudorigid::polynomial
