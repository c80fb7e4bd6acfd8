#pragma once
/// Base class with the members of ConstrainedSystem that concern constraints, for a system without constraints. The
/// derived class must define Vector, `force`, `apply_inverse_mass` and `make_vector`. If its force needs a workspace,
/// the derived class also defines Workspace and make_workspace.

#include "mechanics/core/constrained_system.h"

namespace pseudorigid::mechanics {

struct Unconstrained {
  using Multiplier = NoMultiplier;
  struct Workspace {};
  static constexpr int n_constraints = 0;

  Status constraint(const auto&, Multiplier&) const { return {}; }
  void constraint_rate(const auto&, const auto&, Multiplier&) const {}
  void constraint_curvature(const auto&, const auto&, Multiplier&) const {}
  void add_reaction(const auto&, const Multiplier&, auto&&) const {}
  void add_reaction_rate(const auto&, const auto&, const Multiplier&, auto&&) const {}
  SolveReport solve_gram(const auto&, const auto&, const Multiplier&, Workspace&, Multiplier&) const { return {}; }
  double constraint_tolerance() const { return 0; }
  Multiplier make_multiplier() const { return {}; }
  Workspace make_workspace() const { return {}; }
};

}  // namespace pseudorigid::mechanics
