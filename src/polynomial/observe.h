#pragma once
/// Observables of polynomial bodies at one state. The finite-element ball has the same observables
/// (continuum/output/observe.h). The observables are for the whole body, in internal units. The angular momentum, the
/// circulation and the non-affine quantities are relative to the centre of mass x_c. The mass moment is Q_M = (∫ρ (x −
/// x_c) Xᵀ dX) E₀⁻¹ with E₀ = ∫ρXXᵀ dX. F = ∂x/∂X is the deformation gradient.

#include "observables/body_observables.h"
#include "polynomial/compressible_body.h"
#include "polynomial/incompressible_body.h"

namespace pseudorigid::polynomial {

using BodyState = mechanics::VectorState<Eigen::VectorXd>;

/// Sets the observables that `request` contains. Always sets the centre of mass, its velocity, Q_M and its time
/// derivative, the mean of F, the volume ratio and the contact. Sets the orbit if there are companions and `request`
/// contains the orbit or the energies. The multiplier of a compressible body is 0. Fails if the deformation is not
/// admissible, or if the multiplier is requested and cannot be computed.
mechanics::Status observe(const IncompressibleBody& body, const BodyState& state,
                          IncompressibleBody::Workspace& workspace, const mechanics::ObservableRequest& request,
                          mechanics::ContinuumObservables& observables);
mechanics::Status observe(const CompressibleBody& body, const BodyState& state, CompressibleBody::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& observables);

}  // namespace pseudorigid::polynomial
