#pragma once
/// The position-extended Forest–Ruth-like method (Omelyan, Mryglod, Folk, Comput. Phys. Commun. 146 (2002) 188), an
/// explicit splitting of order 4 for systems without constraints, M q̈ = f(t, q):
///
///   Ψ_h = D_{ξh} K_{(1−2λ)h/2} D_{χh} K_{λh} D_{(1−2(χ+ξ))h} K_{λh} D_{χh} K_{(1−2λ)h/2} D_{ξh},
///   D_s:  q ← q + s v,  t ← t + s,        K_s:  v ← v + s M⁻¹f(t, q).
///
/// Drifts D and kicks K are symplectic maps and the product is a palindrome: the method is symplectic and symmetric for
/// any ξ, λ, χ. Two equations of order make it one of order 4, and the one number left makes its error small. As λ < 0,
/// two of the kicks go backwards in time.

#include <array>
#include <cmath>

#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics {

template <ConstrainedSystem S>
struct PefrlWorkspace {
  explicit PefrlWorkspace(const S& system)
      : system(system.make_workspace()),
        acceleration(system.make_vector()),
        q_rounding(make_rounding(system)),
        v_rounding(make_rounding(system)) {}

  typename S::Workspace system;
  typename S::Vector acceleration;            // M⁻¹f
  typename S::Vector q_rounding, v_rounding;  // what rounding has kept back from q and v
  Counters counters;

  /// Hands out what belongs to the state of the computation and must survive a checkpoint.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    if constexpr (VectorSpace<typename S::Vector>::compensated) {
      visit(local_values(q_rounding));
      visit(local_values(v_rounding));
    }
  }
};

struct Pefrl {
  static constexpr const char* name = "pefrl";
  static constexpr const char* documentation =
      "explicit symplectic splitting of order 4 (Omelyan, Mryglod, Folk), 4 forces a step, without constraints";
  static constexpr int order = 4;
  static constexpr int n_stages = 4;
  static constexpr bool symplectic = true, symmetric = true;
  static constexpr bool adaptive = false, chosen_by_auto = false, takes_any_vector = true;
  /// Largest hω of the harmonic oscillator for which the step is stable.
  static constexpr double stability_limit = 2.98;

  template <class S>
  using Workspace = PefrlWorkspace<S>;
  template <class S>
  static constexpr bool fits = [] {
    if constexpr (ConstrainedSystem<S>)
      return unconstrained<S>;
    else
      return false;
  }();

  /// Whether the promises of the method hold for this system; if not, why.
  template <ConstrainedSystem S>
  static Status accepts(const S& system) {
    if (velocity_dependent(system) || dissipative(system))
      return Status::failure(
          "pefrl is explicit and takes some substeps backwards in time: it is for forces that neither depend on the "
          "velocity nor dissipate; use rattle or explicit-8");
    return {};
  }

  template <ConstrainedSystem S>
  static Status advance(const S& system, double h, State<S>& state, PefrlWorkspace<S>& w) {
    for (const auto& [d, k] : stages) {
      drift<S>(d * h, state, w);
      if (Status status = kick(system, k * h, state, w); !status) return status;
    }
    drift<S>(xi * h, state, w);
    return {};
  }

  /// Without constraints there is nothing to project onto.
  template <ConstrainedSystem S>
  static Status project_velocity(const S&, State<S>&, PefrlWorkspace<S>&) {
    return {};
  }

 private:
  static constexpr double xi = 0.1786178958448091, lambda = -0.2123418310626054, chi = -0.06626458266981849;
  /// A drift and the kick after it, in units of h.
  static constexpr std::array<std::array<double, 2>, n_stages> stages{
      {{xi, (1 - 2 * lambda) / 2}, {chi, lambda}, {1 - 2 * (chi + xi), lambda}, {chi, (1 - 2 * lambda) / 2}}};

  template <class S>
  static void drift(double s, State<S>& state, PefrlWorkspace<S>& w) {
    add(s, state.v, state.q, w.q_rounding);
    state.t += s;
  }

  template <class S>
  static Status kick(const S& system, double s, State<S>& state, PefrlWorkspace<S>& w) {
    ++w.counters.n_substeps;
    ++w.counters.n_force;
    if (Status status = system.force(state.t, state.q, state.v, w.system, w.acceleration); !status) return status;
    system.apply_inverse_mass(w.acceleration, w.acceleration);
    if (!std::isfinite(dot(w.acceleration, w.acceleration))) return Status::failure("the force is not finite");
    add(s, w.acceleration, state.v, w.v_rounding);
    return {};
  }
};

}  // namespace pseudorigid::mechanics
