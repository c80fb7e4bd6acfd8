#pragma once
/// Observables of the reduced body at one state (reduced.csv), in internal units:
///
///   J_i = ε_ijk (Q E₀ Q̇ᵀ)_jk,   Z_A = ε_ABC (E₀ Q̇ᵀQ)_BC   (PHYSICS section 1, with general E₀)

#include "mechanics/body_observables.h"
#include "mechanics/singular_values.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::reduced {

/// Fills what `request` asks for. `System` is a PseudoRigidBody or one of its other forms. Fails where the force fails.
template <class System>
mechanics::Status observe(const System& system, const mechanics::State<System>& state,
                          typename System::Workspace& workspace, const mechanics::ObservableRequest& request,
                          mechanics::BodyObservables& o) {
  const auto& body = system.body();
  const mechanics::VectorState<Eigen::Matrix3d> motion = system.motion(state);
  const Eigen::Matrix3d &Q = motion.q, &Qdot = motion.v;
  o.Q = Q;
  o.Qdot = Qdot;
  o.volume_ratio = Q.determinant();
  if (request.energies) {
    const PotentialEnergies V = body.potential_energies(Q);
    o.kinetic = body.kinetic_energy(Qdot);
    o.elastic = V.elastic;
    o.gravitational = V.gravitational;
    o.external = V.external;
    o.dissipated = system.dissipated(state);
  }
  if (request.momenta) {
    o.angular_momentum = mechanics::axial_vector(Q * body.E0() * Qdot.transpose());
    o.circulation = mechanics::axial_vector(body.E0() * Qdot.transpose() * Q);
  }
  if (request.axes) o.semi_axes = mechanics::singular_values(Q * body.reference().shape);
  if constexpr (!mechanics::unconstrained<System>) {
    if (request.multiplier) {
      double Lambda = 0;
      if (auto status = mechanics::multiplier_of_motion(system, state, workspace, Lambda); !status) return status;
      o.multiplier = Lambda / body.m_bar();
    }
  }
  return {};
}

}  // namespace pseudorigid::reduced
