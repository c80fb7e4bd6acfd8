#include "analysis/frequency.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "analysis/periodogram.h"

namespace pseudorigid::analysis {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

/// Inside this file a frequency is Ω = ωT/2, the phase per unit of s ∈ [−1, 1]: Ω/π is the number of cycles in the
/// record, and two lines are one resolution width apart when their Ω differ by π.
struct Wave {
  std::size_t base;  ///< which free frequency
  int multiple;      ///< Ω = multiple · bases[base]
};

/// Columns P_0 … P_degree at n equidistant points of [−1, 1].
MatrixXd legendre(Index n, int degree) {
  const VectorXd s = VectorXd::LinSpaced(n, -1, 1);
  MatrixXd P(n, degree + 1);
  P.col(0).setOnes();
  if (degree > 0) P.col(1) = s;
  for (int k = 2; k <= degree; ++k)
    P.col(k) = ((2 * k - 1) * s.cwiseProduct(P.col(k - 1)) - (k - 1) * P.col(k - 2)) / k;
  return P;
}

/// Columns cos(Ωs), sin(Ωs). Rotating by a fixed angle is much cheaper than a sine; a fresh start every 64 samples
/// keeps the accumulated error at round-off.
void fill_wave(double omega, Eigen::Ref<VectorXd> cosine, Eigen::Ref<VectorXd> sine) {
  constexpr Index restart = 64;
  const Index n = cosine.size();
  const double step = 2 * omega / double(n - 1), c = std::cos(step), s = std::sin(step);
  for (Index i = 0; i < n; ++i) {
    if (i % restart == 0) {
      const double phase = omega * (2 * double(i) / double(n - 1) - 1);
      cosine[i] = std::cos(phase);
      sine[i] = std::sin(phase);
    } else {
      cosine[i] = cosine[i - 1] * c - sine[i - 1] * s;
      sine[i] = sine[i - 1] * c + cosine[i - 1] * s;
    }
  }
}

/// The least-squares problem for a given set of waves, and its solution by variable projection.
class LineModel {
 public:
  LineModel(const VectorXd& y, int drift_degree) : y_(y), drift_(legendre(y.size(), drift_degree)) { project(); }

  std::vector<double> bases;
  std::vector<Wave> waves;

  double omega(const Wave& w) const { return w.multiple * bases[w.base]; }
  double rss() const { return residual_.squaredNorm(); }
  const VectorXd& residual() const { return residual_; }
  Index n_parameters() const { return A_.cols() + Index(bases.size()); }

  /// d, a, b = argmin |y − A c| at the present frequencies.
  void project() {
    const Index n_drift = drift_.cols();
    A_.resize(y_.size(), n_drift + 2 * Index(waves.size()));
    A_.leftCols(n_drift) = drift_;
    for (std::size_t l = 0; l < waves.size(); ++l) fill_wave(omega(waves[l]), A_.col(cosine(l)), A_.col(cosine(l) + 1));
    MatrixXd gram = MatrixXd::Zero(A_.cols(), A_.cols());
    gram.selfadjointView<Eigen::Lower>().rankUpdate(A_.transpose());
    gram_.compute(gram.selfadjointView<Eigen::Lower>());
    coefficients_ = gram_.solve(A_.transpose() * y_);
    residual_ = y_ - A_ * coefficients_;
    // The normal equations square the condition number; one refinement gives the digits back.
    coefficients_ += gram_.solve(A_.transpose() * residual_);
    residual_ = y_ - A_ * coefficients_;
  }

  enum class Accuracy { rough, full };

  /// Gauss–Newton on the projected problem, the step halved until the residual falls; rough: until it falls by less
  /// than a tenth, enough to see what is left.
  void refine(Accuracy accuracy) {
    constexpr int max_steps = 20, max_halvings = 8;
    for (int n = 0; n < max_steps && !bases.empty(); ++n) {
      const double before = rss();
      const std::vector<double> start = bases;
      VectorXd step = projected_hessian().ldlt().solve(jacobian_.transpose() * residual_);
      for (int halving = 0; halving <= max_halvings; ++halving, step /= 2) {
        for (std::size_t b = 0; b < bases.size(); ++b) bases[b] = start[b] + step[Index(b)];
        project();
        if (rss() <= before) break;
      }
      if (!(rss() < before)) {
        bases = start;
        project();
        return;
      }
      if (accuracy == Accuracy::rough ? rss() > 0.9 * before : converged(step)) return;
    }
  }

  std::pair<double, double> amplitudes(std::size_t l) const {
    return {coefficients_[cosine(l)], coefficients_[cosine(l) + 1]};
  }

  /// Diagonal of S⁻¹, one entry per base.
  VectorXd inverse_curvature() {
    const MatrixXd S = projected_hessian();
    return S.ldlt().solve(MatrixXd::Identity(S.rows(), S.cols())).diagonal();
  }

 private:
  Index cosine(std::size_t l) const { return drift_.cols() + 2 * Index(l); }

  bool converged(const VectorXd& step) const {
    double largest = 0;
    for (std::size_t b = 0; b < bases.size(); ++b)
      largest = std::max(largest, std::abs(step[Index(b)]) / std::abs(bases[b]));
    return largest < 1e-13;
  }

