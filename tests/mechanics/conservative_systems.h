#pragma once
/// Small conservative systems that know their energies and symmetries.

#include <Eigen/Dense>

#include "mechanics/core/conservative_system.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/toy_systems.h"

namespace pseudorigid::testing {

/// The spherical pendulum, with its turns about the vertical: ξ = e₃ × q.
class ConservativePendulum : public SphericalPendulum {
 public:
  using SphericalPendulum::SphericalPendulum;
  double potential_energy(const Vector& q) const { return q.z(); }
  double kinetic_energy(const Vector& v) const { return 0.5 * v.squaredNorm(); }
  void apply_mass(const Vector& v, Vector& f) const { f = v; }
  void add_reaction_rate(const Vector&, const Vector& v, double lambda, Vector& f) const { f += lambda * v; }
  int n_symmetries() const { return 1; }
  void symmetry(int, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const {
    dq = Eigen::Vector3d::UnitZ().cross(q);
    dv = Eigen::Vector3d::UnitZ().cross(v);
  }
};

/// Unit masses q_k on a chain of rods of length 1 that hangs from the origin in the gravity (0, 0, −1):
/// g_k = ½(|q_k − q_{k−1}|² − 1). The number of constraints is known at run time only.
class ConservativeChain {
 public:
  using Vector = Eigen::Matrix3Xd;
  using Multiplier = Eigen::VectorXd;
  struct Workspace {};
  static constexpr int n_constraints = mechanics::dynamic_constraints;

  explicit ConservativeChain(int n) : n_(n) {}

  mechanics::Status force(double, const Vector&, const Vector&, Workspace&, Vector& f) const {
    f.setZero();
    f.row(2).setConstant(-1);
    return {};
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { a = f; }
  void apply_mass(const Vector& v, Vector& f) const { f = v; }
  mechanics::Status constraint(const Vector& q, Multiplier& g) const {
    constraint_rate(q, q, g);
    g = 0.5 * (g.array() - 1).matrix();
    return {};
  }
  void constraint_rate(const Vector& q, const Vector& v, Multiplier& r) const {
    for (int k = 0; k < n_; ++k) r(k) = rod(q, k).dot(rod(v, k));
  }
  void constraint_curvature(const Vector&, const Vector& v, Multiplier& r) const { constraint_rate(v, v, r); }
  void add_reaction(const Vector& q, const Multiplier& lambda, Vector& f) const {
    for (int k = 0; k < n_; ++k) {
      f.col(k) += lambda(k) * rod(q, k);
      if (k > 0) f.col(k - 1) -= lambda(k) * rod(q, k);
    }
  }
  void add_reaction_rate(const Vector&, const Vector& v, const Multiplier& lambda, Vector& f) const {
    add_reaction(v, lambda, f);
  }
  mechanics::SolveReport solve_gram(const Vector& q1, const Vector& q0, const Multiplier& r, Workspace&,
                                    Multiplier& lambda) const {
    Eigen::MatrixXd S(n_, n_);
    for (int k = 0; k < n_; ++k) {
      Vector reaction = make_vector();
      add_reaction(q0, Multiplier::Unit(n_, k), reaction);
      Multiplier column(n_);
      constraint_rate(q1, reaction, column);
      S.col(k) = column;
    }
    lambda = mechanics::solve(S, r);
    return {};
  }
  double constraint_tolerance() const { return 4e-16; }
  Vector make_vector() const { return Vector::Zero(3, n_); }
  Multiplier make_multiplier() const { return Multiplier::Zero(n_); }
  Workspace make_workspace() const { return {}; }

  double potential_energy(const Vector& q) const { return q.row(2).sum(); }
  double kinetic_energy(const Vector& v) const { return 0.5 * v.squaredNorm(); }
  int n_symmetries() const { return 1; }
  void symmetry(int, const Vector& q, const Vector& v, Vector& dq, Vector& dv) const {
    dq = v;  // of the right size
    for (int k = 0; k < n_; ++k) {
      dq.col(k) = Eigen::Vector3d::UnitZ().cross(q.col(k));
      dv.col(k) = Eigen::Vector3d::UnitZ().cross(v.col(k));
    }
  }

  /// Rods that lean in different directions, and velocities across them.
  mechanics::State<ConservativeChain> leaning() const {
    mechanics::State<ConservativeChain> s{0, make_vector(), make_vector()};
    Eigen::Vector3d end = Eigen::Vector3d::Zero(), velocity = end;
    for (int k = 0; k < n_; ++k) {
      const Eigen::Vector3d rod = Eigen::Vector3d(0.6 - 0.5 * k, 0.3 * k, -0.8).normalized();
      s.q.col(k) = end += rod;
      s.v.col(k) = velocity += Eigen::Vector3d(0.2, 0.4, 0.1 * k).cross(rod);
    }
    return s;
  }

 private:
  Eigen::Vector3d rod(const Vector& q, int k) const {
    return k == 0 ? Eigen::Vector3d(q.col(0)) : Eigen::Vector3d(q.col(k) - q.col(k - 1));
  }
  int n_;
};

static_assert(mechanics::ConservativeSystem<ConservativePendulum> && mechanics::ConservativeSystem<ConservativeChain>);

}  // namespace pseudorigid::testing
