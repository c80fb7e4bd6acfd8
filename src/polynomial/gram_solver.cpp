#include "polynomial/gram_solver.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "polynomial/constraint.h"
#include "polynomial/dense_kernels.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {
namespace {

/// Returns −1 if a and b have an odd number of common bits, otherwise 1.
double sign(unsigned int a, unsigned int b) { return std::popcount(a & b) % 2 == 0 ? 1.0 : -1.0; }

/// The pressure functions ψ_b at all points of the computed sector, one row for each function. The values at a point
/// are multiplied by the entry of `factor` for this point.
std::vector<double> pressure_rows(const PolynomialSpace& space, const std::vector<double>& factor) {
  const PointTables& tables = space.pressures();
  const int stride = tables.stride(), n_points = tables.n_points();
  std::vector<double> rows(static_cast<std::size_t>(space.n_pressures()) * n_points);
  for (const Block& block : space.pressure_blocks())
    for (int b = 0; b < block.n(); ++b) {
      const std::vector<double> values = tables.row(block, b, 0);
      for (int image = 0; image < space.n_images(); ++image)
        for (int p = 0; p < stride; ++p) {
          const int point = image * stride + p;
          rows[static_cast<std::size_t>(block.offset + b) * n_points + point] =
              sign(image, block.slot) * values[p] * factor[point];
        }
    }
  return rows;
}

/// The derivatives ∂/∂X_k of the functions of a block: [k][point of the octant][function].
std::vector<double> gradients_by_point(const PolynomialSpace& space, const Block& block) {
  const PointTables& tables = space.gradients();
  const int stride = tables.stride(), width = filled_up(block.n());
  std::vector<double> by_point(static_cast<std::size_t>(3) * stride * width, 0.0);
  for (int a = 0; a < block.n(); ++a)
    for (int k = 0; k < 3; ++k) {
      const std::vector<double> values = tables.row(block, a, k);
      for (int p = 0; p < stride; ++p) by_point[(static_cast<std::size_t>(k) * stride + p) * width + a] = values[p];
    }
  return by_point;
}

/// R ← F⁻ᵀ:∇(φ_a e_i) at all points, with the entries [point][function]. The φ_a are the functions and i is the
/// component of the block. `gradients` is the result of gradients_by_point for the block, and A has the entries of F⁻ᵀ.
void reactions_at_points(const PolynomialSpace& space, const Block& block, const std::vector<double>& gradients,
                         const double* A, double* R) {
  const int stride = space.gradients().stride(), n_points = space.n_points(), width = filled_up(block.n());
  ScratchArray signed_A(static_cast<std::size_t>(3) * stride);
  for (int image = 0; image < space.n_images(); ++image) {
    for (int k = 0; k < 3; ++k) {
      const double s = sign(image, block.slot ^ space.gradients().shift(k));
      const double* A_ik = A + static_cast<std::size_t>(3 * block.component + k) * n_points + image * stride;
      for (int p = 0; p < stride; ++p) signed_A[k * stride + p] = s * A_ik[p];
    }
    const double* rows = signed_A;
    dense().combine_at_points(rows, rows + stride, rows + 2 * stride, gradients.data(), stride, width,
                              R + static_cast<std::size_t>(image) * stride * width);
  }
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

GramMatrix::GramMatrix(const PolynomialSpace& space)
    : space_(&space), weighted_pressures_(pressure_rows(space, space.weights())) {
  for (const Block& block : space.blocks())
    if (gradients_[block.parity].empty()) gradients_[block.parity] = gradients_by_point(space, block);
}

/// Calls visitor(block, columns) for each block, with the columns of the constraint matrix G that belong to the block.
/// The columns are padded with zeros to whole SIMD vectors.
template <class Visitor>
void GramMatrix::for_each_part(const Eigen::VectorXd& q, Visitor&& visitor) const {
  const int n_points = space_->n_points(), n_pressures = space_->n_pressures();
  ScratchArray F(space_->gradients().size(3)), A(space_->gradients().size(3));
  space_->gradients().evaluate(space_->blocks(), 3, q.data(), F);
  dense().inverse_transposed(n_points, F, A);
  for (const Block& block : space_->blocks()) {
    const int width = filled_up(block.n());
    ScratchArray R(static_cast<std::size_t>(n_points) * width);
    reactions_at_points(*space_, block, gradients_[block.parity], A, R);
    ScratchArray numbers(static_cast<std::size_t>(n_pressures) * width);
    Eigen::Map<RowMajor> columns(numbers, n_pressures, width);
    dense().multiply(weighted_pressures_.data(), n_points, n_pressures, R, n_points, width, columns.data(), false);
    visitor(block, columns);
  }
}

Eigen::MatrixXd GramMatrix::constraint_matrix(const Eigen::VectorXd& q) const {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(space_->n_pressures(), q.size());
  for_each_part(q, [&](const Block& block, const auto& columns) {
    G.middleCols(block.offset, block.n()) = columns.leftCols(block.n());
  });
  return G;
}

void GramMatrix::at(const Eigen::VectorXd& q, Eigen::MatrixXd& S) const {
  const int n = space_->n_pressures();
  S.setZero(n, n);
  for_each_part(q, [&](const Block&, const auto& columns) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) S(i, j) += columns.row(i).dot(columns.row(j));
  });
}