  /// S = DᵀD − DᵀA (AᵀA)⁻¹ AᵀD with D = ∂(A c)/∂Ω; keeps D.
  MatrixXd projected_hessian() {
    jacobian_.setZero(y_.size(), Index(bases.size()));
    const VectorXd s = VectorXd::LinSpaced(y_.size(), -1, 1);
    for (std::size_t l = 0; l < waves.size(); ++l) {
      const auto [a, b] = amplitudes(l);
      jacobian_.col(Index(waves[l].base)) +=
          waves[l].multiple * s.cwiseProduct(b * A_.col(cosine(l)) - a * A_.col(cosine(l) + 1));
    }
    const MatrixXd coupling = A_.transpose() * jacobian_;
    return jacobian_.transpose() * jacobian_ - coupling.transpose() * gram_.solve(coupling);
  }

  const VectorXd& y_;
  MatrixXd drift_, A_, jacobian_;
  VectorXd coefficients_, residual_;
  Eigen::LLT<MatrixXd> gram_;
};

/// Below six cycles the peak of a windowed periodogram is displaced by its mirror image and by the drift: try the
/// neighbourhood and keep the frequency of least residual.
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

enum class Neighbours { admitted, excluded };

/// Adds the line of a peak at Ω: tied to the first line, free, or by freeing the tied line that it contradicts.
/// False if it lies too close to a free line.
bool add_line(LineModel& model, double omega, Neighbours neighbours) {
  constexpr double tie_width = 0.5 * pi, resolved = 0.7 * pi, well_separated = 2 * pi;
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

/// One round: the peaks of the residual become lines. False, and the model unchanged, if nothing was gained.
bool add_lines(LineModel& model, int max_lines, Neighbours neighbours) {
  LineModel trial = model;
  const std::size_t most = neighbours == Neighbours::admitted ? 1 : std::size_t(max_lines);
  std::size_t n_added = 0;
  for (const double peak : periodogram_peaks(model.residual())) {
    const bool full = int(trial.waves.size()) >= max_lines || 2 * (trial.n_parameters() + 3) > trial.residual().size();
    if (full || n_added == most) break;
    n_added += add_line(trial, peak, neighbours);
  }
  if (n_added == 0) return false;
  trial.project();
  trial.refine(neighbours == Neighbours::admitted ? LineModel::Accuracy::full : LineModel::Accuracy::rough);
  // Neighbours that mimic a modulated amplitude leave something to explain at every order; two true lines do not.
  const bool doubtful = neighbours == Neighbours::admitted && !periodogram_peaks(trial.residual()).empty();
  if (!(trial.rss() < model.rss()) || doubtful) return false;
  std::swap(model.bases, trial.bases);
  std::swap(model.waves, trial.waves);
  model.project();
  return true;
}

/// The first line, or why there is none.
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
  // A slow trend looks like a cycle or two: the line must beat the polynomial with as many parameters.
  if (cycles < polynomial_cycles && LineModel(y, drift_degree + 3).rss() <= model.rss())
    return "the signal drifts without an oscillation that stands out";
  return {};
}

/// The standard deviation that the residual stands for; see FrequencyFit.
double effective_deviation(const LineModel& model, double size) {
  const VectorXd& r = model.residual();
  const Index n = r.size();
  const double rss = model.rss(), freedom = std::max<double>(1, double(n - model.n_parameters()));
  const double lag = rss > 0 ? r.head(n - 1).dot(r.tail(n - 1)) / rss : 0;
  const double correlation = std::clamp(lag, 0.0, 1 - 1 / double(n));
  const double deviation = std::max(std::sqrt(rss / freedom), std::numeric_limits<double>::epsilon() * size);
  return deviation * std::sqrt((1 + correlation) / (1 - correlation));
}

std::vector<Line> read_lines(LineModel& model, double size, double half_length) {
  const VectorXd curvature = model.inverse_curvature();
  const double deviation = effective_deviation(model, size);
  std::vector<Line> lines;
  for (std::size_t l = 0; l < model.waves.size(); ++l) {
    const auto [a, b] = model.amplitudes(l);
    const Wave& wave = model.waves[l];
    const double omega = model.omega(wave);
    const double error = wave.multiple * deviation * std::sqrt(std::abs(curvature[Index(wave.base)]));
    lines.push_back({.frequency = omega / half_length,
                     .uncertainty = error / half_length,
                     .amplitude = std::hypot(a, b),
                     .phase = std::remainder(std::atan2(-b, a) - omega, 2 * pi)});
  }
  std::ranges::sort(lines, std::greater{}, &Line::amplitude);
  return lines;
}

/// Adds lines until the residual is round-off, holds no further line, or says nothing more about the first frequency.
void complete_lines(LineModel& model, double size, const FrequencyOptions& options) {
  const double round_off = 16 * std::numeric_limits<double>::epsilon() * size;
  const auto finished = [&] {
    if (std::sqrt(model.rss() / double(model.residual().size())) < round_off) return true;
    const double error = effective_deviation(model, size) * std::sqrt(std::abs(model.inverse_curvature()[0]));
    return error < options.precision * model.bases[0];
  };
  while (!finished() && (add_lines(model, options.max_lines, Neighbours::excluded) ||
                         add_lines(model, options.max_lines, Neighbours::admitted))) {
  }
  model.refine(LineModel::Accuracy::full);
}

}  // namespace

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
  complete_lines(model, size, options);
  const double half_length = interval * double(values.size() - 1) / 2;
  std::vector<Line> lines = read_lines(model, size, half_length);
  fit.residual_rms = std::sqrt(model.rss() / double(y.size()));
  fit.cycles = lines.front().frequency * half_length / pi;
  if (!(fit.cycles >= 1 && lines.front().uncertainty < least_precision * lines.front().frequency))
    return refuse("the samples do not determine a frequency");
  fit.lines = std::move(lines);
  return fit;
}

}  // namespace pseudorigid::analysis
