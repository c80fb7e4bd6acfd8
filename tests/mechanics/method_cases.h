#pragma once
/// Motions until t = End for methods without a constraint solver. The fit of an order begins with the step
/// End/Coarsest.

#include "materials/ciarlet_geymonat.h"
#include "mechanics/toy_systems.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::testing {

/// SL(3), neo-Hookean, large pulsation and rotation.
template <int End, int Coarsest>
struct Pulsation {
  using System = reduced::PseudoRigidBody<materials::CiarletGeymonat, true>;
  System system{{1, 0}, reduced::ReferenceBody::unit_ball()};
  mechanics::State<System> initial() const {
    Eigen::Matrix3d L;
    L << 0.2, -0.8, 0.1, 0.6, -0.3, 0.2, 0, -0.1, 0.1;
    mechanics::State<System> state{0, Eigen::Vector3d(1.3, 1, 1 / 1.3).asDiagonal(), {}};
    state.v = state.q * L;
    return state;
  }
  double energy(const mechanics::State<System>& s) const {
    return system.kinetic_energy(s.v) + system.potential_energy(s.q);
  }
  static constexpr double end = End;
  static constexpr int coarsest = Coarsest;
};

template <int End, int Coarsest>
struct Pendulum {
  using System = SphericalPendulum;
  System system{};
  mechanics::State<System> initial() const { return SphericalPendulum::swinging(); }
  double energy(const mechanics::State<System>& s) const { return SphericalPendulum::energy(s); }
  static constexpr double end = End;
  static constexpr int coarsest = Coarsest;
};

template <int End, int Coarsest>
struct Oscillator {
  using System = SpringNetwork;
  System system = harmonic_oscillator();
  mechanics::State<System> initial() const { return {0, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Zero(1)}; }
  double energy(const mechanics::State<System>& s) const { return 0.5 * (s.v.squaredNorm() + s.q.squaredNorm()); }
  static constexpr double end = End;
  static constexpr int coarsest = Coarsest;
};

}  // namespace pseudorigid::testing
