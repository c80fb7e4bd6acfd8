#pragma once
/// Observables of the whole finite-element ball at one state (the columns of continuum.csv), in internal units. Q_M, J,
/// Z and the nonaffine quantities are computed relative to the centre of mass.

#include "continuum/body/compressible_ball.h"
#include "continuum/body/elastic_ball.h"
#include "observables/body_observables.h"

namespace pseudorigid::continuum {

using BallState = mechanics::VectorState<Vector>;

/// Sets the observables that `request` contains. Fails if the deformation is not admissible or the multiplier cannot be
/// computed. Collective.
mechanics::Status observe(const ElasticBall& ball, const BallState& state, ElasticBall::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& observables);
mechanics::Status observe(const CompressibleBall& ball, const BallState& state, CompressibleBall::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& observables);

/// Kinetic and potential energy, NaN if the deformation is not admissible. Collective.
Eigen::Vector2d energies(const BallBody& ball, const BallState& state);

}  // namespace pseudorigid::continuum
