#pragma once
/// Nine states of a motion at the times t + jh, j = −4 … 4, around a given state, for differences along the path. The
/// given state is the state with j = 0. Each other state is computed from the neighbour that is closer to the given
/// state, by short steps of the classical Runge–Kutta method.

#include <array>

#include "mechanics/core/explicit_multiplier.h"

namespace pseudorigid::reduced {

template <class System>
using LocalPath = std::array<mechanics::State<System>, 9>;

/// Sets `path` to the nine states around `state`, in the order of time. Fails if an acceleration cannot be computed.
template <class System>
mechanics::Status local_path(const System& system, const mechanics::State<System>& state, double h,
                             LocalPath<System>& path) {
  using Vector = typename System::Vector;
  // Number of Runge–Kutta steps between two states. The error of a derivative along the path has two parts: (h/8)⁴ in
  // order of magnitude from these steps, and h⁸ from the differences of the nine states. The steps reduce the first
  // part.
  constexpr int n_substeps = 8;
  const mechanics::ExplicitMultiplier<System> field(system);
  auto w = field.make_workspace();
  mechanics::Status status;
  Vector a = field.make_vector();
  const auto rk4_step = [&](mechanics::State<System>& s, double d) {
    constexpr std::array<double, 4> nodes{0, 0.5, 0.5, 1}, weights{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    Vector q_sum = Vector::Zero(), v_sum = Vector::Zero(), slope_q = s.v, slope_v = Vector::Zero();
    for (int i = 0; i < 4; ++i) {
      const Vector q = s.q + nodes[i] * d * slope_q, v = s.v + nodes[i] * d * slope_v;
      if (status = field.acceleration(s.t + nodes[i] * d, q, v, w, a); !status) return;
      slope_q = v;
      slope_v = a;
      q_sum += weights[i] * slope_q;
      v_sum += weights[i] * slope_v;
    }
    s.q += d * q_sum;
    s.v += d * v_sum;
    s.t += d;
  };
  path[4] = state;
  for (const int side : {1, -1})
    for (int k = 1; k <= 4; ++k) {
      path[4 + side * k] = path[4 + side * (k - 1)];
      for (int i = 0; i < n_substeps && status; ++i) rk4_step(path[4 + side * k], side * h / n_substeps);
    }
  return status;
}

}  // namespace pseudorigid::reduced
