#pragma once
/// Peaks of the Hann-windowed periodogram |Σ w_i y_i exp(−iθ i)|: the first guess of the frequency fit.

#include <Eigen/Core>
#include <vector>

namespace pseudorigid::analysis {

/// Ω = ωT/2 (phase per half record) of the peaks, strongest first, at least two resolution widths 2π/T apart. A peak
/// counts if it exceeds both 1/20 of the strongest one (the window's side lobes stay below 1/36) and eight times the
/// lower quartile of the spectrum (in white noise a given bin does so with a probability of 1e-8).
std::vector<double> periodogram_peaks(const Eigen::VectorXd& y);

}  // namespace pseudorigid::analysis
