#pragma once
/// Observables of the reduced body at one state (reduced.csv), in internal units:
///
///   J_i = ε_ijk (Q E₀ Q̇ᵀ)_jk,   Z_A = ε_ABC (E₀ Q̇ᵀQ)_BC   (PHYSICS section 1, with general E₀)

#include "mechanics/body_observables.h"
#include "mechanics/singular_values.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::reduced {

/// Fills what `request` asks for. Fails where the force fails.
template <class Body>
mechanics::Status observe(const Body& body, const mechanics::State<Body>& state, typename Body::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::BodyObservables& o) {
  const Eigen::Matrix3d &Q = state.q, &Qdot = state.v;
  o.Q = Q;
  o.Qdot = Qdot;
  o.volume_ratio = Q.determinant();
  if (request.energies) {
    o.kinetic = body.kinetic_energy(Qdot);
    o.elastic = body.elastic_energy(Q);
  }
  if (request.momenta) {
    o.angular_momentum = mechanics::axial_vector(Q * body.E0() * Qdot.transpose());
    o.circulation = mechanics::axial_vector(body.E0() * Qdot.transpose() * Q);
  }
  if (request.axes) o.semi_axes = mechanics::singular_values(Q);
  if constexpr (!mechanics::unconstrained<Body>) {
    if (request.multiplier) {
      double Lambda = 0;
      if (auto status = mechanics::multiplier_of_motion(body, state, workspace, Lambda); !status) return status;
      o.multiplier = Lambda / body.m_bar();
    }
  }
  return {};
}

}  // namespace pseudorigid::reduced
