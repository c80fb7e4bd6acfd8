#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "analysis/comparison_workshop.h"
#include "analysis/frequency_error.h"
#include "analysis/phase.h"
#include "analysis/samples.h"

namespace pseudorigid::analysis {
namespace {

using Eigen::Matrix3d;

/// The ratio of the dominant frequencies and the bound of its error. A part of the error (ErrorBar) is empty if this
/// part is not known for one of the models.
FrequencyRatio ratio_of(const ModelSummary& model, const ModelSummary& reference) {
  const double a = model.frequency.dominant().frequency, b = reference.frequency.dominant().frequency;
  const ErrorBar &of_a = model.frequency_error, &of_b = reference.frequency_error;
  // The frequencies are a ± δa and b ± δb with the bounds δa, δb of their errors. The largest possible ratio has the
  // denominator b − δb. If δb exceeds b/2, the ratio is not determined, and the denominator is b/2.
  const double least =
      b - std::min(of_b.fit + of_b.time.value_or(0) + of_b.space.value_or(0) + of_b.quadrature.value_or(0), b / 2);
  const auto of_parts = [&](double da, double db) { return (da + db * a / b) / least; };
  FrequencyRatio ratio{a / b, {.fit = of_parts(of_a.fit, of_b.fit)}};
  const auto both = [&](std::optional<double> ErrorBar::*part) {
    return of_a.*part && of_b.*part ? std::optional(of_parts(*(of_a.*part), *(of_b.*part))) : std::nullopt;
  };
  ratio.error.time = both(&ErrorBar::time);
  ratio.error.space = both(&ErrorBar::space);
  ratio.error.quadrature = both(&ErrorBar::quadrature);
  return ratio;
}

constexpr double turn = 2 * std::numbers::pi;

/// The differences a − b of two phases in periods, of which the first is between −½ and ½.
std::vector<double> periods_apart(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> apart = each([](double x, double y) { return (x - y) / turn; }, a, b);
  const double whole_turns = std::nearbyint(apart.front());
  for (double& periods : apart) periods -= whole_turns;
  return apart;
}

/// The fitted component (i, j) of C of the models r and c, and the time between two samples.
struct FittedComponent {
  const Deformation &r, &c;
  std::pair<int, int> entry;
  double interval;
};

/// The phase of a component of C with the frequency of `model`, and its least amplitude.
struct PhaseOfModel {
  PhaseOfModel(const std::vector<double>& samples, double interval, const ModelSummary& model)
      : theta(phase(samples, interval, model.frequency.dominant().frequency, &least_amplitude)) {}

