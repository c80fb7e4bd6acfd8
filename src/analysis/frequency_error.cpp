#include "analysis/frequency_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pseudorigid::analysis {
namespace {

/// The length T of the record, in the unit of time of the samples.
double record_length(const FrequencyFit& fit) { return 2 * std::numbers::pi * fit.cycles / fit.dominant().frequency; }

/// The bound (3/2) ε/(A T) of the error of the frequency, which frequency_error.h derives. A is the amplitude of the
/// dominant line, and T is the length of the record. `entry` is (i, j), and e bounds the error of every entry of Q.
double error_of_phase(const FrequencyFit& fit, const Deformation& deformation, std::pair<int, int> entry, double e) {
  constexpr double of_growing_phase = 1.5;
  return of_growing_phase * error_of_component(deformation, entry, e) / (fit.dominant().amplitude * record_length(fit));
}

/// The dominant line of C_ij on the discretisation `errors.other`, with `entry` = (i, j). The result is empty if there
/// is no other discretisation, if its record is shorter, or if its fit does not have lines.
std::optional<Line> other_line(std::pair<int, int> entry, const std::vector<double>& time, const RunErrors& errors) {
  const std::vector<double> signal = other_component(entry, time.size(), errors);
  if (signal.empty()) return std::nullopt;
  const FrequencyFit fit = fit_component(signal, time, true);
  return fit ? std::optional(fit.dominant()) : std::nullopt;
}

}  // namespace

double error_of_component(const Deformation& deformation, std::pair<int, int> entry, double e) {
  const auto [i, j] = entry;
  double columns = 0;
  for (const Eigen::Matrix3d& Q : deformation.Q)
    columns = std::max(columns, Q.col(i).lpNorm<1>() + Q.col(j).lpNorm<1>());
  return columns * e;
}

std::vector<double> other_component(std::pair<int, int> entry, std::size_t n_samples, const RunErrors& errors) {
  if (!errors.other || errors.other->samples.n_rows() < n_samples) return {};
  ModelSummary summary;
  std::vector<double> signal = Deformation(errors.other->samples, 0, summary).component(entry.first, entry.second);
  signal.resize(n_samples);
  return signal;
}

ErrorBar frequency_error(const FrequencyFit& fit, const Deformation& deformation, std::pair<int, int> entry,
                         const std::vector<double>& time, const RunErrors& errors) {
  ErrorBar bar;
  if (!fit) return bar;
  const Line& own = fit.dominant();
  bar.fit = n_standard_errors * own.uncertainty;
  const auto of_phase = [&](const std::optional<double>& e) {
    return e ? std::optional(error_of_phase(fit, deformation, entry, *e)) : std::nullopt;
  };
  bar.time = of_phase(errors.time);
  bar.quadrature = of_phase(errors.quadrature);
  if (const auto other = other_line(entry, time, errors)) {
    bar.fit = std::max(bar.fit, n_standard_errors * other->uncertainty);
    bar.space = errors.other->factor * std::abs(own.frequency - other->frequency);
  } else if (!errors.other && errors.space == 0.0) {
    bar.space = 0;
  }
  return bar;
}

std::optional<double> load_of_line(const FrequencyFit& fit, const std::vector<double>& load_frequencies) {
  if (!fit) return std::nullopt;
  const double width = std::numbers::pi / 2 / record_length(fit);
  for (const double load : load_frequencies)
    for (const double multiple : {1.0, 2.0})
      if (std::abs(fit.dominant().frequency - multiple * std::abs(load)) <= width) return std::abs(load);
  return std::nullopt;
}

}  // namespace pseudorigid::analysis
