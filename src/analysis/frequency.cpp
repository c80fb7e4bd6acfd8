#include "analysis/frequency.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "analysis/line_model.h"
#include "analysis/periodogram.h"

namespace pseudorigid::analysis {
namespace {

using Eigen::Index, Eigen::VectorXd;
using std::numbers::pi;

/// Returns the frequency Ω of the single line with the least residual, among trial frequencies within 1.5π of `peak`.
/// In this file Ω = ωT/2, with the length T of the record. In a record of less than six cycles, the slow drift and the
/// mirror image of the line at −Ω displace the peak of the periodogram.
double scan_low_frequencies(LineModel model, double peak) {
  double best = peak, least = std::numeric_limits<double>::infinity();
  for (double omega = std::max(peak - 1.5 * pi, 0.5 * pi); omega <= peak + 1.5 * pi; omega += 0.25 * pi) {
    model.bases = {omega};
    model.waves = {{0, 1}};
    model.project();
    if (model.rss() < least) {
      least = model.rss();
      best = omega;
    }
  }
  return best;
}

// Distances of two lines in Ω. One resolution width is π.
constexpr double resolved = 0.7 * pi;      ///< least distance of two lines
constexpr double well_separated = 2 * pi;  ///< least distance of a new line from others if neighbours are excluded

/// Whether a new line may be closer than two resolution widths to another line.
enum class Neighbours { admitted, excluded };

/// Adds a line for a peak at the frequency Ω = `omega`. The line is constrained if the peak is close to a multiple of
/// the first line, and otherwise free. If the peak is close to a constrained line, the function frees this line and
/// does not add another. Returns false, without a change, if Ω is too close to another line.
bool add_line(LineModel& model, double omega, Neighbours neighbours) {
  constexpr double tie_width = 0.5 * pi;  // a distance in Ω
  double distance = std::numeric_limits<double>::infinity();
  for (Wave& wave : model.waves) {
    const double d = std::abs(model.omega(wave) - omega);
    if (wave.multiple > 1 && d < 2 * tie_width) {
      model.bases.push_back(model.omega(wave));
      wave = {model.bases.size() - 1, 1};
      return true;
    }
    distance = std::min(distance, d);
  }
  const int multiple = int(std::lround(omega / model.bases[0]));
  const bool tied = multiple >= 2 && std::abs(omega - multiple * model.bases[0]) < tie_width;
  if (distance < (tied || neighbours == Neighbours::admitted ? resolved : well_separated)) return false;
  if (!tied) model.bases.push_back(omega);
  model.waves.push_back(tied ? Wave{0, multiple} : Wave{model.bases.size() - 1, 1});
  return true;
}

/// The later of two lines that are closer than `resolved`, or nothing if all lines are resolved. The samples do not
/// distinguish Ω from its images −Ω and Ω + π(n − 1), for n samples. Lines after the first must also be resolved from
/// their images.
std::optional<std::size_t> merged_line(const LineModel& model) {
  const double period = pi * double(model.residual().size() - 1);
  const auto distance = [&](double a, double b) { return std::abs(std::remainder(a - b, period)); };
  for (std::size_t l = 1; l < model.waves.size(); ++l) {
    const double line = model.omega(model.waves[l]);
    if (distance(line, -line) < resolved) return l;
    for (std::size_t k = 0; k < l; ++k) {
      const double other = model.omega(model.waves[k]);
      if (std::min(distance(line, other), distance(line, -other)) < resolved) return l;
    }
  }
  return {};
}

/// Removes the line with the index `line` > 0, together with its frequency if this is free.
void remove_line(LineModel& model, std::size_t line) {
  const auto [base, multiple] = model.waves[line];
  model.waves.erase(model.waves.begin() + std::ptrdiff_t(line));
  if (multiple > 1) return;
  model.bases.erase(model.bases.begin() + std::ptrdiff_t(base));
  for (Wave& wave : model.waves) wave.base -= wave.base > base;
}

/// Refines the frequencies. If the refinement brings two lines together, they imitate one line of varying amplitude,
/// with large amplitudes of opposite sign. The function then removes the later of both and repeats the refinement from
/// the beginning. Lines are added at the highest peaks first, so the later line is usually the weaker one.
void refine_resolved(LineModel& model, LineModel::Accuracy accuracy) {
  while (true) {
    const std::vector<double> start = model.bases;
    model.project();
    model.refine(accuracy);
    const std::optional<std::size_t> merged = merged_line(model);
    if (!merged) return;
    model.bases = start;
    remove_line(model, *merged);
  }
}

/// Finds the first line and makes it the only line of the model. Returns the reason if there is no first line, and
/// otherwise an empty text.
std::string find_first_line(LineModel& model, const VectorXd& y, int drift_degree) {
  const std::vector<double> peaks = periodogram_peaks(model.residual());
  if (peaks.empty()) return "no line stands out of the noise";
  constexpr double safe_cycles = 6, polynomial_cycles = 3;
  const double peak = peaks.front();
  const double guess = peak < safe_cycles * pi ? scan_low_frequencies(model, peak) : peak;
  model.bases = {guess};
  model.waves = {{0, 1}};
  model.project();
  model.refine(LineModel::Accuracy::rough);
  const double cycles = std::abs(model.bases[0]) / pi;
  if (!(cycles >= 1)) return "the record is shorter than one period";
  // A slow trend resembles one or two cycles. Below three cycles, the residual with the line must therefore be smaller
  // than the residual of a polynomial with the same number of parameters.
  if (cycles < polynomial_cycles && LineModel(y, drift_degree + 3).rss() <= model.rss())
    return "the signal drifts without an oscillation that stands out";
  return {};
}

/// The quality of a model, computed from its residual.
struct Assessment {
  std::vector<double> peaks;  ///< peaks of the periodogram of the residual
  /// The factor σ of the standard errors (FrequencyFit). The free frequency Ω_b has the standard error σ √((S⁻¹)_bb),
  /// with the matrix S of line_model.h.
  double deviation;
  double first_error;  ///< standard error of the first frequency Ω
  /// The largest change of the first Ω from one accepted model to the next, in standard errors of the former, but at
  /// least 1. A larger value shows that the standard errors of this signal are too small by this factor.
  double factor = 1;
};

/// Computes the quality of a model. `size` is the largest magnitude of the samples and determines their round-off.
Assessment assess(LineModel& model, double size) {
  Assessment a{.peaks = periodogram_peaks(model.residual()), .deviation = 0, .first_error = 0};
  const double freedom = std::max<double>(1, double(model.residual().size() - model.n_parameters()));
  const double deviation = std::sqrt(model.rss() / (a.peaks.empty() ? freedom : 1));
  a.deviation = std::max(deviation, std::numeric_limits<double>::epsilon() * size);
  a.first_error = a.deviation * std::sqrt(std::abs(model.inverse_curvature()[0]));
  return a;
}

/// The search for the lines of a signal with more than one line.
struct Search {
  LineModel& model;
  Assessment state;  ///< quality of `model`
  double size;       ///< the largest magnitude of the samples
  int max_lines;

