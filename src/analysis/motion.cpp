#include "analysis/motion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "analysis/frequency_error.h"
#include "analysis/samples.h"

namespace pseudorigid::analysis {

using Eigen::Matrix3d, Eigen::Vector3d;

namespace {

/// True if the table has all of these columns.
bool has_all(const io::Table& table, const Columns& names) {
  return std::ranges::all_of(names, [&](const std::string& name) { return table.has_column(name); });
}

/// The product m̄|Q||Q̇| at the sample with the largest |Q̇|, or 0 if the table lacks a column. The factor m̄ follows from
/// the kinetic energy ½m̄|Q̇|² (momentum_reference).
double momentum_bound(const io::Table& table) {
  if (!table.has_column("kinetic") || !has_all(table, Q_columns) || !has_all(table, Qdot_columns)) return 0;
  const std::vector<double> Q = norms(read<Matrix3d>(table, Q_columns)),
                            rate = norms(read<Matrix3d>(table, Qdot_columns));
  const auto n = std::size_t(std::ranges::max_element(rate) - rate.begin());
  return ratio_or_zero(2 * table.column("kinetic")[n] * Q[n], rate[n]);
}

ColumnRange range_of(std::string label, const std::vector<double>& values) {
  const auto [least, greatest] = std::ranges::minmax_element(values);
  return {std::move(label), *least, *greatest, values.back()};
}

/// A summary with the name, the adjective, the numbers of samples and failed intervals, and the first and last time.
/// The first column of the table must be the time.
MotionSummary begin_summary(const ModelRunTable& run) {
  MotionSummary s;
  s.model.name = run.name;
  s.model.adjective = run.adjective;
  s.model.n_failed_intervals = run.n_failed_intervals;
  s.n_samples = run.table.n_rows();
  s.first_time = run.table.row(0)[0];
  s.last_time = run.table.row(s.n_samples - 1)[0];
  return s;
}

/// The energy of a motion is round-off if it is below the fraction `least_energy_part` of the potential energy. For the
/// ball, the potential energy is the larger of the gravitational and external energies. For the ball, the energy of a
/// motion is also round-off if it is below the fraction `least_kinetic_part` of the unit of energy. Velocities that are
/// round-off have about this kinetic energy.
constexpr double least_energy_part = 1e-12, least_kinetic_part = 1e-24;

/// The columns whose ranges the summary of the ball contains, each with its label.
constexpr std::pair<const char*, const char*> shown_ranges[] = {
    {"a1", "semi-axis a1"},
    {"a2", "semi-axis a2"},
    {"a3", "semi-axis a3"},
    {"volume_ratio", "volume / reference volume"},
    {"kinetic", "kinetic energy"},
    {"elastic", "elastic energy"},
    {"nonaffine_displacement", "non-affine part of the position"},
    {"min_jacobian", "least det F"},
    {"volume_error", "rms of ln det F"},
};

}  // namespace

Deformation::Deformation(const io::Table& table, double resolution, ModelSummary& summary)
    : Q(read<Matrix3d>(table, Q_columns)) {
  double squares = 0, size = 0;
  for (const Matrix3d& q : Q) C_mean += (C.emplace_back(q.transpose() * q)) / double(Q.size());
  for (std::size_t n = 0; n < Q.size(); ++n) {
    summary.departure = std::max(summary.departure, (Q[n] - Q[0]).norm());
    squares += (C[n] - C_mean).squaredNorm();
    size = std::max(size, C[n].norm());
  }
  summary.strain_amplitude = std::numbers::sqrt2 * std::sqrt(squares / double(Q.size()));
  summary.turns = summary.departure > resolution * Q[0].norm();
  summary.deforms = summary.strain_amplitude > resolution * size;
}

std::vector<double> Deformation::component(int i, int j) const {
  return each([i, j](const Matrix3d& c) { return c(i, j); }, C);
}

std::pair<int, int> Deformation::liveliest_component() const {
  Matrix3d variance = Matrix3d::Zero();
  for (const Matrix3d& c : C) variance += (c - C_mean).cwiseAbs2();
  // Variances that are equal in exact arithmetic differ by round-off. The tolerance 1e-9 makes the result independent
  // of this round-off.
  const double least = (1 - 1e-9) * variance.maxCoeff();
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      if (variance(i, j) >= least) return {i, j};
  return {0, 0};
}

FrequencyFit fit_component(const std::vector<double>& signal, const std::vector<double>& time, bool deforms,
                           bool loads_rise) {
  constexpr double tolerance = 1e-9;
  FrequencyFit none;
  const double interval = (time.back() - time.front()) / double(std::max<std::size_t>(time.size(), 2) - 1);
  for (std::size_t n = 0; n < time.size(); ++n)
    if (std::abs(time[n] - time[0] - double(n) * interval) > tolerance * interval)
      none.reason = "the samples are not equally spaced";
  if (loads_rise) none.reason = "the loads rise";
  if (!deforms) none.reason = "the shape is constant";
  return none.reason.empty() ? fit_frequency(signal, interval) : none;
}

double energy_reference(std::initializer_list<const io::Table*> models, double unit) {
  double of_motion = 0, others = 0;
  for (const io::Table* table : models) {
    of_motion = std::max(of_motion, largest(each(std::plus{}, table->column("kinetic"), table->column("elastic"))));
    for (const char* name : {"dissipated", "orbital"})
      if (table->has_column(name)) of_motion = std::max(of_motion, largest(table->column(name)));
    for (const char* name : {"gravitational", "external"})
      if (table->has_column(name)) others = std::max(others, largest(table->column(name)));
  }
  if (of_motion >= std::max(least_energy_part * others, least_kinetic_part * unit)) return of_motion;
  return others > 0 ? others : unit;
}

void set_energy_drift(const io::Table& table, double reference, std::optional<double> tolerance,
                      ModelSummary& summary) {
  constexpr double most = 0.01, size_of_Q = std::numbers::sqrt3;
  const double departure = summary.departure;
  summary.energy_bound = tolerance && departure > 0 ? std::min(most, 4 * *tolerance * size_of_Q / departure) : most;
  const std::vector<double> energy = table.column("energy"), time = table.column("time");
  summary.energy_drift = drift(energy, reference);
  for (std::size_t n = 0; n < energy.size() && !summary.energy_beyond_since; ++n)
    if (std::abs(energy[n] - energy[0]) > summary.energy_bound * reference) summary.energy_beyond_since = time[n];
}

namespace {
/// The text " of the elastic ball" with the adjective of the ball. The text is empty if the adjective equals the name,
/// because this marks a system other than the ball.
std::string of_ball(const ModelSummary& summary) {
  return summary.adjective == summary.name ? "" : fmt::format(" of the {} ball", summary.adjective);
}
}  // namespace

std::string shared_motion_clause(const ModelSummary& summary) {
  const auto second = second_line(summary.frequency);
  if (!second) return {};
  const Line& first = summary.frequency.dominant();
  return fmt::format("two frequencies share the motion{}, omega = {:.4g} and, with {:.2g} of its amplitude, {:.4g}",
                     of_ball(summary), first.frequency, second->amplitude / first.amplitude, second->frequency);
}

std::string energy_clause(const ModelSummary& summary) {
  if (!summary.energy_beyond_since) return {};
  return fmt::format("the energy{} changes by up to {:.2g} %, and by more than {:.2g} % from t = {:.4g} on",
                     of_ball(summary), 100 * *summary.energy_drift, 100 * summary.energy_bound,
                     *summary.energy_beyond_since);
}

std::string failure_clause(const ModelSummary& summary) {
  if (summary.n_failed_intervals == 0) return {};
  return summary.n_failed_intervals == 1
             ? fmt::format("a step{} failed, and its interval was repeated with shorter ones", of_ball(summary))
             : fmt::format("steps{} failed {} times, and their intervals were repeated with shorter ones",
                           of_ball(summary), summary.n_failed_intervals);
}

std::string drift_in_words(double drift) {
  return drift <= round_off_drift ? "round-off" : fmt::format("{:.2g}", drift);
}

double momentum_reference(const io::Table& table, const std::vector<Vector3d>& momenta) {
  const double bound = momentum_bound(table), own = largest(norms(momenta));
  return own > spin_threshold * bound ? own : bound;
}

std::optional<double> momentum_drift(const io::Table& table, const Columns& columns) {
  if (!has_all(table, columns)) return std::nullopt;
  const auto momenta = read<Vector3d>(table, columns);
  return drift(momenta, momentum_reference(table, momenta));
}

Columns columns_of_angular_momentum(const io::Table& table) {
  return table.has_column("total_J1") ? Columns{"total_J1", "total_J2", "total_J3"} : Columns{"J1", "J2", "J3"};
}

MotionSummary summarize_motion(const ModelRunTable& run, const SceneFacts& facts) {
  const io::Table& table = run.table;
  MotionSummary s = begin_summary(run);
  if (has_all(table, Q_columns)) {
    s.has_state = true;
    const Deformation deformation(table, facts.resolution, s.model);
    const std::vector<double> time = table.column("time");
    const auto [i, j] = deformation.liveliest_component();
    s.signal = fmt::format("C{}{}", i + 1, j + 1);
    s.model.frequency = fit_component(deformation.component(i, j), time, s.model.deforms, facts.loads_rise);
    s.model.frequency_error = frequency_error(s.model.frequency, deformation, {i, j}, time, run.errors);
    s.model.load = load_of_line(s.model.frequency, facts.load_frequencies);
  }
  for (const auto& [name, label] : shown_ranges)
    if (table.has_column(name)) s.ranges.push_back(range_of(label, table.column(name)));
  if (has_all(table, {"kinetic", "elastic", "energy"}))
    set_energy_drift(table, energy_reference({&table}, facts.energy_unit), facts.tolerance, s.model);
  s.model.angular_momentum_drift = momentum_drift(table, columns_of_angular_momentum(table));
  s.model.circulation_drift = momentum_drift(table, {"Z1", "Z2", "Z3"});
  if (has_all(table, {"nonaffine_kinetic_fraction", "kinetic"}))
    s.mean_nonaffine_kinetic_fraction =
        weighted_mean(table.column("nonaffine_kinetic_fraction"), table.column("kinetic"));
  return s;
}

MotionSummary summarize_system(const ModelRunTable& run) {
  const io::Table& table = run.table;
  MotionSummary s = begin_summary(run);
  for (std::size_t c = 1; c < table.columns.size(); ++c)
    s.ranges.push_back(range_of(table.columns[c], table.column(table.columns[c])));
  if (table.has_column("energy")) {
    // The reference value `size` of the drift is the largest kinetic energy or the range of the potential energy. The
    // range is used because the zero of a potential is arbitrary. If `size` is round-off of the potential energy, the
    // system does not move. The reference value is then the largest magnitude of the potential energy.
    double size = 0, potential = 0;
    if (table.has_column("kinetic")) size = largest(table.column("kinetic"));
    if (table.has_column("potential")) {
      const ColumnRange range = range_of("", table.column("potential"));
      size = std::max(size, range.greatest - range.least);
      potential = std::max(std::abs(range.least), std::abs(range.greatest));
    }
    if (size < least_energy_part * potential) size = potential;
    if (size > 0) set_energy_drift(table, size, std::nullopt, s.model);
  }
  return s;
}

std::string terminal_table(const MotionSummary& s) {
  constexpr std::size_t most_ranges = 12;
  std::vector<std::string> lines{
      fmt::format("{:<38}{:>13}", fmt::format("{} samples, t = {:g} to {:g}", s.n_samples, s.first_time, s.last_time),
                  s.model.name)};
  const auto add = [&](std::string_view label, const std::optional<double>& value, int digits) {
    if (value) lines.push_back(fmt::format("{:<38}{:>13}", label, fmt::format("{:.{}g}", *value, digits)));
  };
  if (s.has_state) {
    const FrequencyFit& fit = s.model.frequency;
    const ErrorBar& error = s.model.frequency_error;
    if (fit) {
      lines.push_back(fmt::format("{:<38}{:>13.7g}  {}{}", "frequency of " + s.signal, fit.dominant().frequency,
                                  in_short(error), s.model.load ? ", that of a load" : ""));
      lines.push_back(fmt::format("{:<38}{}", "error of the frequency", parts_in_words(error)));
    } else
      lines.push_back(fmt::format("{:<38}{:>13}   ({})", "frequency of " + s.signal, "-", fit.reason));
    add("amplitude of C = Q^T Q", s.model.strain_amplitude, 3);
  }
  const auto add_drift = [&](std::string_view what, const std::optional<double>& drift) {
    if (!drift) return;
    lines.push_back(*drift <= round_off_drift
                        ? fmt::format("{:<38}constant to round-off", what)
                        : fmt::format("{:<38}{:>13.2g}", fmt::format("drift of the {}", what), *drift));
  };
  add_drift("energy", s.model.energy_drift);
  add_drift("angular momentum", s.model.angular_momentum_drift);
  add_drift("circulation", s.model.circulation_drift);
  add("non-affine part of the kinetic energy", s.mean_nonaffine_kinetic_fraction, 3);
  if (!s.ranges.empty())
    lines.push_back(fmt::format("{:<38}{:>13}{:>13}{:>13}", "", "least", "greatest", "at the end"));
  for (std::size_t i = 0; i < std::min(s.ranges.size(), most_ranges); ++i)
    lines.push_back(fmt::format("{:<38}{:>13.6g}{:>13.6g}{:>13.6g}", s.ranges[i].label, s.ranges[i].least,
                                s.ranges[i].greatest, s.ranges[i].last));
  if (s.ranges.size() > most_ranges)
    lines.push_back(
        fmt::format("columns not shown: {} (they are in {}.csv)", s.ranges.size() - most_ranges, s.model.name));
  for (const std::string& clause : {shared_motion_clause(s.model), energy_clause(s.model), failure_clause(s.model)})
    if (!clause.empty()) lines.push_back(fmt::format("{}.", clause));
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace pseudorigid::analysis
