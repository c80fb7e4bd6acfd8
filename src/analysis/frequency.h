#pragma once
/// Frequencies of a uniformly sampled signal, by nonlinear least squares.
///
///   y(t) ≈ Σ_{k≤d} d_k P_k(s) + Σ_l [a_l cos(ω_l t) + b_l sin(ω_l t)],   s ∈ [−1, 1] over the record,  P_k Legendre
///
/// The coefficients d, a, b are eliminated (variable projection: G. Golub, V. Pereyra, SIAM J. Numer. Anal. 10 (1973);
/// Kaufman's form), the frequencies follow by Gauss–Newton steps that may not raise the residual. Lines are added if
/// the Hann-windowed periodogram of the residual has a peak, as long as that lowers the standard error of the first
/// frequency. A peak at a multiple k of the first line's frequency is tied to it, ω = kω₀, so that an anharmonic motion
/// yields its fundamental from all its harmonics; the tie is cut when the residual contradicts it.
///
/// Limits: at least one period in the record; lines two resolution widths 2π/T apart (closer ones are told apart only
/// if they explain everything: a modulated or damped line also looks like a cluster); frequencies below Nyquist's
/// (a signal sampled too coarsely appears at an alias, which no fit can tell).

#include <span>
#include <string>
#include <vector>

namespace pseudorigid::analysis {

/// amplitude · cos(frequency (t − t₀) + phase), t₀ the time of the first sample.
struct Line {
  double frequency = 0;    ///< angular, rad per unit of time
  double uncertainty = 0;  ///< standard error of the frequency, see FrequencyFit
  double amplitude = 0;
  double phase = 0;
};

/// Either lines, that of the highest peak of the periodogram first, the others by falling amplitude, or the reason why
/// there is none.
///
/// The standard error is σ√(S⁻¹), S the projected Gauss–Newton matrix. If the residual is noise, σ is its standard
/// deviation, but at least the round-off of the samples. If a line still stands out of it (too close to another, or one
/// too many), σ is the norm of the whole residual: the bound of Cauchy and Schwarz for the error of the frequency by a
/// signal of that size.
struct FrequencyFit {
  std::vector<Line> lines;
  std::string reason;       ///< "the signal is constant", …; empty if lines were found
  double mean = 0;          ///< of the samples
  double residual_rms = 0;  ///< in the signal's unit
  double cycles = 0;        ///< periods of the dominant line in the record

  explicit operator bool() const { return !lines.empty(); }
  const Line& dominant() const { return lines.front(); }
};

struct FrequencyOptions {
  int max_lines = 12;
  int drift_degree = 2;      ///< degree d of the slow drift
  double precision = 1e-13;  ///< lines are added until the dominant frequency has this relative standard error
  double round_off = 1e-12;  ///< a signal that varies by less than this fraction of its size is constant
};

/// Fits `values`, sampled at a constant positive `interval`.
FrequencyFit fit_frequency(std::span<const double> values, double interval, const FrequencyOptions& options = {});

}  // namespace pseudorigid::analysis
