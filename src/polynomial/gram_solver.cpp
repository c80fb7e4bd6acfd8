#include "polynomial/gram_solver.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "polynomial/constraint.h"
#include "polynomial/dense_kernels.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {
namespace {

/// (−1)^|a & b|
double sign(unsigned int a, unsigned int b) { return std::popcount(a & b) % 2 == 0 ? 1.0 : -1.0; }

/// ψ_b at all points of the computed part, times `factor` there: one row a function.
std::vector<double> pressure_rows(const PolynomialSpace& space, const std::vector<double>& factor) {
  const PointTables& tables = space.pressures();
  const int stride = tables.stride(), n_points = tables.n_points();
  std::vector<double> rows(static_cast<std::size_t>(space.n_pressures()) * n_points);
  for (const Block& block : space.pressure_blocks()) {
    const std::vector<double>& table = tables.rows(block.parity);
    for (int b = 0; b < block.n(); ++b)
      for (int image = 0; image < space.n_images(); ++image)
        for (int p = 0; p < stride; ++p) {
          const int point = image * stride + p;
          rows[static_cast<std::size_t>(block.offset + b) * n_points + point] =
              sign(image, block.slot) * table[static_cast<std::size_t>(b) * stride + p] * factor[point];
        }
  }
  return rows;
}

/// F⁻ᵀ:∇(φ_a e_i) at all points, for the functions of a block: one row a function.
void reaction_rows(const PolynomialSpace& space, const Block& block, const double* A, double* rows) {
  const PointTables& tables = space.gradients();
  const std::vector<double>& table = tables.rows(block.parity);
  const int stride = tables.stride(), n_points = tables.n_points();
  for (int a = 0; a < block.n(); ++a) {
    const double* gradient = table.data() + static_cast<std::size_t>(a) * 3 * stride;
    double* row = rows + static_cast<std::size_t>(a) * n_points;
    for (int image = 0; image < space.n_images(); ++image) {
      double signs[3];
      for (int k = 0; k < 3; ++k) signs[k] = sign(image, block.slot ^ tables.shift(k));
      const double* A_i = A + static_cast<std::size_t>(3 * block.component) * n_points + image * stride;
      for (int p = 0; p < stride; ++p)
        row[image * stride + p] = signs[0] * A_i[p] * gradient[p] +
                                  signs[1] * A_i[n_points + p] * gradient[stride + p] +
                                  signs[2] * A_i[2 * n_points + p] * gradient[2 * stride + p];
    }
  }
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Calls visitor(block, columns) with the columns of G of each block, filled up with zeros to whole vectors.
template <class Visitor>
void for_each_part(const PolynomialSpace& space, const std::vector<double>& weighted_pressures,
                   const Eigen::VectorXd& q, Visitor&& visitor) {
  const int n_points = space.n_points(), n_pressures = space.n_pressures();
  ScratchArray F(space.gradients().size(3)), A(space.gradients().size(3));
  space.gradients().evaluate(space.blocks(), 3, q.data(), F);
  inverse_transposed(n_points, F, A);
  for (const Block& block : space.blocks()) {
    const int width = (block.n() + point_block - 1) / point_block * point_block;
    ScratchArray rows(static_cast<std::size_t>(width) * n_points);
    std::fill_n(static_cast<double*>(rows), static_cast<std::size_t>(width) * n_points, 0.0);
    reaction_rows(space, block, A, rows);
    RowMajor columns = RowMajor::Zero(n_pressures, width);
    multiply_transposed(weighted_pressures.data(), n_pressures, rows, width, n_points, columns.data());
    visitor(block, columns);
  }
}

}  // namespace

Eigen::MatrixXd constraint_matrix(const PolynomialSpace& space, const Eigen::VectorXd& q) {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(space.n_pressures(), q.size());
  for_each_part(space, pressure_rows(space, space.weights()), q, [&](const Block& block, const RowMajor& columns) {
    G.middleCols(block.offset, block.n()) = columns.leftCols(block.n());
  });
  return G;
}

GramSolver::GramSolver(const PolynomialSpace& space)
    : space_(&space),
      weighted_pressures_(pressure_rows(space, space.weights())),
      position_(Eigen::VectorXd::Zero(space.n_unknowns())) {}

bool GramSolver::factor(const Eigen::VectorXd& q) {
  const int n = space_->n_pressures();
  RowMajor S = RowMajor::Zero(n, n);
  for_each_part(*space_, weighted_pressures_, q, [&](const Block&, const RowMajor& columns) {
    multiply_transposed(columns.data(), n, columns.data(), n, static_cast<int>(columns.cols()), S.data());
  });
  factor_.compute(S);
  factored_at_ = q;
  ++n_factorizations_;
  return factor_.info() == Eigen::Success;
}

bool GramSolver::ensure_factor(const Eigen::VectorXd& q0) {
  if (!is_known_ || spent_ > factorization_cost()) {
    position_ = q0.head(space_->n_unknowns());
    is_known_ = true;
    spent_ = 0;
  }
  if (factored_at_.size() == position_.size() && factored_at_ == position_) return factor_.info() == Eigen::Success;
  return factor(position_);
}

/// Multiplications and additions of a product with S and of a solution with its factor.
double GramSolver::iteration_cost() const {
  const double n = space_->n_pressures(), stride = space_->gradients().stride();
  double functions = 0;
  for (const Block& block : space_->blocks()) functions += block.n();
  return 2 * stride * (3 * functions + n) + n * n + 60.0 * space_->n_points();
}
/// The same of a factorisation, whose kernels run about three times as fast as sums over tables.
double GramSolver::factorization_cost() const {
  const double n = space_->n_pressures(), n_unknowns = space_->n_unknowns();
  return n_unknowns * space_->n_points() * (n + 9) / 3 + n * n * (n_unknowns + n / 3) / 3;
}

mechanics::SolveReport GramSolver::solve(const Eigen::VectorXd& q1, const Eigen::VectorXd& q0, const Eigen::VectorXd& r,
                                         double enough, Eigen::VectorXd& lambda) {
  constexpr double part = 1e-4, slow = 0.5;
  constexpr int max_iterations = 60;
  const double sought = std::max(part * r.lpNorm<Eigen::Infinity>(), enough);
  const auto failure = [] {
    return mechanics::Status::failure("the constraints on the volume have become dependent: use a smaller step");
  };
  if (!ensure_factor(q0)) return {failure(), 0};
  const ReactionsBetween S(*space_, q1, q0);
  lambda.setZero();
  Eigen::VectorXd residual = r, product(r.size());
  double before = residual.lpNorm<Eigen::Infinity>();
  for (int i = 1; i <= max_iterations; ++i) {
    lambda += factor_.solve(residual);
    S.multiply(lambda, product);
    residual = r - product;
    const double norm = residual.lpNorm<Eigen::Infinity>();
    if (!(norm <= sought) && i > 1) spent_ += iteration_cost();
    if (norm <= sought) return {{}, i};
    if (!(norm <= slow * before)) {
      if (factored_at_ == q0.head(space_->n_unknowns())) return {failure(), i};
      spent_ = 2 * factorization_cost();
      if (!ensure_factor(q0)) return {failure(), i};
      lambda.setZero();
      residual = r;
    }
    before = residual.lpNorm<Eigen::Infinity>();
  }
  return {failure(), max_iterations};
}

}  // namespace pseudorigid::polynomial
