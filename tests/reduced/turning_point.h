#pragma once
/// Turning points of spheroids diag(1/√ℓ, 1/√ℓ, ℓ) that are released from rest: where ℓ̇ = 0.

#include <cmath>
#include <numbers>

#include "reduced/bodies.h"

namespace pseudorigid::testing {

/// A state where ℓ̇ = 0: the time, and ℓ.
struct TurningPoint {
  double t, l;
};

/// The n-th turning point after the release from ℓ₀, by the secant method on ℓ̇ over the last piece of the motion. The
/// motion is marched in pieces of length `piece` until ℓ̇ has changed its sign n times.
template <class Body>
TurningPoint turning_point(const Body& body, double l0, int n, double piece = 0.1) {
  constexpr long n_steps = 10;
  State<Body> start = stretched(l0), end = start;
  int n_pieces = 0;
  for (int signs = 0; signs < n; ++n_pieces) {
    start = end;
    end = state_at(body, start, piece, n_steps);
    if (n_pieces > 0 && start.v(2, 2) * end.v(2, 2) < 0) ++signs;
  }
  double s = piece / 2, previous_s = 0, previous_rate = start.v(2, 2);
  for (int iteration = 0; iteration < 12; ++iteration) {  // secant: ℓ̇(s) = 0
    end = state_at(body, start, s, n_steps);
    const double rate = end.v(2, 2), slope = (rate - previous_rate) / (s - previous_s);
    if (rate == 0 || slope == 0 || !std::isfinite(slope)) break;
    previous_s = s;
    previous_rate = rate;
    s -= rate / slope;
    if (s == previous_s) break;
  }
  return {(n_pieces - 1) * piece + s, end.q(2, 2)};
}

/// ω/ω₀ = 1 + cA² + O(A⁴), A the amplitude of ln ℓ: c by extrapolation from two amplitudes.
template <class Body>
double frequency_shift(const Body& body, double omega_0, double piece = 0.1) {
  const auto coefficient = [&](double l0) {
    const double A = (std::log(l0) - std::log(turning_point(body, l0, 1, piece).l)) / 2;
    return (2 * std::numbers::pi / turning_point(body, l0, 2, piece).t / omega_0 - 1) / (A * A);
  };
  return (4 * coefficient(1.02) - coefficient(1.04)) / 3;
}

}  // namespace pseudorigid::testing
