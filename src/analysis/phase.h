#pragma once
/// Phase of an oscillation over time. Near the time t_n of each sample, the signal is fitted by
///
///   y(t) ≈ d + a cos ω(t − t_n) + b sin ω(t − t_n),   |t − t_n| ≤ π/ω
///
/// with the given frequency ω, by least squares over one period. The phase at t_n is θ_n = arg(a − ib), and the
/// amplitude is A_n = √(a² + b²). The fit is then d + A_n cos(θ_n + ω(t − t_n)). In the first and the last half period
/// of the record, the window around t_n exceeds the record. There, θ_n is extrapolated from the nearest complete window
/// with the rate ω. While A_n is below a hundredth of the largest amplitude, θ_n also grows at the rate ω. The phase is
/// continuous: it increases by about 2π in each period.

#include <span>
#include <vector>

namespace pseudorigid::analysis {

/// Least number of samples in a period for which `phase` computes phases.
inline constexpr double least_samples_per_period = 4;

/// The phases θ_n, in radians, at the samples `values`, which have the constant positive time step `interval`. The
/// argument `frequency` is ω > 0. The number of samples in a period is rounded to a whole number. The result is empty
/// if this number exceeds the number of samples, or is less than `least_samples_per_period`. If `least_amplitude` is
/// not null and the result is not empty, it becomes the least A_n.
std::vector<double> phase(std::span<const double> values, double interval, double frequency,
                          double* least_amplitude = nullptr);

}  // namespace pseudorigid::analysis
