#pragma once
/// Rigid body on k × SO(3) (Oliva, Geometric Mechanics, 5.6.19), with the Euclidean space k. The configurations are
/// matrices q = [R | x], and constraints keep R in SO(3). The body point ξ has the position x(ξ) = Rξ + x. A fixed
/// point is the origin of the body and of space, and the column x is then absent. Without a fixed point, the origin of
/// the body is the centre of mass (5.101). For the mass m, the inertia operator A and external forces df, the kinetic
/// energy K and the equations of motion are
///   K = ½tr(ṘE₀Ṙᵀ) + ½m|ẋ|²   (5.98),   E₀ = ∫ξξᵀdm,   A = tr(E₀)Id − E₀
///   [R̈E₀ | mẍ] = ∫df ξ̃ᵀ + [RΛ | 0],   RᵀR = Id,   ξ̃ = (ξ, 1), or ξ with a fixed point
///
/// With the columns c_i of R, the six constraints are g_ii = ½(|c_i|² − 1), g_jk = ⟨c_j, c_k⟩. Their order is 11 22 33
/// 23 13 12. Their six multipliers are the entries of the symmetric matrix Λ in the same order. Let M be the mass
/// operator and G the derivative of the constraints. For two configurations q₁ and q₀ with the matrices R₁ and R₀, the
/// matrix S = G(q₁)M⁻¹G(q₀)ᵀ is the map
///
///   Λ ↦ sym₂(R₁ᵀR₀ΛE₀⁻¹)   with sym₂(Y)_ii = Y_ii,  sym₂(Y)_jk = Y_jk + Y_kj.

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <utility>

#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/conservative_system.h"
#include "mechanics/core/dense_algebra.h"
#include "systems/body_loads.h"
#include "systems/body_symmetries.h"
#include "systems/mass_distribution.h"
#include "systems/small_elimination.h"

namespace pseudorigid::systems {

template <bool has_fixed_point>
class RigidBody {
 public:
  static constexpr int n_columns = has_fixed_point ? 3 : 4;
  using Vector = Eigen::Matrix<double, 3, n_columns>;
  using Multiplier = Eigen::Matrix<double, 6, 1>;
  struct Workspace {};
  static constexpr int n_constraints = 6;

  struct Parameters {
    Eigen::Matrix3d E0 = Eigen::Matrix3d::Identity();  // second moment about the origin of the body
    BodyLoads loads{};
  };

  /// Fails with the reason if the equations of this file do not apply to the body. The least eigenvalue of the second
  /// moment E₀ must be above 1e-12 times the largest eigenvalue, and the mass must be positive. Without a fixed point,
  /// the centre of mass must be the origin.
  static mechanics::Status accepts(const Parameters& p) {
    const Eigen::Vector3d e = mechanics::symmetric_spectrum(p.E0).values;
    if (!(e.minCoeff() > 1e-12 * e.cwiseAbs().maxCoeff()))
      return mechanics::Status::failure(
          "the second moment E0 has the eigenvalue " + mechanics::six_digits(e.minCoeff()) +
          ": a flat or linear body has no constrained form in GL+(3); use Euler's equation, or moments of inertia of "
          "which each is less than the sum of the two others");
    if (!(p.loads.mass > 0)) return mechanics::Status::failure("the mass of a rigid body must be positive");
    if (!has_fixed_point && !p.loads.center.isZero(0))
      return mechanics::Status::failure("a rigid body without fixed point must have its centre of mass at the origin");
    return {};
  }

  /// Constructs a body from parameters that `accepts` has accepted.
  explicit RigidBody(Parameters parameters)
      : p_(std::move(parameters)),
        E0_inverse_(p_.E0.inverse()),
        symmetries_(body_symmetries(p_.loads, has_fixed_point)) {}

