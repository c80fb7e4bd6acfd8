#pragma once
/// The discretisation error of a series of runs, from the differences d of successive runs. The model of the error e of
/// a run with resolution N is
///
///   e(N) = C N⁻ᵖ,
///
/// with a constant C and the rate p. The rate is algebraic in the degree and in the mesh size, because shear fronts
/// leave the surface of the ball. Two runs with resolutions N and N' and an assumed rate give
///
///   e(N) = d N⁻ᵖ / |N'⁻ᵖ − N⁻ᵖ|,
///
/// and three runs with the differences d₁₂ and d₂₃ also give the rate, from
///
///   d₁₂ / d₂₃ = (N₁⁻ᵖ − N₂⁻ᵖ) / (N₂⁻ᵖ − N₃⁻ᵖ).
///
/// The rate is kept between bounds: two runs may be close by chance, and a fast initial rate need not continue. Errors
/// of successive runs often differ in sign or have their maxima at different times. The difference d is then up to
/// their sum, and the estimate is an upper bound.

#include <cstddef>
#include <vector>

namespace pseudorigid::analysis {

/// Assumed rate and its bounds. The measured rates are between the bounds or larger (docs/benchmarks.md, "Error in
/// space").
inline constexpr double assumed_space_rate = 3, least_space_rate = 2.5, largest_space_rate = 6;
/// Lower bound of the rate p for polynomial bodies, with N their degree; also the rate assumed for a run and its
/// companion. Releases of incompressible balls have rates above 2. A compressible ball whose pressure front meets at
/// the centre has the rate 1.3, for which the estimate is too small.
inline constexpr double least_polynomial_rate = 1.5;

/// The error e of a run with resolution N, if d is its difference from a run with resolution N_other.
double space_error(double d, double N, double N_other, double rate = assumed_space_rate);

/// The rate and the error of runs with increasing resolution.
class SpaceErrorLadder {
 public:
  explicit SpaceErrorLadder(double least_rate = least_space_rate) : least_rate_(least_rate) {}

  /// Adds the next run. Its difference from the run before is d, which is ignored for the first run.
  void add(double N, double d) { runs_.push_back({N, d}); }
  std::size_t n_runs() const { return runs_.size(); }
  double resolution_of(std::size_t i) const { return runs_[i].N; }
  double difference_of(std::size_t i) const { return runs_[i].d; }

  /// The rate p.
  double rate() const;
  /// The error e of the last run. Infinite if there is only one run.
  double error() const;
  /// The error e of a run with resolution N.
  double predicted_error(double N) const;

 private:
  struct Run {
    double N, d;
  };
  double least_rate_;
  std::vector<Run> runs_;
};

}  // namespace pseudorigid::analysis
