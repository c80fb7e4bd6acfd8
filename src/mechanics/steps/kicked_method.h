#pragma once
/// An adaptive method with a perturbation (kick) of the state after every step. The kick has the size of round-off:
///
///   x ← x (1 ± ε part)   for each component x of q and q̇,
///
/// with `part` = 1, or −1 to reverse all kicks. The signs are irregular but the same in every run, and ε is the spacing
/// of floating-point numbers at 1. Kicks of this size could also be rounding errors. The perturbed motion therefore
/// shows the effect of round-off. As in floating-point arithmetic, an exact 0 remains 0.

#include <Eigen/Core>
#include <bit>
#include <cstdint>
#include <limits>

#include "mechanics/core/second_order_field.h"

namespace pseudorigid::mechanics {

template <class Method>
struct Kicked : Method {
  template <class F>
  struct Workspace : Method::template Workspace<F> {
    using Method::template Workspace<F>::Workspace;
    double part = 1;            // 1, or −1 to reverse all kicks
    std::uint64_t n_kicks = 0;  // number of components that were perturbed since the start of the run
  };

  /// Makes a step of Method and then perturbs the state. The next step therefore computes the acceleration again. If
  /// the step fails, returns its failure and does not perturb the state.
  template <SecondOrderField F>
  static Status step(const F& field, double t_limit, State<F>& state, Workspace<F>& w) {
    if (Status status = Method::step(field, t_limit, state, w); !status) return status;
    for (auto* x : {&state.q, &state.v})
      for (Eigen::Index k = 0; k < x->size(); ++k)
        x->data()[k] *= 1 + w.part * sign(w.n_kicks++) * std::numeric_limits<double>::epsilon();
    w.acceleration_known = false;
    return {};
  }

 private:
  /// Returns the sign of kick k as 1 or −1. The product of k and the odd number next to 2⁶⁴/φ, modulo 2⁶⁴, has
  /// irregular bits. Here φ is the golden ratio. The sign is positive if an even number of these bits is 1.
  static double sign(std::uint64_t k) { return std::popcount(k * 0x9e3779b97f4a7c15u) % 2 == 0 ? 1 : -1; }
};

}  // namespace pseudorigid::mechanics