  mechanics::Status force(double, const Vector& q, const Vector&, Workspace&, Vector& f) const {
    f.setZero();
    return p_.loads.apply([&](const Eigen::Vector3d& xi) { return place(q, xi); },
                          [&](const Eigen::Vector3d& xi, const Eigen::Vector3d& df) {
                            f.template leftCols<3>() += df * xi.transpose();
                            if constexpr (!has_fixed_point) f.col(3) += df;
                          });
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const {
    const Eigen::Matrix3d turning = rotation(f) * E0_inverse_;
    if constexpr (!has_fixed_point) a.col(3) = f.col(3) / p_.loads.mass;
    a.template leftCols<3>() = turning;
  }
  void apply_mass(const Vector& v, Vector& f) const {
    const Eigen::Matrix3d turning = rotation(v) * p_.E0;
    if constexpr (!has_fixed_point) f.col(3) = p_.loads.mass * v.col(3);
    f.template leftCols<3>() = turning;
  }

  /// Sets g to the six constraints. Fails if det R is not finite or not positive. The constraints alone do not exclude
  /// reflections.
  mechanics::Status constraint(const Vector& q, Multiplier& g) const {
    const Eigen::Matrix3d R = rotation(q);
    if (const double J = R.determinant(); !(J > 0 && std::isfinite(J)))
      return mechanics::Status::failure("the body has been turned inside out or is not finite: det R = " +
                                        mechanics::six_digits(J));
    const Eigen::Matrix3d C = R.transpose() * R;
    g << 0.5 * (C(0, 0) - 1), 0.5 * (C(1, 1) - 1), 0.5 * (C(2, 2) - 1), C(1, 2), C(0, 2), C(0, 1);
    return {};
  }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const {
    r = sym2(rotation(q).transpose() * rotation(v));
  }
  void constraint_curvature(const Vector&, const Vector& v, Multiplier& r) const { constraint_rate(v, v, r); }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const {
    f.template leftCols<3>() += rotation(q) * symmetric(lambda);
  }
  /// Adds the rate of the reaction G(q)ᵀλ along v to f, with the derivative G of the constraints. The constraints are
  /// quadratic, so this rate is G(v)ᵀλ.
  void add_reaction_rate(const Vector&, const Vector& v, const Multiplier& lambda, Vector& f) const {
    add_reaction(v, lambda, f);
  }
  /// Solves S λ = r for the six multipliers, with S = G(q₁)M⁻¹G(q₀)ᵀ (head of this file). Fails if the elimination does
  /// not give finite numbers, for example because the rotations R₁ and R₀ differ by a right angle.
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    const Eigen::Matrix3d B = rotation(q1).transpose() * rotation(q0);
    lambda = r;
    if (solve_by_elimination(gram(B), lambda)) return {};
    return {mechanics::Status::failure("the body has turned by a right angle within one step; use a smaller step")};
  }
  /// The largest residual of a constraint that counts as zero, about three times the machine precision.
  double constraint_tolerance() const { return 6e-16; }
  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return Multiplier::Zero(); }
  Workspace make_workspace() const { return {}; }

  double kinetic_energy(const Vector& v) const {
    Vector p;
    apply_mass(v, p);
    return 0.5 * v.cwiseProduct(p).sum();
  }
  double potential_energy(const Vector& q) const {
    return p_.loads.potential_energy([&](const Eigen::Vector3d& xi) { return place(q, xi); });
  }

