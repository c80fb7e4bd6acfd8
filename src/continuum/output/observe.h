#pragma once
/// Observables of the finite-element ball (continuum.csv), whole ball, internal units. Quantities relative to an affine
/// motion (Q_M, J, Z, the nonaffine parts) are taken about the centre of mass.

#include "continuum/body/compressible_ball.h"
#include "continuum/body/elastic_ball.h"
#include "observables/body_observables.h"

namespace pseudorigid::continuum {

using BallState = mechanics::VectorState<Vector>;

/// Fails if the force fails.
mechanics::Status observe(const ElasticBall& ball, const BallState& state, ElasticBall::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& observables);
mechanics::Status observe(const CompressibleBall& ball, const BallState& state, CompressibleBall::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& observables);

/// Kinetic and potential; not finite if the force fails. Collective.
Eigen::Vector2d energies(const BallBody& ball, const BallState& state);

}  // namespace pseudorigid::continuum
