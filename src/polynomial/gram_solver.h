#pragma once
/// Solves the Gram systems of the constraint ∫ψ ln J dX = 0 (constraint.h),
///
///   S(q₁, q₀) λ = r,   S = G(q₁) G(q₀)ᵀ,   G_b,ia(q) = ∫ψ_b F⁻ᵀ:∇(φ_a e_i) dX     (the mass is the identity)
///
/// The pressures have the basis ψ_b, the positions have the basis φ_a, and the e_i are the unit vectors. F is the
/// deformation gradient, and J = det F. S is small and dense. The systems are solved by conjugate residuals
/// (mechanics/core/conjugate_residuals.h). The preconditioner is the Cholesky factor of S_f = G(q_f)G(q_f)ᵀ at an
/// earlier position q_f. Products with S are computed without a matrix.
///
/// The first call computes and factors S_f at its position q₀, or at a position that was restored from a checkpoint.
/// The solver computes a new factor at the present q₀ in two cases. In the first case, an iteration does not converge.
/// In the second case, the iterations that a new factor could have saved have cost more than a factorisation. Therefore
/// the cost is at most about twice the optimum.

#include <array>
#include <vector>

#include "mechanics/core/conjugate_residuals.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/core/status.h"
#include "polynomial/constraint.h"
#include "polynomial/polynomial_space.h"

namespace pseudorigid::polynomial {

/// Computes G(q) and S(q, q) as matrices.
class GramMatrix {
 public:
  explicit GramMatrix(const PolynomialSpace& space);

  /// G(q), with a row for each pressure function and a column for each entry of q.
  Eigen::MatrixXd constraint_matrix(const Eigen::VectorXd& q) const;
  /// Sets the lower triangle of S to the lower triangle of S(q, q), and the other entries to 0.
  void at(const Eigen::VectorXd& q, Eigen::MatrixXd& S) const;

 private:
  template <class Visitor>
  void for_each_part(const Eigen::VectorXd& q, Visitor&& visitor) const;

  const PolynomialSpace* space_;
  std::vector<double> weighted_pressures_;        ///< w ψ_b at the points with the weights w: [function][point]
  std::array<std::vector<double>, 8> gradients_;  ///< ∂φ_a/∂X_k for each parity: [k][point of the octant][function]
};

class GramSolver {
 public:
  explicit GramSolver(const PolynomialSpace& space);

  /// Computes λ with |r − (S + σ)λ| ≤ max(10⁻⁴ |r|, `enough`) in the Euclidean norm. σ = `shift` is 0 for a rigid
  /// constraint. The result has the number of iterations.
  /// Fails if the matrix cannot be factored, or if the iteration does not converge with a factor at q₀. In both cases S
  /// is almost singular, or S or r is not finite.
  mechanics::SolveReport solve(const Eigen::VectorXd& q1, const Eigen::VectorXd& q0, const Eigen::VectorXd& r,
                               double enough, double shift, Eigen::VectorXd& lambda);

  long n_factorizations() const { return n_factorizations_; }

  /// Visits the members on which later solves depend, for checkpoints: the position and the shift of the factor, and
  /// the cost of the iterations since the factorisation.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(position_);
    visit(shift_);
    visit(is_known_);
    visit(spent_);
  }

 private:
  /// Computes the factor of S_f + σ at q, for σ = shift_. Returns false if the matrix is not positive definite.
  bool factor(const Eigen::VectorXd& q);
  /// Ensures that factor_ is the factor at position_. Sets position_ to q₀ and shift_ to `shift` before, if position_
  /// is not set, or if the iterations since the factorisation have cost more than a factorisation. Returns false if the
  /// matrix is not positive definite.
  bool ensure_factor(const Eigen::VectorXd& q0, double shift);
  /// Solves (S + σ) λ = r with the present factor, up to the residual of `solve`. Adds the iterations to n_iterations.
  /// Returns false if the iteration does not converge.
  bool iterate(ReactionsBetween& S, const Eigen::VectorXd& r, double enough, double shift, Eigen::VectorXd& lambda,
               int& n_iterations);
  /// Costs as numbers of operations.
  double iteration_cost() const;
  double factorization_cost() const;

  const PolynomialSpace* space_;
  GramMatrix matrix_;
  Eigen::VectorXd position_;  ///< position at which S_f is factored, now or in the next solve
  double shift_ = 0;          ///< σ of this factor
  bool is_known_ = false;     ///< true if position_ and shift_ are set
  double spent_ = 0;          ///< operations of the iterations since the factorisation, without the first of each solve
  Eigen::VectorXd factored_at_;  ///< position at which factor_ was computed; empty if there is no factor
  double factored_for_ = 0;      ///< σ for which factor_ was computed
  Eigen::MatrixXd S_;
  mechanics::CholeskyFactor factor_;
  mechanics::ConjugateResiduals<Eigen::VectorXd> iteration_;
  Eigen::VectorXd residual_;
  long n_factorizations_ = 0;
};

/// G(q), with a row for each pressure function and a column for each entry of q.
Eigen::MatrixXd constraint_matrix(const PolynomialSpace& space, const Eigen::VectorXd& q);

}  // namespace pseudorigid::polynomial