  /// Adds lines at the peaks `peaks` of the residual if this reduces the error of the first frequency. Then updates the
  /// model and its quality and returns true. Otherwise the model does not change, and the result is false.
  bool add_lines(std::span<const double> peaks, Neighbours neighbours);
  /// Adds lines at all peaks of the residual, or otherwise one line at the first peak that permits this. Returns false
  /// if no peak permits it.
  bool add_lines();
  /// Refines all frequencies, and removes lines that merge. Does nothing if this doubles the error of the first
  /// frequency.
  void polish();

 private:
  /// Replaces the model by `trial`, with the quality `outcome`.
  void accept(LineModel& trial, Assessment outcome);
};

void Search::accept(LineModel& trial, Assessment outcome) {
  outcome.factor = std::max(state.factor, std::abs(trial.bases[0] - model.bases[0]) / state.first_error);
  std::swap(model.bases, trial.bases);
  std::swap(model.waves, trial.waves);
  model.project();
  state = std::move(outcome);
}

bool Search::add_lines(std::span<const double> peaks, Neighbours neighbours) {
  const auto is_full = [this](const LineModel& m) {
    return int(m.waves.size()) >= max_lines || 2 * (m.n_parameters() + 3) > m.residual().size();
  };
  if (is_full(model)) return false;
  LineModel trial = model;
  for (const double peak : peaks) {
    if (is_full(trial)) break;
    if (add_line(trial, peak, neighbours)) trial.project();
  }
  if (trial.n_parameters() == model.n_parameters()) return false;
  refine_resolved(trial, LineModel::Accuracy::rough);
  if (trial.n_parameters() <= model.n_parameters()) return false;
  Assessment outcome = assess(trial, size);
  if (!(outcome.first_error < state.first_error)) return false;
  // Two close lines can imitate one line of varying amplitude, but the residual then has peaks close to them. If the
  // signal really has two close lines, the residual has no such peaks.
  const auto is_near = [&](double peak) {
    return std::ranges::any_of(peaks, [&](double line) { return std::abs(peak - line) < well_separated; });
  };
  if (neighbours == Neighbours::admitted && std::ranges::any_of(outcome.peaks, is_near)) return false;
  accept(trial, std::move(outcome));
  return true;
}

bool Search::add_lines() {
  const std::vector<double> peaks = state.peaks;
  if (add_lines(peaks, Neighbours::excluded)) return true;
  for (const Neighbours neighbours : {Neighbours::excluded, Neighbours::admitted}) {
    if (peaks.size() == 1 && neighbours == Neighbours::excluded) continue;  // tried already
    for (const double& peak : peaks)
      if (add_lines({&peak, 1}, neighbours)) return true;
  }
  return false;
}

void Search::polish() {
  LineModel polished = model;
  refine_resolved(polished, LineModel::Accuracy::full);
  Assessment outcome = assess(polished, size);
  if (outcome.first_error < 2 * state.first_error) accept(polished, std::move(outcome));
}

/// Adds lines until the residual is round-off or the first frequency has the precision `options.precision`. The search
/// also ends if no further line is permitted, or if no further line reduces the error of the first frequency. Then
/// `polish` refines all lines. Returns the quality of the model.
Assessment complete_lines(LineModel& model, double size, const FrequencyOptions& options) {
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * size;
  Search search{.model = model, .state = assess(model, size), .size = size, .max_lines = options.max_lines};
  while (std::sqrt(model.rss() / double(model.residual().size())) > round_off &&
         search.state.first_error > options.precision * model.bases[0] && search.add_lines()) {
  }
  search.polish();
  return search.state;
}

/// The lines of a model with this quality: the first line, and then the others by decreasing amplitude. `half_length`
/// is half the length T of the record, so that ω = Ω/half_length.
std::vector<Line> read_lines(LineModel& model, const Assessment& quality, double half_length) {
  const VectorXd curvature = model.inverse_curvature();
  std::vector<Line> lines;
  for (std::size_t l = 0; l < model.waves.size(); ++l) {
    const auto [a, b] = model.amplitudes(l);
    const Wave& wave = model.waves[l];
    const double omega = model.omega(wave);
    const double standard = quality.deviation * std::sqrt(std::abs(curvature[Index(wave.base)]));
    const double error = wave.multiple * standard * (wave.base == 0 ? quality.factor : 1);
    lines.push_back({.frequency = omega / half_length,
                     .uncertainty = error / half_length,
                     .amplitude = std::hypot(a, b),
                     .phase = std::remainder(std::atan2(-b, a) - omega, 2 * pi)});
  }
  std::ranges::sort(lines.begin() + 1, lines.end(), std::greater{}, &Line::amplitude);
  return lines;
}

}  // namespace

std::optional<Line> second_line(const FrequencyFit& fit) {
  if (!fit) return {};
  constexpr double share = 0.5, near_multiple = 0.01;
  const double omega = fit.dominant().frequency;
  const auto is_second = [&](const Line& line) {
    const double multiple = std::round(line.frequency / omega);
    const bool is_harmonic = multiple >= 2 && std::abs(line.frequency - multiple * omega) < near_multiple * omega;
    const bool is_resolved = std::abs(line.frequency - omega) * fit.cycles >= 2 * omega;
    return !is_harmonic && !is_drift(line) && is_resolved && line.amplitude >= share * fit.dominant().amplitude;
  };
  const auto found = std::find_if(fit.lines.begin() + 1, fit.lines.end(), is_second);
  return found == fit.lines.end() ? std::nullopt : std::optional(*found);
}

FrequencyFit fit_frequency(std::span<const double> values, double interval, const FrequencyOptions& options) {
  constexpr std::size_t least_samples = 16;
  constexpr double least_precision = 0.05;
  FrequencyFit fit;
  const auto refuse = [&fit](std::string reason) {
    fit.reason = std::move(reason);
    return fit;
  };
  if (values.size() < least_samples) return refuse("the record has fewer than 16 samples");
  const VectorXd y = Eigen::Map<const VectorXd>(values.data(), Index(values.size()));
  if (!y.allFinite() || !(interval > 0)) return refuse("the samples are not finite");
  const double size = y.cwiseAbs().maxCoeff();
  fit.mean = y.mean();
  if (y.maxCoeff() - y.minCoeff() <= options.round_off * size) return refuse("the signal is constant");

  LineModel model(y, options.drift_degree);
  if (std::string reason = find_first_line(model, y, options.drift_degree); !reason.empty()) return refuse(reason);
  const Assessment outcome = complete_lines(model, size, options);
  const double half_length = interval * double(values.size() - 1) / 2;
  std::vector<Line> lines = read_lines(model, outcome, half_length);
  fit.residual_rms = std::sqrt(model.rss() / double(y.size()));
  fit.cycles = lines.front().frequency * half_length / pi;
  if (!(fit.cycles >= 1 && lines.front().uncertainty < least_precision * lines.front().frequency))
    return refuse("the samples do not determine a frequency");
  fit.lines = std::move(lines);
  return fit;
}

}  // namespace pseudorigid::analysis
