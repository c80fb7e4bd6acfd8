#pragma once
/// An adaptive method whose state is kicked after every step by the size of its own round-off,
///
///   x ← x (1 ± ε part)   for each component x of q and q̇,
///
/// with signs that look random and are the same in every run; ε is the spacing of floating-point numbers at 1. The
/// motion is one that arithmetic may give as well. As in arithmetic, an exact 0 stays 0.

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
    double part = 1;  // −1: all kicks the other way
    std::uint64_t n_kicks = 0;
  };

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
  /// The parity of a multiple of the golden ratio's digits: neither constant nor periodic.
  static double sign(std::uint64_t k) { return std::popcount(k * 0x9e3779b97f4a7c15u) % 2 == 0 ? 1 : -1; }
};

}  // namespace pseudorigid::mechanics
