#pragma once
/// Motions of polynomial bodies of degree 3 for the suites that exist for every method.

#include "polynomial/samples.h"

namespace pseudorigid::testing {

/// Neo-Hookean; λ = 1 where the volume is free.
template <class Body>
Body elastic_body(const Planes& planes, int degree = 3) {
  return Body(BodySetup{
      .degree = degree, .reflect = planes, .law = materials::CiarletGeymonat{1, incompressible<Body> ? 0.0 : 1.0}});
}

/// Q₀ = diag(1.15, 1, 1/1.15), Q̇₀ = Q₀L with as much of L as the planes admit; affine at first, and not for long.
template <class Body>
State<Body> pulsating(const Body& body) {
  Matrix3d L;
  L << 0.1, -0.4, 0.05, 0.3, -0.15, 0.1, 0, -0.05, 0.05;
  const Matrix3d Q = Vector3d(1.15, 1, 1 / 1.15).asDiagonal();
  return {0, body.affine(Q), body.affine(Q * admitted(body.space().reflect(), L))};
}

/// |x − affine part|, of all motions that the tests look at the sign that degree 3 matters.
template <class Body>
double nonaffine_part(const Body& body, const VectorXd& q) {
  return (q - body.affine(body.space().affine_part(q), body.space().mean(q))).norm();
}

}  // namespace pseudorigid::testing