Eigen::MatrixXd constraint_matrix(const PolynomialSpace& space, const Eigen::VectorXd& q) {
  return GramMatrix(space).constraint_matrix(q);
}

GramSolver::GramSolver(const PolynomialSpace& space)
    : space_(&space), matrix_(space), position_(Eigen::VectorXd::Zero(space.n_unknowns())) {}

bool GramSolver::factor(const Eigen::VectorXd& q) {
  matrix_.at(q, S_);
  S_.diagonal().array() += shift_;
  factored_at_ = q;
  factored_for_ = shift_;
  ++n_factorizations_;
  return factor_.compute(S_);
}

bool GramSolver::ensure_factor(const Eigen::VectorXd& q0, double shift) {
  if (!is_known_ || spent_ > factorization_cost()) {
    position_ = q0.head(space_->n_unknowns());
    shift_ = shift;
    is_known_ = true;
    spent_ = 0;
  }
  if (factored_at_.size() == position_.size() && factored_at_ == position_ && factored_for_ == shift_)
    return factor_.is_valid();
  return factor(position_);
}

/// Number of operations of one iteration. An iteration has a product with S and a solution with the factor. Operations
/// at a quadrature point are estimated as 60, in addition to the sums with tables.
double GramSolver::iteration_cost() const {
  const double n = space_->n_pressures();
  double of_tables = 0;
  for (const Block& block : space_->blocks()) of_tables += space_->gradients().n_multiplications(block);
  for (const Block& block : space_->pressure_blocks()) of_tables += space_->pressures().n_multiplications(block);
  return 2 * of_tables + n * n + 60.0 * space_->n_points();
}
/// Number of operations to compute the matrix S_f of the preconditioner and its Cholesky factor.
double GramSolver::factorization_cost() const {
  const double n = space_->n_pressures(), n_unknowns = space_->n_unknowns();
  return n_unknowns * space_->n_points() * (n + 9) + n * n * (n_unknowns + n / 3);
}

mechanics::SolveReport GramSolver::solve(const Eigen::VectorXd& q1, const Eigen::VectorXd& q0, const Eigen::VectorXd& r,
                                         double enough, double shift, Eigen::VectorXd& lambda) {
  ReactionsBetween S(*space_, q1, q0);
  int n_iterations = 0;
  const auto dependent = [&]() -> mechanics::SolveReport {
    return {mechanics::Status::failure("the constraints on the volume have become dependent: use a smaller step"),
            n_iterations};
  };
  if (!ensure_factor(q0, shift)) return dependent();
  if (iterate(S, r, enough, shift, lambda, n_iterations)) return {{}, n_iterations};
  // The iteration did not converge. If the factor was computed at this q₀, S is almost singular. Otherwise the factor
  // may be too old and is computed again.
  if (factored_at_ == q0.head(space_->n_unknowns()) && factored_for_ == shift) return dependent();
  spent_ = 2 * factorization_cost();
  if (!ensure_factor(q0, shift) || !iterate(S, r, enough, shift, lambda, n_iterations)) return dependent();
  return {{}, n_iterations};
}

bool GramSolver::iterate(ReactionsBetween& S, const Eigen::VectorXd& r, double enough, double shift,
                         Eigen::VectorXd& lambda, int& n_iterations) {
  constexpr double part = 1e-4;
  const int max_iterations = shift == 0 ? 12 : 60;
  residual_ = r;
  const double norm = r.norm();
  const auto result = iteration_.solve(
      [&](const Eigen::VectorXd& z, Eigen::VectorXd& y) {
        S.multiply(z, y);
        if (shift != 0) y += shift * z;
      },
      [&](const Eigen::VectorXd& residual, Eigen::VectorXd& z) {
        z = residual;
        factor_.solve_in_place(z);
      },
      norm, std::max(part * norm, enough), max_iterations, residual_, lambda);
  n_iterations += result.n_iterations;
  spent_ += std::max(0, result.n_iterations - 1) * iteration_cost();
  return result.converged;
}

}  // namespace pseudorigid::polynomial
