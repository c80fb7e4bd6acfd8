#pragma once
/// Observables of polynomial bodies at one state, the same as of the finite-element ball (continuum/output/observe.h),
/// whole body, internal units. Quantities relative to an affine motion (Q_M, J, Z, the non-affine parts) are taken
/// about the centre of mass.

#include "observables/body_observables.h"
#include "polynomial/compressible_body.h"
#include "polynomial/incompressible_body.h"

namespace pseudorigid::polynomial {

using BodyState = mechanics::VectorState<Eigen::VectorXd>;

/// Fails if the force fails.
mechanics::Status observe(const IncompressibleBody& body, const BodyState& state,
                          IncompressibleBody::Workspace& workspace, const mechanics::ObservableRequest& request,
                          mechanics::ContinuumObservables& observables);
mechanics::Status observe(const CompressibleBody& body, const BodyState& state, CompressibleBody::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& observables);

}  // namespace pseudorigid::polynomial
