#pragma once
/// A dense preconditioner for the linear systems of damping.h, for bodies with few unknowns. With the mass M, the
/// operator C of the damping, the derivative G of the constraint and the half step s, the preconditioner is
///
///   T = B⁻¹ − B⁻¹Gᵀ(G B⁻¹Gᵀ)⁻¹G B⁻¹ + β M⁻¹,   B = M + s C,   β = 1/(1 + s γ).
///
/// C and G are evaluated at an earlier configuration, and γ is a bound for the largest damping rate. The sum of the
/// first two terms of T is the inverse of B on ker G, and maps reactions Gᵀλ to 0. The last term makes T positive also
/// for the present G. Relative to M⁻¹, it is at most the smallest eigenvalue of B⁻¹.
///
/// For n damped entries, the matrix T needs n products with C, and the factorisations cost as much as about n²/100 more
/// products. An iteration with T costs as much as about c = 1.4 + n²/300000 products, because of one more projection
/// and the product with T. T is computed when it could have saved as many products as its computation needs. T is
/// computed again when a matrix for the present configuration could have saved this number of products. If a solve with
/// T costs more than recent solves without T, T is not used until the next matrix is computed. The reason may be a
/// rotation of the body. Damping does not act on rotations of the present configuration, but T regards the rotations of
/// the earlier configuration as undamped. The counts and the earlier configuration are in the memory of the method
/// (memory.h), so a resumed run has the same matrix.

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <iterator>
#include <utility>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/core/linearization.h"

namespace pseudorigid::mechanics {

/// A system with a function `n_damped_entries()`. It returns the number n of entries on which damping acts, summed over
/// all processes. If one process has all these entries, they are the first n of `local_values`. The number is 0 without
/// viscosity.
template <class S>
concept DenselyDamped = requires(const S s) {
  { s.n_damped_entries() } -> std::convertible_to<int>;
};

/// The preconditioner of systems without `n_damped_entries` is an empty object, which is never used.
template <class S>
class DampingPreconditioner {
 public:
  DampingPreconditioner(const S&, bool) {}
  bool prepare(const S&, double, const State<S>&, const typename S::Vector&, long&) { return false; }
  int most_products() const { return 0; }
  void apply(const typename S::Vector&, typename S::Vector&) {}
  void count(long) {}
  void give_up(typename S::Vector&) {}
  template <class Visit>
  void visit_memory(Visit&&) {}
};

template <DenselyDamped S>
class DampingPreconditioner<S> {
 public:
  using Vector = typename S::Vector;

  /// There is no preconditioner if `used` is false, if n is 0 or above 2000, or if damping is not linear in v.
  DampingPreconditioner(const S& system, bool used) {
    constexpr int largest = 2000;
    if constexpr (requires { system.damping_is_linear(); }) used = used && system.damping_is_linear();
    if (!used || system.n_damped_entries() > largest) return;
    n_ = system.n_damped_entries();
    cost_ = 1.4 + n_ * n_ / 300000.0;
    if (n_ > 0) q_ = system.make_vector();
  }

  /// Computes a new matrix T for the half step s at the state, if T could have saved enough products. This number is
  /// n + n²/100, times the factor of `give_up`. Returns true if there is a matrix for `apply`, and then stores a copy
  /// of `residual` for `give_up`. There is no matrix if this process does not have all n damped entries. Adds the
  /// number of products for a new matrix to `n_products`.
  bool prepare(const S& system, double s, const State<S>& state, const Vector& residual, long& n_products) {
    if (n_ == 0 || std::ssize(local_values(q_)) < n_) return false;
    if (excess_ > patience_ * products_for_matrix()) {
      excess_ = 0;
      saved_ = 0;
      least_ = 0;
      n_solves_ = 0;
      s_ = s;
      t_ = state.t;
      q_ = state.q;
      in_use_ = true;
      known_ = false;
      n_products += n_;
    }
    if (in_use_ && !known_) in_use_ = known_ = compute(system);  // the matrix is new, or the run was resumed
    if (in_use_) residual_ = residual;
    return in_use_;
  }

  /// Returns the largest number of products that a solve with the matrix may need. A solve with more products costs
  /// more than recent solves without the matrix.
  int most_products() const { return static_cast<int>(without_ / cost_); }

  /// Sets z = T f in the damped entries, and copies the other entries from f. `prepare` must have returned true.
  void apply(const Vector& f, Vector& z) {
    auto from = local_values(const_cast<Vector&>(f));
    auto to = local_values(z);
    std::copy(from.begin(), from.end(), to.begin());
    using Entries = Eigen::Map<Eigen::VectorXd>;
    Entries(to.data(), n_).noalias() = matrix_ * Entries(from.data(), n_);
  }

