#pragma once
/// The least-squares problem of the frequency fit (frequency.h) for a given set of waves. The problem consists of two
/// minimisations:
///
///   minimise |y − A(Ω) c|² over c (projection, A has the columns P_k, cos Ωs, sin Ωs), then over Ω by Gauss–Newton:
///   S δΩ = Dᵀr,  D = ∂(A c)/∂Ω,  S = DᵀD − DᵀA (AᵀA)⁻¹ AᵀD,  r = y − A c.
///
/// Here y are the samples, c the coefficients, P_k the Legendre polynomials and r the residual. The frequency Ω = ωT/2
/// is the phase per unit of s ∈ [−1, 1] in a record of length T. The record contains Ω/π cycles. One resolution width
/// is 2π/T in ω, and π in Ω.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::analysis {

/// The frequency of a line of the fit: a free frequency, or a multiple of a free frequency.
struct Wave {
  std::size_t base;  ///< index of a free frequency in `bases`
  int multiple;      ///< Ω = multiple · bases[base]
};

/// The fit of a set of waves, with its coefficients and its residual.
class LineModel {
 public:
  /// Makes a model without waves, with Legendre polynomials up to the degree `drift_degree`. The samples `y` must
  /// outlive the model.
  LineModel(const Eigen::VectorXd& y, int drift_degree);

  std::vector<double> bases;  ///< free frequencies; call project() after a change of `bases` or `waves`
  std::vector<Wave> waves;

  /// Computes the matrix A, the coefficients c = argmin |y − A c| and the residual y − A c for the current waves and
  /// frequencies.
  void project();

  enum class Accuracy { rough, full };
  /// Makes at most 20 Gauss–Newton steps for the free frequencies. A step is halved, at most 8 times, until the
  /// residual does not increase. The function undoes a step that does not reduce the residual, and ends. With full
  /// accuracy, the function also ends after a step that changes every frequency by less than 1e-13 of its value. With
  /// rough accuracy, it ends after a step that reduces the squared residual by less than a tenth. Rough accuracy is
  /// sufficient to find further lines.
  void refine(Accuracy accuracy);

  /// The frequency Ω of a wave.
  double omega(const Wave& w) const { return w.multiple * bases[w.base]; }
  /// The sum |y − A c|² of the squared residuals.
  double rss() const { return residual_.squaredNorm(); }
  const Eigen::VectorXd& residual() const { return residual_; }
  /// The number of fitted numbers: the coefficients c and the free frequencies.
  Eigen::Index n_parameters() const { return A_.cols() + Eigen::Index(bases.size()); }
  /// The coefficients (a, b) of a cos Ωs + b sin Ωs for the wave with the index `wave` in `waves`.
  std::pair<double, double> amplitudes(std::size_t wave) const;
  /// The diagonal of S⁻¹, with one entry for each free frequency. The standard error of a free frequency Ω is σ
  /// (FrequencyFit) times the square root of its entry.
  Eigen::VectorXd inverse_curvature();

 private:
  /// The index of the column cos Ωs of a wave in A. The column sin Ωs follows.
  Eigen::Index cosine(std::size_t wave) const { return drift_.cols() + 2 * Eigen::Index(wave); }
  /// True if the step δΩ changes every free frequency by less than 1e-13 of its value.
  bool negligible(const Eigen::VectorXd& step) const;
  Eigen::MatrixXd projected_hessian();  ///< computes the matrix D and returns S

  const Eigen::VectorXd& y_;
  Eigen::MatrixXd drift_, A_, jacobian_;  ///< the columns P_k of A, the matrix A, and the matrix D
  Eigen::VectorXd coefficients_, residual_;
  mechanics::CholeskyFactor gram_;  ///< of AᵀA
};

}  // namespace pseudorigid::analysis
