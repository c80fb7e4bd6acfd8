#include "analysis/phase.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::analysis {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
using std::numbers::pi;

/// The least-squares fit of d + a cos ωt + b sin ωt to a window of n_window successive samples. The time t is counted
/// from the first sample of the record. `angle` is ω times the time step.
class MovingFit {
 public:
  MovingFit(std::span<const double> values, double angle, std::size_t n_window)
      : values_(values),
        angle_(angle),
        n_window_(n_window),
        mean_(std::accumulate(values.begin(), values.end(), 0.0) / double(values.size())) {
    for (std::size_t k = 0; k < n_window; ++k) add(k, 1);
  }

  /// Moves the window by one sample towards the end of the record.
  void advance() {
    add(first_, -1);
    add(first_ + n_window_, 1);
    ++first_;
  }
  std::size_t first() const { return first_; }
  /// The coefficients of the fit to the current window, as the complex number a − ib. Its modulus is the amplitude. Its
  /// argument is θ − ωt for the phase θ at a time t.
  std::complex<double> amplitude() const {
    const Vector3d fit = mechanics::solve_semidefinite(normal_, right_);
    return {fit[1], -fit[2]};
  }

 private:
  /// Adds sample k to the normal equations (sign 1), or removes it (sign −1).
  void add(std::size_t k, double sign) {
    const Vector3d p(1, std::cos(angle_ * double(k)), std::sin(angle_ * double(k)));
    normal_ += sign * p * p.transpose();
    right_ += sign * (values_[k] - mean_) * p;
  }

  std::span<const double> values_;
  double angle_;                        ///< ω times the time step
  std::size_t n_window_, first_ = 0;    ///< number of samples in the window; index of its first sample
  double mean_;                         ///< mean of all samples; subtracted because it reduces round-off
  Matrix3d normal_ = Matrix3d::Zero();  ///< Σ p pᵀ over the window, p = (1, cos ωt, sin ωt)
  Vector3d right_ = Vector3d::Zero();   ///< Σ p (y − mean_) over the window, with the samples y
};

}  // namespace

std::vector<double> phase(std::span<const double> values, double interval, double frequency, double* least_amplitude) {
  const double angle = frequency * interval;
  const std::size_t n_values = values.size(), n_window = std::size_t(std::lround(2 * pi / angle));
  if (double(n_window) < least_samples_per_period || n_window > n_values) return {};
  MovingFit fit(values, angle, n_window);
  // The argument of amplitudes[n] is θ_n − ωt_n, which varies slowly with n.
  std::vector<std::complex<double>> amplitudes(n_values);
  double largest = 0;
  for (std::size_t n = 0; n < n_values; ++n) {
    const std::size_t first = std::min(n - std::min(n, n_window / 2), n_values - n_window);
    if (fit.first() < first) fit.advance();
    amplitudes[n] = n > 0 && first == 0 ? amplitudes[n - 1] : fit.amplitude();
    largest = std::max(largest, std::abs(amplitudes[n]));
  }
  if (least_amplitude)
    *least_amplitude = std::abs(*std::ranges::min_element(amplitudes, {}, [](auto a) { return std::abs(a); }));
  constexpr double faint = 0.01;
  std::vector<double> phases(n_values);
  double slow = std::arg(amplitudes[0]);
  for (std::size_t n = 0; n < n_values; ++n) {
    if (std::abs(amplitudes[n]) >= faint * largest) slow += std::remainder(std::arg(amplitudes[n]) - slow, 2 * pi);
    phases[n] = slow + angle * double(n);
  }
  return phases;
}

}  // namespace pseudorigid::analysis
