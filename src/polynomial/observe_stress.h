#pragma once
/// The von Mises stress of a polynomial body (mechanics/core/von_mises.h), from the Cauchy stress of the law and of
/// viscoelastic branches.

#include "observables/body_observables.h"
#include "polynomial/polynomial_body.h"

namespace pseudorigid::polynomial {

/// Sets the mean over the reference body, and the value at the centre. Sets the largest value at the centre, at the
/// quadrature points, and at the projections of the outermost quadrature points onto the surface. Fails if det F is not
/// positive and finite at one of these points, or if the law does not admit F there.
mechanics::Status observe_stress(const PolynomialBody& body, const Eigen::VectorXd& q,
                                 mechanics::StressObservables& observables);

}  // namespace pseudorigid::polynomial
