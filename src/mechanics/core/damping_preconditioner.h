#pragma once
/// A dense preconditioner for the linear systems of damping.h, for bodies with few unknowns. With the mass M, the
/// operator C of the damping, the derivative G of the constraint and half a step s, the preconditioner is
///
///   T = B⁻¹ − B⁻¹Gᵀ(G B⁻¹Gᵀ)⁻¹G B⁻¹ + β M⁻¹,   B = M + s C,   β = 1/(1 + s γ).
///
/// C and G are those of an earlier configuration, which the body has left since. γ is a bound for the largest damping
/// rate. The first two terms are the inverse of B on ker G. They have no inverse if the configuration has changed. The
/// last term makes T positive, and adds at most the smallest eigenvalue of B⁻¹.
///
/// The matrix is stored in single precision, because an error of T does not change the solution. A system with n
/// entries needs n products with C for it, and the factors cost about n²/100 more. The matrix is computed when the
/// products that it could have saved are as many, and again when the configuration has changed so much that the same
/// holds again. The total cost is thus at most about twice the least cost. The counts and the configuration are in the
/// memory of the method, so that a resumed run has the same matrix.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <iterator>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/linearization.h"

namespace pseudorigid::mechanics {

/// A system with `n_damped_entries()`: the number n of entries that damping acts on, on all processes. If one process
/// has all of them, they are the first n of `local_values`. The number is 0 if damping acts only at contacts.
template <class S>
concept DenselyDamped = requires(const S s) {
  { s.n_damped_entries() } -> std::convertible_to<int>;
};

/// An empty object for systems without the matrix.
template <class S>
class DampingPreconditioner {
 public:
  DampingPreconditioner(const S&, bool) {}
  bool prepare(const S&, double, const State<S>&) { return false; }
  void apply(const typename S::Vector&, typename S::Vector&) {}
  void count(long) {}
  template <class Visit>
  void visit_memory(Visit&&) {}
};

template <DenselyDamped S>
class DampingPreconditioner<S> {
 public:
  using Vector = typename S::Vector;

  /// Without `used`, or if n is above 2000, the matrix is never computed.
  DampingPreconditioner(const S& system, bool used) {
    constexpr int largest = 2000;
    if (!used || system.n_damped_entries() > largest) return;
    n_ = system.n_damped_entries();
    if (n_ > 0) q_ = system.make_vector();
  }

  /// Computes or renews the matrix if that pays for half steps s at the state. Returns true if `apply` can be called.
  bool prepare(const S& system, double s, const State<S>& state) {
    if (n_ == 0 || std::ssize(local_values(q_)) < n_) return false;
    const bool renewed = excess_ > n_ + n_ * n_ / 100;
    if (renewed) {
      excess_ = 0;
      least_ = 0;
      s_ = s;
      q_ = state.q;
    }
    if (renewed || s_ != s_of_matrix_) {  // s_ has changed alone if the memory was restored
      s_of_matrix_ = s_;
      known_ = compute(system);
    }
    return known_;
  }

  /// z = T f.
  void apply(const Vector& f, Vector& z) {
    auto from = local_values(const_cast<Vector&>(f));
    auto to = local_values(z);
    std::copy(from.begin(), from.end(), to.begin());
    for (int i = 0; i < n_; ++i) in_[i] = static_cast<float>(from[i]);
    out_.noalias() = matrix_ * in_;
    for (int i = 0; i < n_; ++i) to[i] = out_[i];
  }

  /// Takes note of the number of products of a solve. The matrix is too old if this number is larger than at first.
  void count(long n_products) {
    if (known_ && least_ == 0) least_ = n_products;
    excess_ += static_cast<double>(n_products) - least_;
  }

  template <class Visit>
  void visit_memory(Visit&& visit) {
    if (n_ == 0) return;
    visit(q_);
    visit(s_);
    visit(excess_);
    visit(least_);
  }

 private:
  /// Sets the matrix for the configuration q_ and half a step s_. Returns false if B or G B⁻¹Gᵀ is not positive.
  bool compute(const S& system) {
    Eigen::MatrixXd B(n_, n_), inverse_mass(n_, n_);
    double rate = 0;
    Vector unit = system.make_vector(), image = unit;
    const State<S> state{0, q_, unit};
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
      if (inverse_mass(i, i) > 0) continue;  // a component that a symmetry plane fixes has the row and column of 1
      B.row(i).setZero();
      B.col(i).setZero();
      B(i, i) = 1;
    }
    const Eigen::LLT<Eigen::MatrixXd> factor(B);
    if (factor.info() != Eigen::Success) return false;
    Eigen::MatrixXd T = factor.solve(Eigen::MatrixXd::Identity(n_, n_));
    if (!subtract_reactions(system, inverse_mass, T)) return false;
    constexpr double least_beta = 1e-6;  // above the round-off of single precision
    T += std::max(1 / (1 + s_ * rate), least_beta) * inverse_mass;
    matrix_ = T.template cast<float>();
    in_.resize(n_);
    out_.resize(n_);
    return matrix_.allFinite();
  }

  /// T ← T − T Gᵀ(G T Gᵀ)⁻¹G T for the configuration q_. Returns false if G T Gᵀ is not positive.
  bool subtract_reactions(const S& system, const Eigen::MatrixXd& inverse_mass, Eigen::MatrixXd& T) const {
    if constexpr (!unconstrained<S>) {
      Vector unit = system.make_vector();
      auto rate = system.make_multiplier();
      Eigen::MatrixXd G(static_cast<Eigen::Index>(local_values(rate).size()), n_);
      for (int i = 0; i < n_; ++i) {
        local_values(unit)[i] = inverse_mass(i, i) > 0 ? 1 : 0;
        system.constraint_rate(q_, unit, rate);
        G.col(i) = Eigen::Map<const Eigen::VectorXd>(local_values(rate).data(), G.rows());
        local_values(unit)[i] = 0;
      }
      const Eigen::MatrixXd reactions = T * G.transpose();
      const Eigen::LLT<Eigen::MatrixXd> gram(G * reactions);
      if (gram.info() != Eigen::Success) return false;
      T -= reactions * gram.solve(reactions.transpose());
    }
    return true;
  }

  int n_ = 0;
  Vector q_;
  double s_ = 0;       // 0 before the first matrix
  double excess_ = 0;  // products that a newer matrix would have saved
  double least_ = 0;   // products of the first solve with this matrix
  double s_of_matrix_ = 0;
  bool known_ = false;  // true if there is a matrix for s_of_matrix_
  Eigen::MatrixXf matrix_;
  Eigen::VectorXf in_, out_;
};

}  // namespace pseudorigid::mechanics
