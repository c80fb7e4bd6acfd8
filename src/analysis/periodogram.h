#pragma once
/// Peaks of the Hann-windowed periodogram |Σ_k w_k y_k exp(−iθk)| of equidistant samples y_k. Here w_k is the window,
/// and θ is the phase angle per sampling interval. The peaks are the initial values of the frequency fit.

#include <Eigen/Core>
#include <vector>

namespace pseudorigid::analysis {

/// Returns the frequencies Ω = ωT/2 of the peaks for the samples y, the highest peak first. T is the length of the
/// record from the first to the last sample. The distance of two peaks is at least two resolution widths 2π/T of ω. If
/// two peaks are closer, the lower peak is omitted. A peak must exceed 1/20 of the highest peak, because side lobes of
/// the window reach 1/37. A peak must also exceed eight times the lower quartile of the spectrum. In white noise, the
/// periodogram at a given angle exceeds this value with a probability of 1e-8.
std::vector<double> periodogram_peaks(const Eigen::VectorXd& y);

}  // namespace pseudorigid::analysis
