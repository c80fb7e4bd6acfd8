#pragma once
/// The von Mises stress of a polynomial body (mechanics/core/von_mises.h) at the quadrature points. The Cauchy stress
/// is that of the law and of viscoelastic branches.

#include "observables/body_observables.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

/// Sets the mean over the reference body and the largest value. The value at the centre is that of the mean Cauchy
/// stress at the quadrature points nearest to it. Fails if the deformation is not admissible.
mechanics::Status observe_stress(const PolynomialBody& body, const Eigen::VectorXd& q,
                                 mechanics::StressObservables& observables);

}  // namespace pseudorigid::polynomial
