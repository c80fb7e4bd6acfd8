#pragma once
/// Observables of the pseudo-rigid body at one state (the columns of reduced.csv), in internal units. The angular
/// momentum J and the circulation Z are
///
///   J_i = ε_ijk (Q E₀ Q̇ᵀ)_jk,   Z_A = ε_ABC (E₀ Q̇ᵀQ)_BC   (docs/oliva.md, section 1, with general E₀)
///
/// with the inertia E₀ of the reference body.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/orbiting_system.h"
#include "mechanics/core/principal_axes.h"
#include "mechanics/core/relaxation.h"
#include "mechanics/core/von_mises.h"
#include "observables/orbit.h"
#include "reduced/bipolar.h"
#include "reduced/local_path.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::reduced {

/// Sets Q, Q̇, det Q, and the quantities of `o` that `request` contains, except the bipolar observables. Also sets the
/// contact if there are planes, and the orbit if there are companions. On GL⁺(3), the multiplier and the pressure are
/// always set to 0. `System` is PseudoRigidBody, DiagonalBody, DissipativeBody or LoadedBody. Fails if `request`
/// contains the multiplier, the pressure or bipolar observables, and the multiplier cannot be computed.
template <class System>
mechanics::Status observe(const System& system, const mechanics::State<System>& state,
                          typename System::Workspace& workspace, const mechanics::ObservableRequest& request,
                          mechanics::ReducedObservables& o) {
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
    if constexpr (requires { system.driven_energy(state); })
      if (mechanics::time_dependent(system)) o.external += system.driven_energy(state);
    o.dissipated = system.dissipated(state);
    if constexpr (requires { system.energy_of_branches(state.q); })
      if (mechanics::relaxes(system)) {
        o.elastic += o.viscoelastic = system.energy_of_branches(state.q);
        o.dissipated_by_branches = system.dissipated_by_branches(state);
      }
  }
  if constexpr (requires { system.contact(state.t, state.q); })
    if (system.has_contact()) o.contact.take(system.contact(state.t, state.q));
  if (request.momenta) {
    o.angular_momentum = mechanics::axial_vector(Q * body.E0() * Qdot.transpose());
    o.circulation = mechanics::axial_vector(body.E0() * Qdot.transpose() * Q);
  }
  if constexpr (requires { system.orbit(); })
    if (mechanics::has_companions(system)) {
      const Eigen::Matrix3d QE0 = Q * body.E0();
      o.orbit = mechanics::observe_orbit(system.orbit(), system.companions(state.q), system.companions(state.v),
                                         QE0 * Q.transpose(), mechanics::axial_vector(QE0 * Qdot.transpose()));
    }
  if (request.axes) o.semi_axes = mechanics::singular_values(Q * body.reference().shape);
  if (request.vibration) {
    const Eigen::Matrix3d moment = Q * body.E0() * Q.transpose();
    const Eigen::Vector3d J = mechanics::axial_vector(Q * body.E0() * Qdot.transpose());
    const Eigen::Matrix3d inertia = moment.trace() * Eigen::Matrix3d::Identity() - moment;
    o.vibration.energy =
        body.kinetic_energy(Qdot) - 0.5 * J.dot(inertia.inverse() * J) + body.potential_energies(Q).elastic;
    o.vibration.of_degree = {o.vibration.energy};
  }
  if (request.stresses) {
    Eigen::Matrix3d stress = body.cauchy_stress(Q, 0);
    if constexpr (requires { system.stress_of_branches(state.q); })
      stress += system.stress_of_branches(state.q) * Q.transpose() / o.volume_ratio;
    o.stress.mean = o.stress.largest = o.stress.at_center = mechanics::von_mises(stress);
  }
  o.over_points = mechanics::observe_over_points(request, [&](const auto& value) { return value(Q); });
  if constexpr (mechanics::unconstrained<System>) {
    o.multiplier = o.central_pressure = 0;
  } else {
    if (request.multiplier || request.pressure || request.bipolar) {
      double Lambda = 0;
      if (auto status = mechanics::multiplier_of_motion(system, state, workspace, Lambda); !status) return status;
      o.multiplier = Lambda / body.m_bar();
      o.central_pressure = 2.5 * Lambda / body.reference().volume;
    }
  }
  return {};
}

/// Sets the bipolar observables of `o`. o.multiplier must contain the result of `observe`. `before` has the
/// decomposition at the previous sample, or is empty at the first sample. The function sets `before` to the
/// decomposition at this sample. Fails if the force or the motion near the state cannot be computed.
template <class System>
mechanics::Status observe_bipolar(const System& system, const mechanics::State<System>& state,
                                  typename System::Workspace& workspace, std::optional<Bipolar>& before,
                                  mechanics::ReducedObservables& o) {
  const mechanics::VectorState<Eigen::Matrix3d> motion = system.motion(state);
  const Bipolar b = before ? decompose(motion.q, *before) : decompose(motion.q);
  const BipolarRates r = rates(b, motion.v);
  const auto upper = [](const Eigen::Matrix3d& X) { return Eigen::Vector3d(X(0, 1), X(0, 2), X(1, 2)); };
  o.axes = b.a;
  o.T = b.T;
  o.S = b.S;
  o.Omega_star = upper(r.Omega);
  o.Lambda_star = upper(r.Lambda);
  before = b;

  LocalPath<System> path;
  // If two axes are close, the frames may rotate at a rate up to |u| divided by the distance of the axes. The step h is
  // small compared with the inverse of this rate. A distance below 1e-4 counts as 1e-4, because h must not vanish.
  const double gap = std::min({std::abs(b.a[0] - b.a[1]), std::abs(b.a[1] - b.a[2]), std::abs(b.a[2] - b.a[0])});
  const double rate = r.u.norm(), h = 0.02 / (1 + rate + rate / std::max(gap, 1e-4));
  auto force = system.make_vector();
  if (auto status = local_path(system, state, h, path); !status) return status;
  if (auto status = system.force(state.t, state.q, state.v, workspace, force); !status) return status;
  std::array<mechanics::VectorState<Eigen::Matrix3d>, 9> motions;
  for (std::size_t k = 0; k < path.size(); ++k) motions[k] = system.motion(path[k]);
  o.bipolar_residual =
      residual_of_5_121(motions, h, -System::matrix(force), o.multiplier, system.body().E0()).cwiseAbs().maxCoeff();
  return {};
}

}  // namespace pseudorigid::reduced
