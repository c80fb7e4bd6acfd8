#pragma once
/// The least-squares problem behind the frequency fit, for a given set of waves:
///
///   minimise |y − A(Ω) c|² over c (projection, A's columns are P_k, cos Ωs, sin Ωs), then over Ω by Gauss–Newton:
///   S δΩ = Dᵀr,  D = ∂(A c)/∂Ω,  S = DᵀD − DᵀA (AᵀA)⁻¹ AᵀD,  r = y − A c.
///
/// A frequency is Ω = ωT/2, the phase per unit of s ∈ [−1, 1] over the record of length T: Ω/π is the number of cycles
/// in the record, and two lines are one resolution width apart when their Ω differ by π.

#include <Eigen/Dense>
#include <utility>
#include <vector>

namespace pseudorigid::analysis {

struct Wave {
  std::size_t base;  ///< which free frequency
  int multiple;      ///< Ω = multiple · bases[base]
};

class LineModel {
 public:
  /// `y` must outlive the model.
  LineModel(const Eigen::VectorXd& y, int drift_degree);

  std::vector<double> bases;  ///< the free frequencies; after a change of these or of the waves, project()
  std::vector<Wave> waves;

  /// c = argmin |y − A c| at the present frequencies.
  void project();

  enum class Accuracy { rough, full };
  /// Gauss–Newton steps, halved until the residual falls. Rough: ends when a step reduces the residual by less than a
  /// tenth, which is enough to find further lines.
  void refine(Accuracy accuracy);

  double omega(const Wave& w) const { return w.multiple * bases[w.base]; }
  double rss() const { return residual_.squaredNorm(); }
  const Eigen::VectorXd& residual() const { return residual_; }
  Eigen::Index n_parameters() const { return A_.cols() + Eigen::Index(bases.size()); }
  /// (a, b) of a cos Ωs + b sin Ωs.
  std::pair<double, double> amplitudes(std::size_t wave) const;
  /// Diagonal of S⁻¹, one entry per base.
  Eigen::VectorXd inverse_curvature();

 private:
  Eigen::Index cosine(std::size_t wave) const { return drift_.cols() + 2 * Eigen::Index(wave); }  ///< its column
  bool negligible(const Eigen::VectorXd& step) const;
  Eigen::MatrixXd projected_hessian();  ///< S; keeps D

  const Eigen::VectorXd& y_;
  Eigen::MatrixXd drift_, A_, jacobian_;
  Eigen::VectorXd coefficients_, residual_;
  Eigen::LLT<Eigen::MatrixXd> gram_;
};

}  // namespace pseudorigid::analysis
