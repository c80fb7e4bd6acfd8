#pragma once
/// Estimate of the discretisation error of a run from the differences d of successive runs in a series of increasing
/// resolution N. N is the degree of a polynomial body, or scene::resolution of a mesh of finite elements. In the model
/// of the estimate, the error e of a run is
///
///   e(N) = C N⁻ᵖ,
///
/// with a constant C and the rate p. The error decreases only with a power of N, because the motion is not smooth at
/// the shear fronts. These fronts start at the surface of the ball. Two runs with resolutions N and N' and an assumed
/// rate give
///
///   e(N) = d N⁻ᵖ / |N'⁻ᵖ − N⁻ᵖ|,
///
/// and three runs with the differences d₁₂ and d₂₃ also determine the rate by
///
///   d₁₂ / d₂₃ = (N₁⁻ᵖ − N₂⁻ᵖ) / (N₂⁻ᵖ − N₃⁻ᵖ).
///
/// The rate is limited to an interval. The lower bound is necessary because two runs may have a small difference by
/// chance. The upper bound is necessary because a fast initial rate need not continue. Errors of successive runs often
/// differ in sign, or have their maxima at different times. The difference d can then be as large as the sum of both
/// errors, and the estimate is an upper bound.

#include <cstddef>
#include <vector>

namespace pseudorigid::analysis {

/// The rate p that is assumed for fewer than three runs, and the bounds of the rate of finite elements. Measured rates
/// are between the bounds or larger (docs/benchmarks.md, "Error in space").
inline constexpr double assumed_space_rate = 3, least_space_rate = 2.5, largest_space_rate = 6;
/// Lower bound of the rate p for polynomial bodies, whose resolution N is their degree. If the program makes only one
/// other run of the scene (the companion run), it computes the error with this rate. The measured rates of
/// incompressible balls after a release are above 2. If the pressure front of a compressible ball converges to the
/// centre, the measured rate is 1.3, and the estimate is too small.
inline constexpr double least_polynomial_rate = 1.5;
/// The rate p that is assumed for stresses. The largest stress after a release shows no convergence from degree 4 to 7
/// of finite elements (docs/adequacy.md, "Stress"). Its estimate is not a bound.
inline constexpr double assumed_stress_rate = 1;

/// The error e of a run with resolution N, if d is its difference from a run with resolution N_other. `rate` is p. The
/// resolutions must differ.
double space_error(double d, double N, double N_other, double rate = assumed_space_rate);

/// The rate and the errors of a series of runs with increasing resolution.
class SpaceErrorLadder {
 public:
  /// `least_rate` is the lower bound of the rate. The upper bound is largest_space_rate.
  explicit SpaceErrorLadder(double least_rate = least_space_rate) : least_rate_(least_rate) {}

  /// Adds the next run with its resolution N. The difference from the previous run is d, which is ignored for the first
  /// run.
  void add(double N, double d) { runs_.push_back({N, d}); }
  std::size_t n_runs() const { return runs_.size(); }
  double resolution_of(std::size_t i) const { return runs_[i].N; }
  double difference_of(std::size_t i) const { return runs_[i].d; }

  /// The rate p from the last three runs, limited to its bounds. If there are fewer than three runs, the result is
  /// assumed_space_rate.
  double rate() const;
  /// The error e of the last run. It is infinite if there are fewer than two runs.
  double error() const;
  /// The error e of a further run with resolution N. It is infinite if there are fewer than two runs.
  double predicted_error(double N) const;

 private:
  struct Run {
    double N, d;
  };
  double least_rate_;
  std::vector<Run> runs_;
};

}  // namespace pseudorigid::analysis