  /// Records the number of products of a solve, and estimates how many products a matrix for the present configuration
  /// would have saved. Without T, these are the products beyond the cost of two iterations with T. With T, they are the
  /// products beyond 1.5 l + 1, times the cost of an iteration. Here l is the larger number of products of the first
  /// two solves with T. Both solves count, because a step has two solves of different sizes (rattle_velocity.h).
  void count(long n_products) {
    const auto n = static_cast<double>(n_products);
    if (in_use_) saved_ += without_ - cost_ * n;
    if (!in_use_) {
      without_ = std::max(n, 0.9 * without_);
      excess_ += std::max(0.0, n - 2 * cost_);
    } else if (++n_solves_ <= 2) {
      least_ = std::max(least_, n);
    } else {
      excess_ += cost_ * std::max(0.0, n - (1.5 * least_ + 1));
    }
  }

  /// Ends the use of T until the next matrix is computed. Sets `residual` to the copy that `prepare` stored. If T saved
  /// fewer products than its computation needed, the number that the next matrix has to save is doubled, up to a factor
  /// of 1024. Otherwise the factor is 1.
  void give_up(Vector& residual) {
    constexpr double most_patience = 1024;
    patience_ = saved_ < products_for_matrix() ? std::min(2 * patience_, most_patience) : 1;
    in_use_ = false;
    residual = residual_;
  }

  template <class Visit>
  void visit_memory(Visit&& visit) {
    if (n_ == 0) return;
    visit(q_);
    visit(s_);
    visit(t_);
    visit(excess_);
    visit(least_);
    visit(without_);
    visit(saved_);
    visit(patience_);
    visit(n_solves_);
    visit(in_use_);
  }

 private:
  double products_for_matrix() const { return n_ + n_ * n_ / 100.0; }

  /// Sets matrix_ to T for the configuration q_ and the half step s_. Returns false if B, G B⁻¹Gᵀ or 1 + s γ is not
  /// positive, or if T is not finite.
  bool compute(const S& system) {
    Eigen::MatrixXd B(n_, n_), inverse_mass(n_, n_);
    double rate = 0;
    Vector unit = system.make_vector(), image = unit;
    const State<S> state{t_, q_, unit};
    const auto entries = [&] { return Eigen::Map<const Eigen::VectorXd>(local_values(image).data(), n_); };
    for (int i = 0; i < n_; ++i) {
      local_values(unit)[i] = 1;
      system.apply_mass(unit, image);
      B.col(i) = entries();
      const double mass = B(i, i);
      system.apply_inverse_mass(unit, image);
      inverse_mass.col(i) = entries();
      scale(0.0, image);
      system.add_damping(state, unit, Linearization::tangent, image);
      if (mass > 0) rate = std::max(rate, entries().template lpNorm<1>() / mass);
      B.col(i) -= s_ * entries();
      local_values(unit)[i] = 0;
    }
    for (int i = 0; i < n_; ++i) {
      if (inverse_mass(i, i) > 0) continue;  // components fixed by a symmetry plane get rows of the identity
      B.row(i).setZero();
      B.col(i).setZero();
      B(i, i) = 1;
    }
    if (!(1 + s_ * rate > 0)) return false;  // a long step backwards in time
    if (!invert_on_kernel(B, constraint_matrix(system, inverse_mass), matrix_)) return false;
    matrix_ += inverse_mass / (1 + s_ * rate);
    return matrix_.allFinite();
  }

  /// Returns the matrix G for the configuration q_, without rows if there is no constraint.
  Eigen::MatrixXd constraint_matrix(const S& system, const Eigen::MatrixXd& inverse_mass) const {
    Eigen::MatrixXd G(0, n_);
    if constexpr (!unconstrained<S>) {
      if (!is_constrained(system)) return G;
      Vector unit = system.make_vector();
      auto rate = system.make_multiplier();
      G.resize(static_cast<Eigen::Index>(local_values(rate).size()), n_);
      for (int i = 0; i < n_; ++i) {
        local_values(unit)[i] = inverse_mass(i, i) > 0 ? 1 : 0;
        system.constraint_rate(q_, unit, rate);
        G.col(i) = Eigen::Map<const Eigen::VectorXd>(local_values(rate).data(), G.rows());
        local_values(unit)[i] = 0;
      }
    }
    return G;
  }

  int n_ = 0;
  Vector q_, residual_;
  double cost_ = 0;       // cost of an iteration with the matrix, in products
  double s_ = 0, t_ = 0;  // half step and time of the matrix; q_ is its configuration
  double excess_ = 0;     // number of products that a newer matrix would have saved
  double least_ = 0;      // larger number of products of the first two solves with this matrix
  double without_ = 0;    // largest number of products of recent solves without a matrix
  double saved_ = 0;      // number of products that this matrix has saved
  double patience_ = 1;   // factor on the products that a new matrix has to save
  double n_solves_ = 0;   // number of solves with this matrix
  bool in_use_ = false;   // true if there is a matrix for q_ and s_ that saves products
  bool known_ = false;    // true if matrix_ is the matrix for q_ and s_; false after a resumption
  Eigen::MatrixXd matrix_;
};

}  // namespace pseudorigid::mechanics