  /// The number of symmetries. The first symmetries are translations of space, and the others are rotations of space
  /// about axes through the origin of space (body_symmetries.h).
  int n_symmetries() const {
    return static_cast<int>(symmetries_.translations.size() + symmetries_.turns_of_space.size());
  }
  void symmetry(int i, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const {
    const auto k = static_cast<std::size_t>(i), n_translations = symmetries_.translations.size();
    if (k < n_translations) {
      dq.setZero();
      dv.setZero();
      if constexpr (!has_fixed_point) dq.col(3) = symmetries_.translations[k];
      return;
    }
    const Eigen::Matrix3d turn = mechanics::cross_matrix(symmetries_.turns_of_space[k - n_translations]);
    dq = turn * q;
    dv = turn * v;
  }

  static Eigen::Matrix3d rotation(const Vector& q) { return q.template leftCols<3>(); }
  /// The position x(ξ) = Rξ + x of a body point.
  static Eigen::Vector3d place(const Vector& q, const Eigen::Vector3d& xi) {
    Eigen::Vector3d x = rotation(q) * xi;
    if constexpr (!has_fixed_point) x += q.col(3);
    return x;
  }
  /// The angular velocity Ω in the axes of the body, which satisfies RᵀṘ = Ω×.
  static Eigen::Vector3d body_angular_velocity(const Vector& q, const Vector& v) {
    return -0.5 * mechanics::axial_vector(rotation(q).transpose() * rotation(v));
  }
  /// The angular momentum p = ∫x × ẋ dm about the origin of space (5.77).
  Eigen::Vector3d angular_momentum(const Vector& q, const Vector& v) const {
    Eigen::Vector3d p = mechanics::axial_vector(rotation(q) * p_.E0 * rotation(v).transpose());
    if constexpr (!has_fixed_point) p += p_.loads.mass * Eigen::Vector3d(q.col(3)).cross(Eigen::Vector3d(v.col(3)));
    return p;
  }
  Eigen::Matrix3d inertia() const { return inertia_operator(p_.E0); }
  const Parameters& parameters() const { return p_; }

 private:
  using Gram = Eigen::Matrix<double, 6, 6>;
  /// The indices of the matrix entry to which each constraint and each multiplier belongs, counted from 0.
  static constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};

  /// The matrix S for B = R₁ᵀR₀. The column of the pair ij is sym₂(B E E₀⁻¹). Here E = e_i e_iᵀ if i = j, otherwise E =
  /// e_i e_jᵀ + e_j e_iᵀ.
  Gram gram(const Eigen::Matrix3d& B) const {
    Gram S;
#pragma GCC unroll 8
    for (int c = 0; c < 6; ++c) {
      const auto [i, j] = pair[c];
#pragma GCC unroll 8
      for (int r = 0; r < 6; ++r) {
        const auto [k, l] = pair[r];
        double Y = B(k, i) * E0_inverse_(j, l);
        if (i != j) Y += B(k, j) * E0_inverse_(i, l);
        if (k != l) Y += B(l, i) * E0_inverse_(j, k);
        if (i != j && k != l) Y += B(l, j) * E0_inverse_(i, k);
        S(r, c) = Y;
      }
    }
    return S;
  }
  /// The symmetric matrix Λ, whose entries 11, 22, 33, 23, 13, 12 are the six multipliers.
  static Eigen::Matrix3d symmetric(const Multiplier& l) {
    return (Eigen::Matrix3d() << l(0), l(5), l(4), l(5), l(1), l(3), l(4), l(3), l(2)).finished();
  }
  static Multiplier sym2(const Eigen::Matrix3d& Y) {
    return {Y(0, 0), Y(1, 1), Y(2, 2), Y(1, 2) + Y(2, 1), Y(0, 2) + Y(2, 0), Y(0, 1) + Y(1, 0)};
  }

  Parameters p_;
  Eigen::Matrix3d E0_inverse_;
  BodySymmetries symmetries_;
};

using FixedPointBody = RigidBody<true>;
using FreeBody = RigidBody<false>;

/// The state at time 0 of a body with a fixed point, with the rotation R and the angular velocity Ω in the body.
inline mechanics::State<FixedPointBody> turning(const Eigen::Matrix3d& R, const Eigen::Vector3d& Omega) {
  return {0, R, R * mechanics::cross_matrix(Omega)};
}
/// The state at time 0 of a free body with the rotation R and the angular velocity Ω in the body. Its centre of mass
/// has the position x and the given velocity.
inline mechanics::State<FreeBody> turning(const Eigen::Matrix3d& R, const Eigen::Vector3d& Omega,
                                          const Eigen::Vector3d& x, const Eigen::Vector3d& velocity) {
  mechanics::State<FreeBody> state;
  state.q << R, x;
  state.v << R * mechanics::cross_matrix(Omega), velocity;
  return state;
}

}  // namespace pseudorigid::systems
