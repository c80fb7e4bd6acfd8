#pragma once
/// The discretisation error of a series of runs from the differences d of successive ones, where it falls with the
/// resolution N of a run as
///
///   e(N) = C N⁻ᵖ.
///
/// Shear fronts leave the surface of the ball, so that the rate is algebraic in the degree as well as in the mesh size.
/// Two runs with a rate that is assumed give
///
///   e(N) = d N⁻ᵖ / |N'⁻ᵖ − N⁻ᵖ|,
///
/// and three runs give the rate too, from
///
///   d₁₂ / d₂₃ = (N₁⁻ᵖ − N₂⁻ᵖ) / (N₂⁻ᵖ − N₃⁻ᵖ).
///
/// The rate observed is kept between bounds: two runs may come close by chance, and a fast start need not go on. The
/// errors of successive runs often differ in sign or reach their maxima at different times; then d is up to their sum,
/// and the estimate on the safe side.

#include <cstddef>
#include <vector>

namespace pseudorigid::analysis {

/// The measured rates are between the bounds or above them (docs/benchmarks.md, "Error in space").
inline constexpr double assumed_space_rate = 3, least_space_rate = 2.5, largest_space_rate = 6;
/// The rate for polynomial bodies of degree N. Releases of incompressible balls have rates above 2; the error of a
/// compressible one whose pressure front meets at the centre falls with 1.3.
inline constexpr double least_polynomial_rate = 1.5;

/// e of the run of resolution N, at the distance d from one of resolution N_other.
double space_error(double d, double N, double N_other, double rate = assumed_space_rate);

/// Runs of rising resolution.
class SpaceErrorLadder {
 public:
  explicit SpaceErrorLadder(double least_rate = least_space_rate) : least_rate_(least_rate) {}

  /// The next run, at the distance d from the one before (without meaning for the first).
  void add(double N, double d) { runs_.push_back({N, d}); }
  std::size_t n_runs() const { return runs_.size(); }
  double resolution_of(std::size_t i) const { return runs_[i].N; }
  double difference_of(std::size_t i) const { return runs_[i].d; }

  /// p.
  double rate() const;
  /// Error e of the last run; infinite if there is only one run.
  double error() const;
  /// e of a run of the resolution N.
  double predicted_error(double N) const;

 private:
  struct Run {
    double N, d;
  };
  double least_rate_;
  std::vector<Run> runs_;
};

}  // namespace pseudorigid::analysis
