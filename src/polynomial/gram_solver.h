#pragma once
/// Solution of the Gram systems of the constraint ∫ψ ln J dX = 0,
///
///   S(q₁, q₀) λ = r,   S = G(q₁) G(q₀)ᵀ,   G_b,ia(q) = ∫ψ_b F⁻ᵀ:∇(φ_a e_i) dX     (the mass is the identity)
///
/// S is small and dense. The Cholesky factor of S_f = G(q_f)G(q_f)ᵀ at an earlier position q_f is kept and is the
/// preconditioner of conjugate residuals (mechanics/core/conjugate_residuals.h) for S, whose products need no matrix.
///
/// S is factored anew if the iteration is slow, and as soon as the iterations that a new factor would have spared
/// have cost as much as it does, so the cost is at most twice the least.

#include <Eigen/Cholesky>
#include <array>
#include <vector>

#include "mechanics/core/conjugate_residuals.h"
#include "mechanics/core/status.h"
#include "polynomial/constraint.h"
#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

/// G(q) and S(q, q) as matrices.
class GramMatrix {
 public:
  explicit GramMatrix(const PolynomialSpace& space);

  /// G(q): one row a pressure function, one column an entry of q.
  Eigen::MatrixXd constraint_matrix(const Eigen::VectorXd& q) const;
  /// The lower triangle of S(q, q).
  void at(const Eigen::VectorXd& q, Eigen::MatrixXd& S) const;

 private:
  template <class Visitor>
  void for_each_part(const Eigen::VectorXd& q, Visitor&& visitor) const;

  const PolynomialSpace* space_;
  std::vector<double> weighted_pressures_;        ///< [function][point]: w ψ
  std::array<std::vector<double>, 8> gradients_;  ///< gradients for each parity, [k][point of the octant][function]
};

class GramSolver {
 public:
  explicit GramSolver(const PolynomialSpace& space);

  /// λ with |r − Sλ| at most 10⁻⁴ |r| or `enough`, whichever is larger, in the Euclidean norm.
  mechanics::SolveReport solve(const Eigen::VectorXd& q1, const Eigen::VectorXd& q0, const Eigen::VectorXd& r,
                               double enough, Eigen::VectorXd& lambda);

  long n_factorizations() const { return n_factorizations_; }

  /// The position of the factor, and the cost of iterations since then.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(position_);
    visit(is_known_);
    visit(spent_);
  }

 private:
  bool factor(const Eigen::VectorXd& q);
  bool ensure_factor(const Eigen::VectorXd& q0);
  /// Returns false if the iteration does not converge.
  bool iterate(ReactionsBetween& S, const Eigen::VectorXd& r, double enough, Eigen::VectorXd& lambda,
               int& n_iterations);
  double iteration_cost() const;
  double factorization_cost() const;

  const PolynomialSpace* space_;
  GramMatrix matrix_;
  Eigen::VectorXd position_;     ///< configuration at which the factor was made, or will be made
  bool is_known_ = false;        ///< position_ is one
  double spent_ = 0;             ///< on iterations since
  Eigen::VectorXd factored_at_;  ///< the configuration of factor_; empty: there is no factor
  Eigen::MatrixXd S_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  mechanics::ConjugateResiduals<Eigen::VectorXd> iteration_;
  Eigen::VectorXd residual_;
  long n_factorizations_ = 0;
};

/// G(q): one row a pressure function, one column an unknown.
Eigen::MatrixXd constraint_matrix(const PolynomialSpace& space, const Eigen::VectorXd& q);

}  // namespace pseudorigid::polynomial
