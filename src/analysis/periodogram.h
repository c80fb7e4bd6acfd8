#pragma once
/// Peaks of the Hann-windowed periodogram |Σ w_i y_i exp(−iθ i)|, which are the initial values of the frequency fit.

#include <Eigen/Core>
#include <vector>

namespace pseudorigid::analysis {

/// Frequencies Ω = ωT/2 of the peaks, the strongest first, with T the length of the record. The distance of two peaks
/// is at least two resolution widths 2π/T. A peak must exceed 1/20 of the strongest peak; side lobes of the window are
/// below 1/36. A peak must also exceed eight times the lower quartile of the spectrum. In white noise, a given bin
/// exceeds this value with a probability of 1e-8.
std::vector<double> periodogram_peaks(const Eigen::VectorXd& y);

}  // namespace pseudorigid::analysis
