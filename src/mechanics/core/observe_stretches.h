#pragma once
/// The extreme principal stretches of a body that is known at points.

#include "mechanics/core/body_observables.h"
#include "mechanics/core/principal_axes.h"

namespace pseudorigid::mechanics {

/// `least`: of a function of F, its least value over the quadrature points.
template <class LeastOverPoints>
void observe_stretches(const LeastOverPoints& least, ContinuumObservables& o) {
  o.min_stretch = least([](const Eigen::Matrix3d& F) { return singular_values(F)[2]; });
  o.max_stretch = -least([](const Eigen::Matrix3d& F) { return -singular_values(F)[0]; });
}

}  // namespace pseudorigid::mechanics
