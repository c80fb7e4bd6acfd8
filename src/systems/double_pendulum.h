#pragma once
/// Planar double pendulum in multiplier form (Oliva, Geometric Mechanics, 5.5.2) with the positions q = (q₁, q₂) ∈ R⁴
/// and the reactions R_k of the rods on the points. The second axis (y) points downwards:
///
///   m₁q̈₁ = m₁g e_y + R₁,   m₂q̈₂ = m₂g e_y + R₂                                                        (5.43)
///   g₁ = ½(|q₁|²/l₁² − 1) = 0,   g₂ = ½(|q₂ − q₁|²/l₂² − 1) = 0                                (5.33), (5.34)
///   R₂ = λ₂(q₂ − q₁)/l₂²,   R₁ + R₂ = λ₁q₁/l₁²
///   U = −m₁g y₁ − m₂g y₂
///
/// with masses m_k, rods of length l_k, the acceleration of gravity g, constraints g_k, multipliers λ_k and the
/// potential U. The angles θ, φ of the Lagrange form are defined by q₁ = l₁(sin θ, cos θ), q₂ − q₁ = l₂(sin φ, cos φ).

#include <Eigen/Dense>
#include <cmath>

#include "mechanics/core/conservative_system.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

class DoublePendulum {
 public:
  using Vector = Eigen::Vector4d;
  using Multiplier = Eigen::Vector2d;
  struct Workspace {};
  static constexpr int n_constraints = 2;

  struct Parameters {
    double m1 = 1, m2 = 1, l1 = 1, l2 = 1, g = 1;
  };

  explicit DoublePendulum(const Parameters& parameters) : p_(parameters) {}

  mechanics::Status force(double, const Vector&, const Vector&, Workspace&, Vector& f) const {
    f << 0, p_.m1 * p_.g, 0, p_.m2 * p_.g;
    return {};
  }
  /// Solves for the stages of a Gauss step in SIMD lanes. If the result is false, the stages must be evaluated one by
  /// one (mechanics/core/stage_by_stage.h).
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const {
    return solve_stages_in_lanes_of(PendulumOfStages{p_.m1, p_.m2, p_.l1, p_.l2, p_.g}, stages);
  }
  double cost_of_iteration() const { return cost_of_iteration_in_lanes<PendulumOfStages>; }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a << f.head<2>() / p_.m1, f.tail<2>() / p_.m2; }
  void apply_mass(const Vector& v, Vector& f) const { f << p_.m1 * v.head<2>(), p_.m2 * v.tail<2>(); }

  mechanics::Status constraint(const Vector& q, Multiplier& g) const {
    g << 0.5 * (q.head<2>().squaredNorm() / square(p_.l1) - 1), 0.5 * (rod(q).squaredNorm() / square(p_.l2) - 1);
    return {};
  }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const {
    r << q.head<2>().dot(v.head<2>()) / square(p_.l1), rod(q).dot(rod(v)) / square(p_.l2);
  }
  void constraint_curvature(const Vector&, const Vector& v, Multiplier& r) const { constraint_rate(v, v, r); }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const {
    const Eigen::Vector2d along_second = lambda(1) / square(p_.l2) * rod(q);
    f.head<2>() += lambda(0) / square(p_.l1) * q.head<2>() - along_second;
    f.tail<2>() += along_second;
  }
  /// Adds the rate of the reaction G(q)ᵀλ along v to f, with the derivative G of the constraints. The constraints are
  /// quadratic, so this rate is G(v)ᵀλ.
  void add_reaction_rate(const Vector&, const Vector& v, const Multiplier& lambda, Vector& f) const {
    add_reaction(v, lambda, f);
  }
  /// Solves G(q)M⁻¹G(p)ᵀλ = r for the configurations q = `q1` and p = `q0`. G is the derivative of the constraints, and
  /// M is the mass operator. Fails if λ is not finite, for example because the matrix is singular.
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    const Eigen::Vector2d a1 = q1.head<2>() / square(p_.l1), a0 = q0.head<2>() / square(p_.l1);
    const Eigen::Vector2d b1 = rod(q1) / square(p_.l2), b0 = rod(q0) / square(p_.l2);
    Eigen::Matrix2d S;
    S << a1.dot(a0) / p_.m1, -a1.dot(b0) / p_.m1, -b1.dot(a0) / p_.m1, b1.dot(b0) * (1 / p_.m1 + 1 / p_.m2);
    lambda = S.inverse() * r;
    if (lambda.allFinite()) return {};
    return {mechanics::Status::failure("the rods have turned by a right angle within one step; use a smaller step")};
  }
  /// The largest |g_k| that counts as zero, about twice the machine precision.
  double constraint_tolerance() const { return 4e-16; }
  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return Multiplier::Zero(); }
  Workspace make_workspace() const { return {}; }

  double kinetic_energy(const Vector& v) const {
    return 0.5 * (p_.m1 * v.head<2>().squaredNorm() + p_.m2 * v.tail<2>().squaredNorm());
  }
  double potential_energy(const Vector& q) const { return -p_.g * (p_.m1 * q(1) + p_.m2 * q(3)); }

  /// The number of symmetries. Without gravity it is 1, because rotations of the plane about the suspension point are
  /// then symmetries. With gravity it is 0.
  int n_symmetries() const { return p_.g == 0 ? 1 : 0; }
  void symmetry(int, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const {
    dq << -q(1), q(0), -q(3), q(2);
    dv << -v(1), v(0), -v(3), v(2);
  }

  /// Computes positions and velocities from the angles (θ, φ) and their rates.
  void from_angles(const Eigen::Vector2d& angles, const Eigen::Vector2d& rates, Vector& q, Vector& v) const {
    const Eigen::Array2d sine = angles.array().sin(), cosine = angles.array().cos();
    q << p_.l1 * sine(0), p_.l1 * cosine(0), p_.l2 * sine(1), p_.l2 * cosine(1);
    v << q(1) * rates(0), -q(0) * rates(0), q(3) * rates(1), -q(2) * rates(1);
    q.tail<2>() += q.head<2>();
    v.tail<2>() += v.head<2>();
  }
  /// Computes the angles (θ, φ), from −π to π, and their rates from positions and velocities.
  void to_angles(const Vector& q, const Vector& v, Eigen::Vector2d& angles, Eigen::Vector2d& rates) const {
    const Eigen::Vector2d d = rod(q), d_rate = rod(v);
    angles << std::atan2(q(0), q(1)), std::atan2(d(0), d(1));
    rates << (q(1) * v(0) - q(0) * v(1)) / square(p_.l1), (d(1) * d_rate(0) - d(0) * d_rate(1)) / square(p_.l2);
  }

  const Parameters& parameters() const { return p_; }

 private:
  static Eigen::Vector2d rod(const Vector& q) { return q.tail<2>() - q.head<2>(); }  // second rod q₂ − q₁
  static double square(double x) { return x * x; }

  Parameters p_;
};

}  // namespace pseudorigid::systems
