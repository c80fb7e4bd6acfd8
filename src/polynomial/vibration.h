#pragma once
/// The energy of vibration of a polynomial body (observables/vibration.h), as sums over quadrature points that are
/// exact for its products with the modes.

#include "observables/vibration.h"
#include "polynomial/observe.h"

namespace pseudorigid::polynomial {

class BodyVibration {
 public:
  explicit BodyVibration(const PolynomialSpace& space);

  /// `known` has the centre of mass, its velocity, Q_M, its rate and the elastic energy.
  mechanics::VibrationObservables observe(const BodyState& state, const mechanics::ContinuumObservables& known) const;

 private:
  PolynomialSpace space_;  ///< the space of the body with more quadrature points
  mechanics::Vibration vibration_;
};

}  // namespace pseudorigid::polynomial
