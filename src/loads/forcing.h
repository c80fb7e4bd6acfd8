#pragma once
/// All loads on an elastic body, as numbers, vectors and matrices. Each load (list.h) sets some members. External
/// forces per mass are affine in the position x and the velocity ẋ. Surface tractions other than contact derive from
/// stresses without divergence. All models of the body can represent such loads. On motions x = x_c + QX with the
/// centre x_c, the work of the loads is therefore the same in all models, up to the quadrature of surface integrals.
/// The full potential of companions is an exception, because only finite-element bodies have it. With the deformation
/// gradient F and the current volume V, the loads are
///
///   per mass       the force b − T x − c ẋ with the acceleration b, the tidal matrix T and the drag coefficient c;
///                  energy ½ xᵀTx − b·x per mass; the drag dissipates c|ẋ|²
///   on the surface the nominal stress P̄ − p cof F, which is a dead traction P̄N per reference area and the follower
///                  pressure −p n per current area; N and n are the reference and the current normal; energy
///                  −P̄:∫F dX + p V
///   inside         the stress σ = 2ηd with the viscosity η and the symmetric part d of the velocity gradient, and
///                  self-gravity with Newton's constant G
///   branches       viscoelastic branches with internal strains (materials/maxwell_branch.h)
///   at planes      the pressure and the friction of contact with rigid planes (plane.h)
///   companions     point masses in orbit, with the quadratic potential of their tides (mechanics/core/orbit.h)
///
/// The values are in the user's units or in internal units. The object does not record the units, so its owner must use
/// the same units in all members.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "entries/matrix3.h"
#include "loads/plane.h"
#include "materials/maxwell_branch.h"
#include "mechanics/core/by_name.h"
#include "mechanics/core/orbit.h"

namespace pseudorigid::loads {

/// The viscoelastic branches of a body. The sum of two lists has the branches of both, and is relaxed if one of them
/// is.
struct Branches {
  materials::MaxwellBranches list{};
  bool relaxed = false;  ///< true if the branches have no stress at the start

  bool empty() const { return list.empty(); }
  bool operator==(const Branches&) const = default;
  Branches& operator+=(const Branches& others) {
    list.insert(list.end(), others.list.begin(), others.list.end());
    relaxed = relaxed || others.relaxed;
    return *this;
  }
};

struct Forcing {
  ByName by_name{};
  double gravity_constant = 0;                                 ///< Newton's constant G
  Eigen::Matrix3d quadratic = Eigen::Matrix3d::Zero();         ///< matrix T of the tide, symmetric
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();      ///< uniform acceleration b
  Eigen::Matrix3d nominal_traction = Eigen::Matrix3d::Zero();  ///< dead traction P̄, a first Piola–Kirchhoff stress
  double pressure = 0;                                         ///< follower pressure p
  double viscosity = 0, drag = 0;                              ///< viscosity η and drag coefficient c
  Planes planes{};                                             ///< planes that the body may touch
  mechanics::Companions companions{};                          ///< point masses in orbit about the body
  Branches branches{};                                         ///< viscoelastic branches

  /// Calls visit(member of a, member of b) for every member except `by_name`. If the two lists of names in the function
  /// lack a new member, the function does not compile.
  template <class A, class B, class Visit>
  static void visit_pairs(A& a, B& b, Visit&& visit) {
    auto& [name_a, G_a, T_a, b_a, P_a, p_a, eta_a, c_a, planes_a, companions_a, branches_a] = a;
    auto& [name_b, G_b, T_b, b_b, P_b, p_b, eta_b, c_b, planes_b, companions_b, branches_b] = b;
    visit(G_a, G_b);
    visit(T_a, T_b);
    visit(b_a, b_b);
    visit(P_a, P_b);
    visit(p_a, p_b);
    visit(eta_a, eta_b);
    visit(c_a, c_b);
    visit(planes_a, planes_b);
    visit(companions_a, companions_b);
    visit(branches_a, branches_b);
  }

  Forcing& operator+=(const Forcing& other);

  /// Returns true if a force depends on the velocity: viscosity, drag, damping of planes or friction. The stresses of
  /// viscoelastic branches depend on internal strains and not on the velocity.
  bool damped() const { return viscosity != 0 || drag != 0 || planes.damped() || planes.rough(); }
  /// Returns true if a force or a branch can dissipate energy.
  bool dissipative() const { return damped() || !branches.empty(); }
  /// Returns true if there is a load other than the follower pressure. The motion of a body of constant volume does not
  /// depend on a pressure.
  bool acts_at_constant_volume() const;
  /// Returns true if a member differs from its default, so that there is a load.
  bool present() const;

  /// Returns the potential energy of the loads other than self-gravity, contact, companions and branches. The arguments
  /// are the moments ∫ρ x xᵀ dX and ∫ρ x dX of the body, the integral ∫F dX and the current volume V. The arguments
  /// must have the units of the forcing. If the pressure is 0, the volume is not used. If the members are the time
  /// derivatives of a forcing, the result is the power that the body receives from the change of the forcing.
  double potential(const Eigen::Matrix3d& second_moment, const Eigen::Vector3d& first_moment,
                   const Eigen::Matrix3d& F_integral, double volume) const;
};

/// True if rotations of space about the coordinate axis do not change the energy of the tide and of the traction.
bool permits_rotation_of_space(const Forcing& forcing, int axis);
/// True if rotations of the undeformed body about the coordinate axis do not change the energy of the traction.
bool permits_rotation_of_body(const Forcing& forcing, int axis);
/// True if joint rotations of space and of the undeformed body about the coordinate axis do not change the energy of
/// the tide and of the traction.
bool permits_joint_rotation(const Forcing& forcing, int axis);

/// The coordinate axes of rotations and translations of space that are symmetries of the loads, and that map the
/// symmetry planes of the computed sector to themselves.
struct FreeMotions {
  std::vector<int> turns, translations;
};
/// Both lists are empty with a tide, an acceleration, rigid planes or companions. There are no rotations with a
/// traction. `reflect[c]` is true if the plane x_c = 0 is a symmetry plane.
FreeMotions free_motions(const Forcing& forcing, const std::array<bool, 3>& reflect);

Eigen::Matrix3d to_eigen(const scene::Matrix3& m);

}  // namespace pseudorigid::loads
