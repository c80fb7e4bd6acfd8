#include "analysis/periodogram.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace pseudorigid::analysis {
namespace {

using Eigen::Index, Eigen::VectorXd;
using std::numbers::pi;

/// Magnitudes of the periodogram of the samples y at the angles θ = 2πk/n_padded per sample, k = 0 … n_padded/2. The
/// samples are extended by zeros to the number n_padded, so that each peak covers several of these angles.
std::vector<double> spectrum(const VectorXd& y, std::size_t n_padded) {
  std::vector<double> windowed(n_padded, 0.0);
  const double n = double(y.size());
  for (Index i = 0; i < y.size(); ++i)
    windowed[std::size_t(i)] = y[i] * 0.5 * (1 - std::cos(2 * pi * (double(i) + 0.5) / n));
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> transform;
  fft.fwd(transform, windowed);
  std::vector<double> magnitude(transform.size());
  std::ranges::transform(transform, magnitude.begin(), [](const auto& z) { return std::abs(z); });
  return magnitude;
}

/// The value that about a quarter of the values do not exceed.
double lower_quartile(std::vector<double> values) {
  const auto quarter = values.begin() + std::ptrdiff_t(values.size() / 4);
  std::ranges::nth_element(values, quarter);
  return *quarter;
}

/// The position of the maximum of the parabola through the logarithms of the magnitudes m at k − 1, k, k + 1. If the
/// parabola does not have a maximum, the result is k.
double vertex(const std::vector<double>& m, std::size_t k) {
  const double left = std::log(m[k - 1]), middle = std::log(m[k]), right = std::log(m[k + 1]);
  const double curvature = left - 2 * middle + right;
  return double(k) + (std::isfinite(curvature) && curvature < 0 ? 0.5 * (left - right) / curvature : 0);
}

}  // namespace

std::vector<double> periodogram_peaks(const VectorXd& y) {
  constexpr double least_fraction = 1 / 20.0, noise_factor = 8;
  constexpr std::size_t padding = 2;
  const std::size_t n_padded = std::bit_ceil(padding * std::size_t(y.size()));
  const std::vector<double> m = spectrum(y, n_padded);
  const double threshold = std::max(least_fraction * std::ranges::max(m), noise_factor * lower_quartile(m));

  std::vector<std::size_t> peaks;
  for (std::size_t k = 1; k + 1 < m.size(); ++k)
    if (m[k] > threshold && m[k] >= m[k - 1] && m[k] > m[k + 1]) peaks.push_back(k);
  std::ranges::sort(peaks, std::greater{}, [&m](std::size_t k) { return m[k]; });

  std::vector<double> omegas;
  for (const std::size_t k : peaks) {
    const double omega = pi * vertex(m, k) * double(y.size() - 1) / double(n_padded);
    const auto close = [omega](double other) { return std::abs(other - omega) < 2 * pi; };
    if (std::ranges::none_of(omegas, close)) omegas.push_back(omega);
  }
  return omegas;
}

}  // namespace pseudorigid::analysis
