#pragma once
/// Small systems with known answers.

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::testing {

/// M q̈ = −K q + Aᵀλ,  A q = 0: linear springs, any number of linear constraints. A mass of which the inverse is 0 does
/// not move.
class SpringNetwork {
 public:
  using Vector = Eigen::VectorXd;
  using Multiplier = Eigen::VectorXd;
  struct Workspace {};
  static constexpr int n_constraints = mechanics::dynamic_constraints;

  SpringNetwork(Eigen::VectorXd inverse_mass, Eigen::MatrixXd K, Eigen::MatrixXd A = {})
      : inverse_mass_(std::move(inverse_mass)), K_(std::move(K)), A_(std::move(A)) {
    if (A_.size() == 0) A_.resize(0, inverse_mass_.size());
    gram_ = A_ * inverse_mass_.asDiagonal() * A_.transpose();
  }

  mechanics::Status force(double, const Vector& q, const Vector&, Workspace&, Vector& f) const {
    f = -K_ * q;
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f.cwiseProduct(inverse_mass_); }
  mechanics::Status constraint(const Vector& q, Multiplier& g) const {
    g = A_ * q;
    return {};
  }
  void constraint_rate(const Vector&, const Vector& v, Multiplier& r) const { r = A_ * v; }
  void constraint_curvature(const Vector&, const Vector&, Multiplier& r) const { r.setZero(A_.rows()); }
  void add_reaction(const Vector&, const Multiplier& lambda, Vector& f) const { f += A_.transpose() * lambda; }
  mechanics::SolveReport solve_gram(const Vector&, const Vector&, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    if (r.size() > 0) lambda = mechanics::solve(gram_, r);
    return {};
  }
  double constraint_tolerance() const { return 1e-15; }
  Vector make_vector() const { return Vector::Zero(inverse_mass_.size()); }
  Multiplier make_multiplier() const { return Multiplier::Zero(A_.rows()); }
  Workspace make_workspace() const { return {}; }

 private:
  Eigen::VectorXd inverse_mass_;
  Eigen::MatrixXd K_, A_, gram_;
};

/// Unit mass on a unit spring: q̈ = −q, without constraint.
inline SpringNetwork harmonic_oscillator() { return {Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Ones(1, 1)}; }

/// Unit mass on the unit sphere in the gravity (0, 0, −1), with an optional failure of its force from a time on:
/// q̈ = −e₃ + λ q,  ½(|q|² − 1) = 0.
class SphericalPendulum {
 public:
  using Vector = Eigen::Vector3d;
  using Multiplier = double;
  struct Workspace {};
  static constexpr int n_constraints = 1;
  enum class Trouble { none, failure, nan };

  explicit SphericalPendulum(Trouble trouble = Trouble::none, double from = HUGE_VAL)
      : trouble_(trouble), from_(from) {}

  mechanics::Status force(double t, const Vector&, const Vector&, Workspace&, Vector& f) const {
    f = Eigen::Vector3d(0, 0, -1);
    if (t < from_) return {};
    if (trouble_ == Trouble::failure) return mechanics::Status::failure("the rope is cut");
    f.setConstant(std::numeric_limits<double>::quiet_NaN());
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f; }
  mechanics::Status constraint(const Vector& q, Multiplier& g) const {
    g = 0.5 * (q.squaredNorm() - 1);
    return {};
  }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const { r = q.dot(v); }
  void constraint_curvature(const Vector&, const Vector& v, Multiplier& r) const { r = v.squaredNorm(); }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const { f += lambda * q; }
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    lambda = r / q1.dot(q0);
    return {};
  }
  double constraint_tolerance() const { return 2e-16; }
  Vector make_vector() const { return Vector::Zero(); }
  Multiplier make_multiplier() const { return 0; }
  Workspace make_workspace() const { return {}; }

  static mechanics::State<SphericalPendulum> swinging() { return {0, {0.8, 0, -0.6}, {0.3, 0.7, 0.4}}; }
  static double energy(const mechanics::State<SphericalPendulum>& s) { return 0.5 * s.v.squaredNorm() + s.q.z(); }

 private:
  Trouble trouble_;
  double from_;
};

}  // namespace pseudorigid::testing