  double least_amplitude = 0;
  std::vector<double> theta;
};

/// The parts of the error of phase_difference. An error ε of the component with the amplitude A changes its phase by
/// arcsin(ε/A) at most. The part in space is f max_t |θ_c − θ'_c|, as for other quantities (difference_error.h). Each
/// part also contains the error δω of the frequencies. They extrapolate the phases over half a period at both ends of
/// the record, which adds δω/(2ω) periods. Nothing is known if ε exceeds A, or if two lines share the motion.
ErrorBar error_of_phases(const Workshop& w, const FittedComponent& fitted, const PhaseOfModel& of_r,
                         const PhaseOfModel& of_c) {
  const ModelSummary &r = w.out.model, &c = w.out.reference;
  if (second_line(r.frequency) || second_line(c.frequency)) return unknown;
  ErrorBar bar = unknown;
  const auto of_both = [&](std::optional<double> RunErrors::*part) -> std::optional<double> {
    const auto &a = w.of_model.*part, &b = w.of_reference.*part;
    if (!a || !b) return {};
    const double of_model = error_of_component(fitted.r, fitted.entry, *a) / of_r.least_amplitude,
                 of_reference = error_of_component(fitted.c, fitted.entry, *b) / of_c.least_amplitude;
    if (!(of_model < 1 && of_reference < 1)) return {};
    return (std::asin(of_model) + std::asin(of_reference)) / turn;
  };
  bar.time = of_both(&RunErrors::time);
  bar.quadrature = of_both(&RunErrors::quadrature);
  if (w.of_reference.space == 0.0 && !w.of_reference.other) bar.space = 0;
  const std::vector<double> samples = other_component(fitted.entry, of_c.theta.size(), w.of_reference);
  if (!samples.empty()) {
    const PhaseOfModel other(samples, fitted.interval, c);
    if (!other.theta.empty())
      bar.space = w.of_reference.other->factor * largest(periods_apart(of_c.theta, other.theta));
  }
  return sum(bar, sum(times(0.5 / r.frequency.dominant().frequency, r.frequency_error),
                      times(0.5 / c.frequency.dominant().frequency, c.frequency_error)));
}

/// Adds the series phase_difference, and its values after 1, 2, 5, 10, 20, 50 … periods of the reference. Adds nothing
/// if one of the models does not have a phase (phase.h).
void compare_phases(Workshop& w, const FittedComponent& fitted) {
  Comparison& out = w.out;
  const auto [i, j] = fitted.entry;
  const PhaseOfModel of_r(fitted.r.component(i, j), fitted.interval, out.model),
      of_c(fitted.c.component(i, j), fitted.interval, out.reference);
  if (of_r.theta.empty() || of_c.theta.empty()) return;
  std::vector<double> apart = periods_apart(of_r.theta, of_c.theta);
  const double omega = out.reference.frequency.dominant().frequency;
  for (int decade = 1; decade <= 1'000'000; decade *= 10)
    for (const int n : {decade, 2 * decade, 5 * decade}) {
      const double position = n * turn / (omega * fitted.interval);  // number of sampling intervals in n periods
      const auto before = std::size_t(position);
      if (before + 1 < apart.size())
        out.phase_after_periods[n] = std::lerp(apart[before], apart[before + 1], position - double(before));
    }
  w.add("phase_difference", 1, std::move(apart), error_of_phases(w, fitted, of_r, of_c));
}

/// Fits the frequency of the same component of C in both models. Adds the ratio of the frequencies and the phases,
/// unless a model has no frequency or its frequency is that of a load.
void fit_frequencies(Workshop& w, const Deformation& r, const Deformation& c) {
  Comparison& out = w.out;
  const bool by_reference = !out.model.deforms && out.reference.deforms;
  const auto [i, j] = (by_reference ? c : r).liveliest_component();
  out.signal = fmt::format("C{}{}", i + 1, j + 1);
  out.signal_reason =
      fmt::format("entry of C = Q^T Q that varies most in the {}",
                  by_reference ? fmt::format("{} (the {} model keeps its shape)", out.reference.name, out.model.name)
                               : out.model.name + " model");
  const bool loads_rise = w.options.facts.loads_rise;
  out.model.frequency = fit_component(r.component(i, j), out.time, out.model.deforms, loads_rise);
  out.reference.frequency = fit_component(c.component(i, j), out.time, out.reference.deforms, loads_rise);
  const auto judge = [&](ModelSummary& model, const Deformation& deformation, const RunErrors& errors) {
    model.frequency_error = frequency_error(model.frequency, deformation, {i, j}, out.time, errors);
    model.load = load_of_line(model.frequency, w.options.facts.load_frequencies);
  };
  judge(out.model, r, w.of_model);
  judge(out.reference, c, w.of_reference);
  if (!out.model.frequency || !out.reference.frequency || out.model.load || out.reference.load) return;
  out.ratio = ratio_of(out.model, out.reference);
  compare_phases(w, {r, c, {i, j}, (out.time.back() - out.time.front()) / double(out.time.size() - 1)});
}

/// True if the body spins: the norm of Q̇Qᵀ − QQ̇ᵀ or of QᵀQ̇ − Q̇ᵀQ at a sample exceeds spin_threshold times the largest
/// |Q||Q̇|. Let J be the angular momentum, Z the circulation and m̄ the factor in the kinetic energy ½m̄|Q̇|². The axial
/// vectors of the two matrices are J/m̄ and Z/m̄. The table must have the columns of Q and Q̇.
bool spins(const io::Table& table) {
  const auto Q = read<Matrix3d>(table, Q_columns), Qdot = read<Matrix3d>(table, Qdot_columns);
  double spin = 0, bound = 0;
  for (std::size_t n = 0; n < Q.size(); ++n) {
    const Matrix3d L = Qdot[n] * Q[n].transpose(), R = Q[n].transpose() * Qdot[n];
    spin = std::max({spin, (L - L.transpose()).norm(), (R - R.transpose()).norm()});
    bound = std::max(bound, Q[n].norm() * Qdot[n].norm());
  }
  return spin > spin_threshold * bound;
}

}  // namespace

void compare_states(Workshop& w) {
  if (!w.available("deformation and frequency", Q_columns)) return;
  Comparison& out = w.out;
  out.has_state = true;
  const double resolution = w.options.facts.resolution;
  const Deformation r(w.r, resolution, out.model), c(w.c, resolution, out.reference);
  const std::vector<double> apart = distances(c.Q, r.Q);
  const std::vector<double> sizes = norms(r.Q);
  const double least = std::ranges::min(sizes);
  w.add("q_difference", 1, each(ratio_or_zero, apart, sizes), w.errors.of_function_of_Q(1 / least),
        w.errors.of_function_of_model(1 / least));
  out.error = out.series.back().error;
  // The divisors of the next two series are the larger departure and the larger strain amplitude of both models. If
  // neither ball moves, they are the resolution times |Q| and |C| of model r at the first sample.
  const double departure = std::max({out.model.departure, out.reference.departure, resolution * r.Q[0].norm()});
  const double amplitude =
      std::max({out.model.strain_amplitude, out.reference.strain_amplitude, resolution * r.C[0].norm()});
  const ErrorBar of_departure = w.errors.of_function_of_Q(1 / departure);
  w.add("q_difference_of_departure", departure, apart, of_departure, of_departure);
  const double size = std::max(largest(sizes), largest(norms(c.Q)));
  const ErrorBar of_strain = w.errors.of_function_of_Q(2 * size / amplitude);
  w.add("strain_difference", amplitude, distances(c.C, r.C), of_strain, times(std::numbers::sqrt2, of_strain));
  fit_frequencies(w, r, c);
  const bool turning = !w.r.has_column(Qdot_columns.front()) || spins(w.r);
  if (!turning) out.exact_ratio = w.options.exact_frequency_ratio;
}

}  // namespace pseudorigid::analysis
