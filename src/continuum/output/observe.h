#pragma once
/// Observables of the whole finite-element ball at one state (the columns of continuum.csv), in internal units. The
/// mass moment Q_M (BallBody::mass_moment), the angular momentum J, the circulation Z and the non-affine quantities are
/// relative to the centre of mass.

#include "continuum/body/compressible_ball.h"
#include "continuum/body/elastic_ball.h"
#include "observables/body_observables.h"

namespace pseudorigid::continuum {

using BallState = mechanics::VectorState<Vector>;

/// Sets the observables that `request` contains. Always sets the centre of mass, its velocity, Q_M and its time
/// derivative, the mean of F, the volume ratio and the contact. The multiplier of a compressible ball is 0. Fails if
/// the deformation is not admissible, or if the multiplier is requested and cannot be computed. Collective.
mechanics::Status observe(const ElasticBall& ball, const BallState& state, ElasticBall::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& observables);
mechanics::Status observe(const CompressibleBall& ball, const BallState& state, CompressibleBall::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& observables);

/// Sets the requested observables of an incompressible or a compressible ball, except the multiplier. Fails if the
/// deformation is not admissible. Collective.
mechanics::Status observe_motion(const BallBody& ball, const BallState& state,
                                 const mechanics::ObservableRequest& request,
                                 mechanics::ContinuumObservables& observables);

/// Returns (1/m̄)∫Jp dX over the whole ball for the pressure p of an incompressible ball, with m̄ = ⅓ tr E₀ and the
/// inertia E₀. `lambda` is the multiplier of the motion at the position x. Collective.
double mean_multiplier(const BallBody& ball, const Vector& x, const Vector& lambda);

/// Returns two numbers. The first is the kinetic energy of the ball and of the companions. The second is the potential
/// energy plus the dissipated energy, minus the energy given by loads. Both numbers are NaN if the deformation is not
/// admissible. Collective.
Eigen::Vector2d energies(const BallBody& ball, const BallState& state);

}  // namespace pseudorigid::continuum
