#pragma once
/// External forces on a rigid body as a vector measure df on its points (Oliva, Geometric Mechanics, 5.89, 5.92). The
/// body has the mass m. Its weight mg acts at the centre of mass G. Springs with stiffness k and rest length l connect
/// body points ξ with fixed points c of space. The forces have the potential
///
///   V = −m⟨g, x(G)⟩ + Σ ½k(|x(ξ) − c| − l)²,   x(ξ) the position of the body point ξ.
///
/// The equations in matrices (rigid_body.h) contain the loads as ∫df ξᵀ. Euler's equation (euler_top.h) contains them
/// as the torque ∫ξ × R⁻¹df with the rotation R.

#include <Eigen/Core>
#include <vector>

#include "mechanics/core/status.h"
#include "systems/central_force.h"

namespace pseudorigid::systems {

/// A spring between the body point ξ = `xi` and the fixed point c = `anchor` of space.
struct BodySpring {
  Eigen::Vector3d xi, anchor;
  SpringLaw law;
};

/// The weight of the body and the springs that act on it.
struct BodyLoads {
  double mass = 1;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // centre of mass G in the body
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // acceleration of gravity g in space
  std::vector<BodySpring> springs{};

  /// Calls act(ξ, f) for every force f on a body point ξ. The function place(ξ) returns the position x(ξ) in space.
  /// Fails if the length of a spring with a rest length l > 0 is 0 or NaN.
  template <class Place, class Act>
  mechanics::Status apply(const Place& place, const Act& act) const {
    if (!gravity.isZero(0)) act(center, Eigen::Vector3d(mass * gravity));
    for (const BodySpring& spring : springs) {
      Eigen::Vector3d f = Eigen::Vector3d::Zero();
      if (mechanics::Status status = central_force(spring.law, place(spring.xi) - spring.anchor, f); !status)
        return status;
      act(spring.xi, f);
    }
    return {};
  }
  /// The potential V. The function place(ξ) returns x(ξ).
  template <class Place>
  double potential_energy(const Place& place) const {
    double V = -mass * gravity.dot(place(center));
    for (const BodySpring& spring : springs) V += spring.law.energy((place(spring.xi) - spring.anchor).norm());
    return V;
  }
};

}  // namespace pseudorigid::systems
