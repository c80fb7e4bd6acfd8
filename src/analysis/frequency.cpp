#include "analysis/frequency.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
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

constexpr double resolved = 0.7 * pi;  ///< least distance of two lines in Ω; π is one resolution width

/// Whether a new line may be closer than two resolution widths to another line.
enum class Neighbours { admitted, excluded };

/// Adds a line for a peak at the frequency Ω = `omega`. The line is constrained if the peak is close to a multiple of
/// the first line, and otherwise free. If the peak is close to a constrained line, the function frees this line and
/// does not add another. Returns false, without a change, if Ω is too close to another line.
bool add_line(LineModel& model, double omega, Neighbours neighbours) {
  constexpr double tie_width = 0.5 * pi, well_separated = 2 * pi;  // distances in Ω
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

/// Returns true if no two lines of the model are closer than `resolved`. A line at −Ω is the line at Ω. If a refinement
/// brings two lines together, they imitate one line of varying amplitude, with large amplitudes of opposite sign.
bool is_resolved(const LineModel& model) {
  std::vector<double> lines;
  for (const Wave& wave : model.waves) lines.push_back(std::abs(model.omega(wave)));
  std::ranges::sort(lines);
  const auto too_close = [](double below, double above) { return above - below < resolved; };
  return std::ranges::adjacent_find(lines, too_close) == lines.end();
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
  /// The largest part of a change of the first Ω, from one accepted model to the next, that exceeds the standard error
  /// of the former. It shows that this error was too small.
  double excess = 0;
};

/// The excess after a change of the first Ω by `change` from a model with the quality `before`.
double excess_after(const Assessment& before, double change) {
  return std::max(before.excess, std::abs(change) - before.first_error);
}

/// Computes the quality of a model. `size` is the largest magnitude of the samples and determines their round-off.
Assessment assess(LineModel& model, double size) {
  Assessment a{.peaks = periodogram_peaks(model.residual()), .deviation = 0, .first_error = 0};
  const double freedom = std::max<double>(1, double(model.residual().size() - model.n_parameters()));
  const double deviation = std::sqrt(model.rss() / (a.peaks.empty() ? freedom : 1));
  a.deviation = std::max(deviation, std::numeric_limits<double>::epsilon() * size);
  a.first_error = a.deviation * std::sqrt(std::abs(model.inverse_curvature()[0]));
  return a;
}

/// A round of the search for further lines: the largest number of peaks that become lines, and whether new lines may be
/// close to other lines.
struct Round {
  std::size_t n_peaks;
  Neighbours neighbours;
};

/// Adds lines at the peaks `state.peaks` of the residual if this reduces the error of the first frequency. Then updates
/// the quality `state` of the model and returns true. Otherwise the model does not change, and the result is false.
bool add_lines(LineModel& model, Assessment& state, const Round& round, double size, int max_lines) {
  LineModel trial = model;
  std::size_t n_added = 0;
  for (const double peak : state.peaks) {
    const bool full = int(trial.waves.size()) >= max_lines || 2 * (trial.n_parameters() + 3) > trial.residual().size();
    if (full || n_added == round.n_peaks) break;
    n_added += add_line(trial, peak, round.neighbours);
  }
  if (n_added == 0) return false;
  trial.project();
  trial.refine(LineModel::Accuracy::rough);
  if (!is_resolved(trial)) return false;
  Assessment outcome = assess(trial, size);
  if (!(outcome.first_error < state.first_error)) return false;
  // Two close lines can imitate one line of varying amplitude, but the residual then has peaks. If the signal really
  // has two close lines, the residual has no peaks.
  if (round.neighbours == Neighbours::admitted && !outcome.peaks.empty()) return false;
  outcome.excess = excess_after(state, trial.bases[0] - model.bases[0]);
  std::swap(model.bases, trial.bases);
  std::swap(model.waves, trial.waves);
  model.project();
  state = std::move(outcome);
  return true;
}

/// Adds lines until the residual is round-off or the first frequency has the precision `options.precision`. The search
/// also ends if no further line is permitted, or if no further line reduces the error of the first frequency. Then the
/// function refines all frequencies, unless this doubles the error of the first frequency. Returns the quality of the
/// model.
Assessment complete_lines(LineModel& model, double size, const FrequencyOptions& options) {
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * size;
  const std::size_t all = std::size_t(options.max_lines);
  const Round rounds[] = {{all, Neighbours::excluded}, {1, Neighbours::excluded}, {1, Neighbours::admitted}};
  Assessment state = assess(model, size);
  bool gained = true;
  while (gained && std::sqrt(model.rss() / double(model.residual().size())) > round_off &&
         state.first_error > options.precision * model.bases[0]) {
    const auto gains = [&](const Round& round) { return add_lines(model, state, round, size, options.max_lines); };
    gained = std::ranges::any_of(rounds, gains);
  }
  // If two lines merge during the refinement, the residual can decrease and the error of the frequency increase. The
  // unrefined frequencies are then better.
  LineModel polished = model;
  polished.refine(LineModel::Accuracy::full);
  Assessment outcome = assess(polished, size);
  if (!is_resolved(polished) || !(outcome.first_error < 2 * state.first_error)) return state;
  outcome.excess = excess_after(state, polished.bases[0] - model.bases[0]);
  std::swap(model.bases, polished.bases);
  model.project();
  return outcome;
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
    const double error = wave.multiple * (standard + (wave.base == 0 ? quality.excess : 0));
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
