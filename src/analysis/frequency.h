#pragma once
/// Frequencies of a uniformly sampled signal, found by a nonlinear least-squares fit of the model
///
///   y(t) ≈ Σ_{k≤d} d_k P_k(s) + Σ_l [a_l cos(ω_l t) + b_l sin(ω_l t)],   s ∈ [−1, 1]
///
/// with the Legendre polynomials P_k up to the degree d. The variable s is the time t, mapped linearly from the record
/// to [−1, 1]. The coefficients d_k, a_l, b_l are eliminated by linear least squares (variable projection: G. Golub, V.
/// Pereyra, SIAM J. Numer. Anal. 10 (1973); Kaufman's form). Gauss–Newton steps determine the frequencies. A step that
/// increases the residual is not accepted.
///
/// A line is one frequency ω_l with its amplitude and phase. Lines are added at peaks of the Hann-windowed periodogram
/// of the residual, while this reduces the standard error of the first frequency ω₀. A line at a peak near a multiple
/// kω₀ is constrained to ω = kω₀. All harmonics of an anharmonic motion then determine its fundamental frequency. The
/// constraint is removed if the residual has a further peak close to kω₀.
///
/// The fit has the following limits. The record must contain at least 16 samples and one period. A new line is at least
/// two resolution widths 2π/T from other lines, with the length T of the record. A closer line is admitted only if the
/// residual then has no peak within two widths of it, because a modulated or damped line also resembles several close
/// lines. A line at a multiple of ω₀ may also be closer. If the refinement brings two lines closer than 0.7 widths, the
/// later line is removed. The same holds for a line and its image at −ω, or beyond the Nyquist frequency. Frequencies
/// are below the Nyquist frequency. The fit cannot detect that a frequency is an alias of a higher frequency.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pseudorigid::analysis {

/// The oscillation amplitude · cos(frequency (t − t₀) + phase), with t₀ the time of the first sample.
struct Line {
  double frequency = 0;    ///< angular frequency, in radians per unit of time
  double uncertainty = 0;  ///< standard error of the frequency (FrequencyFit)
  double amplitude = 0;
  double phase = 0;  ///< in radians
};

/// The lines of a fit, or the reason why the fit does not have lines. The first line, the dominant line, was found at
/// the highest peak of the periodogram. The other lines are sorted by decreasing amplitude.
///
/// The standard errors of the free frequencies Ω = ωT/2, with the length T of the record, are σ times the roots of the
/// diagonal of S⁻¹. Here S is the projected Gauss–Newton matrix (line_model.h). A line that is constrained to kω₀ has k
/// times the error of ω₀. If the residual is noise, σ is its standard deviation, but at least the round-off of the
/// samples. If the periodogram of the residual still has a peak, for example from a line close to another line, σ is
/// the norm of the residual. By the inequality of Cauchy and Schwarz, the standard error is then a bound of the error
/// that a signal of this size can cause. The search for lines can change ω₀ by more than the standard error that ω₀ had
/// before. The standard error is then multiplied by the change over the error before, the largest one of the search.
struct FrequencyFit {
  std::vector<Line> lines;
  std::string reason;  ///< for example "the signal is constant"; empty if there are lines
  double mean = 0;     ///< mean of the samples; 0 if there are fewer than 16 samples or if a sample is not finite
  /// Root mean square of the residual, in the unit of the signal. It is 0 if no first line was found.
  double residual_rms = 0;
  double cycles = 0;  ///< number of periods of the dominant line in the record; 0 if no first line was found

  explicit operator bool() const { return !lines.empty(); }
  const Line& dominant() const { return lines.front(); }
};

struct FrequencyOptions {
  int max_lines = 12;        ///< largest number of lines
  int drift_degree = 2;      ///< degree d of the polynomial for slow drift
  double precision = 1e-13;  ///< relative standard error of the dominant frequency at which no further lines are added
  double round_off = 1e-12;  ///< a signal is constant if its range, divided by its largest magnitude, is not larger
};

/// The strongest line that is not the dominant line, a multiple of the dominant line, or a slow drift. The result is
/// empty if this line has less than half of the dominant amplitude. A line closer to the dominant line than two
/// resolution widths 2π/T, with the length T of the record, does not count. The reason is that a damped motion
/// resembles several close lines. If there is a second line, the dominant frequency alone does not describe the motion.
/// With gravity, this happens if the frequencies of two modes are close (avoided crossing).
std::optional<Line> second_line(const FrequencyFit& fit);

/// Whether a line describes a slow drift: its frequency is within three standard errors of 0.
inline bool is_drift(const Line& line) { return line.frequency <= 3 * line.uncertainty; }

/// Fits the lines to the samples `values`, which have the constant positive time step `interval`. If no frequency can
/// be determined, the result has the reason instead of lines.
FrequencyFit fit_frequency(std::span<const double> values, double interval, const FrequencyOptions& options = {});

}  // namespace pseudorigid::analysis
