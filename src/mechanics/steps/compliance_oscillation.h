#pragma once
/// The amplitude of the fast oscillation of a compliant constraint (mechanics/core/constrained_system.h). The motion of
/// g = g(q) is a slow motion g_s with a fast oscillation about it. With the multiplier λ of the slow motion and the
/// stiffness κ, g_s = −λ/κ. At a state (q, v) the oscillation has the displacement and the rate
///
///   d = g + λ/κ,   ḋ = G(q) v,
///
/// without the small rate of g_s. A uniform change of volume by the factor e has g = c = G(q)q/3. The least frequency ω
/// of pressure waves is about 3√κ/a for a body of the size a. The root mean square of the oscillation of ln J over the
/// body is then at most about A = √(|d|² + |ḋ|²/ω²)/|c|. Steps that do not resolve these waves change the phase of the
/// oscillation. Two phases differ by up to 2A in ln J, and by up to 2A/3 in the entries of Q if the oscillation is
/// uniform. In releases of the ball they differed by up to 1.4 times this number.

#include <cmath>

#include "mechanics/core/constrained_system.h"

namespace pseudorigid::mechanics {

/// Sets `amplitude` to A at a state, in internal units. Fails if a force or a Gram solve fails.
template <Compliant S>
Status compliance_oscillation(const S& system, const State<S>& state, typename S::Workspace& workspace,
                              double& amplitude) {
  const double kappa = system.constraint_stiffness();
  auto lambda = system.make_multiplier(), d = lambda, rate = lambda, uniform = lambda;
  if (Status status = multiplier_of_motion(system, state, workspace, lambda); !status) return status;
  if (Status status = system.constraint(state.q, d); !status) return status;
  axpy(1 / kappa, lambda, d);
  system.constraint_rate(state.q, state.v, rate);
  system.constraint_rate(state.q, state.q, uniform);
  const double omega = 3 * std::sqrt(kappa) / max_norm(state.q);
  const double square = dot(d, d) + dot(rate, rate) / (omega * omega);
  amplitude = std::sqrt(square / (dot(uniform, uniform) / 9));
  return {};
}

}  // namespace pseudorigid::mechanics
