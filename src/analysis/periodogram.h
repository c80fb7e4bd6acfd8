#pragma once
/// Peaks of the Hann-windowed periodogram |Σ_k w_k y_k exp(−iθk)| of the samples y_k, with the window w_k and the angle
/// θ per sample. The peaks are the initial values of the frequency fit.

#include <Eigen/Core>
#include <vector>

namespace pseudorigid::analysis {

/// Returns the frequencies Ω = ωT/2 of the peaks, the highest peak first, with the length T of the record. The distance
/// of two peaks is at least two resolution widths 2π/T of ω. A peak must exceed 1/20 of the highest peak, because side
/// lobes of the window reach 1/37. A peak must also exceed eight times the lower quartile of the spectrum. In white
/// noise, a given bin exceeds this value with a probability of 1e-8.
std::vector<double> periodogram_peaks(const Eigen::VectorXd& y);

}  // namespace pseudorigid::analysis
