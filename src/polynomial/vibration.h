#pragma once
/// The energy of vibration of an incompressible elastic ball, described by a polynomial body (observables/vibration.h).
/// The scalar products of the motion with the modes of the ball are sums over quadrature points. These sums are exact.

#include "observables/vibration.h"
#include "polynomial/observe.h"

namespace pseudorigid::polynomial {

class BodyVibration {
 public:
  /// The reference body of `space` must be the unit ball.
  explicit BodyVibration(const PolynomialSpace& space);

  /// The energy of vibration and its parts at a state. `known` must contain the centre of mass, the mass moment Q_M
  /// (observe.h), the time derivatives of these two quantities, and the elastic energy.
  mechanics::VibrationObservables observe(const BodyState& state, const mechanics::ContinuumObservables& known) const;

 private:
  PolynomialSpace space_;  ///< space of the body, but with more quadrature points
  mechanics::Vibration vibration_;
};

}  // namespace pseudorigid::polynomial
