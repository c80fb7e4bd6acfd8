#include "analysis/line_model.h"

#include <algorithm>
#include <cmath>

namespace pseudorigid::analysis {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

/// A matrix with the columns P_0 … P_degree at n equidistant points of [−1, 1].
MatrixXd legendre(Index n, int degree) {
  const VectorXd s = VectorXd::LinSpaced(n, -1, 1);
  MatrixXd P(n, degree + 1);
  P.col(0).setOnes();
  if (degree > 0) P.col(1) = s;
  for (int k = 2; k <= degree; ++k)
    P.col(k) = ((2 * k - 1) * s.cwiseProduct(P.col(k - 1)) - (k - 1) * P.col(k - 2)) / k;
  return P;
}

/// Computes the columns cos Ωs and sin Ωs, with Ω = `omega`, at equidistant points s of [−1, 1]. A rotation through a
/// fixed angle gives each value from the previous one, because this is much faster than sines. Every 64 samples, the
/// values are computed directly, so that the accumulated error remains at round-off.
void fill_wave(double omega, Eigen::Ref<VectorXd> cosine, Eigen::Ref<VectorXd> sine) {
  constexpr Index restart = 64;
  const Index n = cosine.size();
  const double step = 2 * omega / double(n - 1), c = std::cos(step), s = std::sin(step);
  for (Index i = 0; i < n; ++i) {
    if (i % restart == 0) {
      const double phase = omega * (2 * double(i) / double(n - 1) - 1);
      cosine[i] = std::cos(phase);
      sine[i] = std::sin(phase);
    } else {
      cosine[i] = cosine[i - 1] * c - sine[i - 1] * s;
      sine[i] = sine[i - 1] * c + cosine[i - 1] * s;
    }
  }
}

}  // namespace

LineModel::LineModel(const VectorXd& y, int drift_degree) : y_(y), drift_(legendre(y.size(), drift_degree)) {
  project();
}

void LineModel::project() {
  const Index n_drift = drift_.cols();
  A_.resize(y_.size(), n_drift + 2 * Index(waves.size()));
  A_.leftCols(n_drift) = drift_;
  for (std::size_t l = 0; l < waves.size(); ++l) fill_wave(omega(waves[l]), A_.col(cosine(l)), A_.col(cosine(l) + 1));
  MatrixXd gram = MatrixXd::Zero(A_.cols(), A_.cols());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(A_.transpose());
  gram_.compute(gram);
  coefficients_ = A_.transpose() * y_;
  gram_.solve_in_place(coefficients_);
  residual_ = y_ - A_ * coefficients_;
  // The normal equations square the condition number. One step of iterative refinement restores the lost digits.
  VectorXd correction = A_.transpose() * residual_;
  gram_.solve_in_place(correction);
  coefficients_ += correction;
  residual_ = y_ - A_ * coefficients_;
}

void LineModel::refine(Accuracy accuracy) {
  constexpr int max_steps = 20, max_halvings = 8;
  for (int n = 0; n < max_steps; ++n) {
    const double before = rss();
    const std::vector<double> start = bases;
    const MatrixXd S = projected_hessian();  // sets the matrix D
    VectorXd step = mechanics::solve_semidefinite(S, jacobian_.transpose() * residual_);
    for (int halving = 0; halving <= max_halvings; ++halving, step /= 2) {
      for (std::size_t b = 0; b < bases.size(); ++b) bases[b] = start[b] + step[Index(b)];
      project();
      if (rss() <= before) break;
    }
    if (!(rss() < before)) {
      bases = start;
      project();
      return;
    }
    if (accuracy == Accuracy::rough ? rss() > 0.9 * before : negligible(step)) return;
  }
}

bool LineModel::negligible(const VectorXd& step) const {
  double largest = 0;
  for (std::size_t b = 0; b < bases.size(); ++b)
    largest = std::max(largest, std::abs(step[Index(b)]) / std::abs(bases[b]));
  return largest < 1e-13;
}

std::pair<double, double> LineModel::amplitudes(std::size_t wave) const {
  return {coefficients_[cosine(wave)], coefficients_[cosine(wave) + 1]};
}

VectorXd LineModel::inverse_curvature() {
  const MatrixXd S = projected_hessian();
  VectorXd diagonal(S.rows());
  for (Index k = 0; k < S.rows(); ++k) diagonal[k] = mechanics::solve_semidefinite(S, VectorXd::Unit(S.rows(), k))[k];
  return diagonal;
}

MatrixXd LineModel::projected_hessian() {
  jacobian_.setZero(y_.size(), Index(bases.size()));
  const VectorXd s = VectorXd::LinSpaced(y_.size(), -1, 1);
  for (std::size_t l = 0; l < waves.size(); ++l) {
    const auto [a, b] = amplitudes(l);
    jacobian_.col(Index(waves[l].base)) +=
        waves[l].multiple * s.cwiseProduct(b * A_.col(cosine(l)) - a * A_.col(cosine(l) + 1));
  }
  const MatrixXd coupling = A_.transpose() * jacobian_;
  return jacobian_.transpose() * jacobian_ - coupling.transpose() * gram_.solve(coupling);
}

}  // namespace pseudorigid::analysis
