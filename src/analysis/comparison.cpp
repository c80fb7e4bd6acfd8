#include "analysis/comparison.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "analysis/frequency_error.h"
#include "analysis/phase.h"
#include "analysis/samples.h"
#include "scene/user_error.h"

namespace pseudorigid::analysis {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;
/// The data of a comparison: the tables r of the model and c of the reference, their errors, and the result `out`, to
/// which the functions of this file add series.
struct Workshop {
  const io::Table& r;
  const io::Table& c;
  RunErrors of_model, of_reference;
  const ComparisonOptions& options;
  Comparison out;

  /// Whether both tables have the columns. If not, adds the name `what` of the quantity and the first missing column to
  /// `out.not_compared`.
  bool available(std::string_view what, const Columns& columns) {
    return has(r, out.model, what, columns) && has(c, out.reference, what, columns);
  }

  /// Whether the table of `model` has the columns. If not, adds the name `what` of the quantity and the first missing
  /// column to `out.not_compared`.
  bool has(const io::Table& table, const ModelSummary& model, std::string_view what, const Columns& columns) {
    const auto lacks = [&table](const std::string& name) { return !table.has_column(name); };
    const auto missing = std::ranges::find_if(columns, lacks);
    if (missing == columns.end()) return true;
    out.not_compared.push_back(fmt::format("{} (no column {} in {}.csv)", what, *missing, model.name));
    return false;
  }

  /// Adds the series of the quotients values/reference, with its maximum and root mean square. A quotient is 0 if its
  /// value is 0, even if `reference` is 0.
  void add(std::string name, double reference, std::vector<double> values) {
    Series s{.name = std::move(name), .reference = reference, .values = std::move(values)};
    double squares = 0;
    for (std::size_t n = 0; n < s.values.size(); ++n) {
      s.values[n] = ratio_or_zero(s.values[n], reference);
      squares += s.values[n] * s.values[n];
      if (n > 0 && std::abs(s.values[n]) <= s.max) continue;
      s.max = std::abs(s.values[n]);
      s.time_of_max = out.time[n];
    }
    s.rms = std::sqrt(squares / double(s.values.size()));
    out.series.push_back(std::move(s));
  }
};

/// Throws UserError if a table is empty or has a value that is not finite, or if the tables have different numbers of
/// samples.
void check_tables(const ModelRunTable& model, const ModelRunTable& reference) {
  const io::Table &r = model.table, &c = reference.table;
  const std::string files = fmt::format("{}.csv or {}.csv", model.name, reference.name);
  const auto all_finite = [](const io::Table& t) {
    return std::ranges::all_of(t.values, [](double v) { return std::isfinite(v); });
  };
  if (r.n_rows() == 0 || c.n_rows() == 0) throw UserError(files + " holds no sample to compare");
  if (!all_finite(r) || !all_finite(c)) throw UserError(files + " holds a value that is not finite");
  if (r.n_rows() != c.n_rows())
    throw UserError(
        fmt::format("the models were sampled at different times and cannot be compared: {}.csv has {} samples, {}.csv "
                    "{}",
                    model.name, r.n_rows(), reference.name, c.n_rows()));
}

/// The sample times of both tables. Throws UserError if a table is empty or has a value that is not finite. Also throws
/// it if the numbers of samples differ, or if two sample times differ by more than 1e-9 of the mean interval between
/// samples.
std::vector<double> common_times(const ModelRunTable& model, const ModelRunTable& reference) {
  check_tables(model, reference);
  constexpr double tolerance = 1e-9;
  std::vector<double> time = model.table.column("time");
  const std::vector<double> other = reference.table.column("time");
  const double interval = time.size() > 1 ? std::abs(time.back() - time.front()) / double(time.size() - 1) : 0;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (std::abs(time[n] - other[n]) > tolerance * interval)
      throw UserError(
          fmt::format("the models were sampled at different times and cannot be compared: sample {} is at t "
                      "= {} in {}.csv, t = {} in {}.csv",
                      n + 1, time[n], model.name, other[n], reference.name));
  return time;
}

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

/// Adds the series phase_difference, and its values after 1, 2, 5, 10, 20, 50 … periods of the reference. `r` and `c`
/// are the samples of the fitted component of C in both models. Adds nothing if one of the models does not have a phase
/// (phase.h).
void compare_phases(Workshop& w, const std::vector<double>& r, const std::vector<double>& c) {
  Comparison& out = w.out;
  const double interval = (out.time.back() - out.time.front()) / double(out.time.size() - 1);
  const double omega = out.reference.frequency.dominant().frequency;
  const std::vector<double> of_r = phase(r, interval, out.model.frequency.dominant().frequency),
                            of_c = phase(c, interval, omega);
  if (of_r.empty() || of_c.empty()) return;
  constexpr double turn = 2 * std::numbers::pi;
  std::vector<double> apart = each([](double a, double b) { return (a - b) / turn; }, of_r, of_c);
  const double whole_turns = std::nearbyint(apart.front());
  for (double& periods : apart) periods -= whole_turns;
  for (int decade = 1; decade <= 1'000'000; decade *= 10)
    for (const int n : {decade, 2 * decade, 5 * decade}) {
      const double position = n * turn / (omega * interval);  // number of sampling intervals in n periods
      const auto before = std::size_t(position);
      if (before + 1 < apart.size())
        out.phase_after_periods[n] = std::lerp(apart[before], apart[before + 1], position - double(before));
    }
  w.add("phase_difference", 1, std::move(apart));
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
  compare_phases(w, r.component(i, j), c.component(i, j));
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

/// Adds the series of the differences of Q and of C, the error of Q, and the frequencies. Adds the exact ratio of the
/// frequencies only if the table of the model shows that the body does not spin. If a table lacks a column of Q, only
/// adds an entry to `not_compared`.
void compare_states(Workshop& w) {
  if (!w.available("deformation and frequency", Q_columns)) return;
  Comparison& out = w.out;
  out.has_state = true;
  const double resolution = w.options.facts.resolution;
  const Deformation r(w.r, resolution, out.model), c(w.c, resolution, out.reference);
  const std::vector<double> apart = distances(c.Q, r.Q);
  const std::vector<double> sizes = norms(r.Q);
  w.add("q_difference", 1, each(ratio_or_zero, apart, sizes));
  out.error.space = w.of_reference.space;
  const auto of_both = [&](std::optional<double> RunErrors::*part) {
    const auto &a = w.of_model.*part, &b = w.of_reference.*part;
    return a && b ? std::optional(ratio_or_zero(3 * (*a + *b), std::ranges::min(sizes))) : std::nullopt;
  };
  out.error.time = of_both(&RunErrors::time);
  out.error.quadrature = of_both(&RunErrors::quadrature);
  // The divisors of the next two series are the larger departure and the larger strain amplitude of both models. If
  // neither ball moves, they are the resolution times |Q| and |C| of model r at the first sample.
  const double departure = std::max({out.model.departure, out.reference.departure, resolution * r.Q[0].norm()});
  const double amplitude =
      std::max({out.model.strain_amplitude, out.reference.strain_amplitude, resolution * r.C[0].norm()});
  w.add("q_difference_of_departure", departure, apart);
  w.add("strain_difference", amplitude, distances(c.C, r.C));
  fit_frequencies(w, r, c);
  const bool turning = !w.r.has_column(Qdot_columns.front()) || spins(w.r);
  if (!turning) out.exact_ratio = w.options.exact_frequency_ratio;
}

void compare_axes(Workshop& w) {
  const Columns axes{"a1", "a2", "a3"};
  if (w.available("semi-axes", axes))
    for (const std::string& axis : axes)
      w.add(axis + "_difference", 1,
            each([](double c, double r) { return ratio_or_zero(c - r, r); }, w.c.column(axis), w.r.column(axis)));
  if (w.available("volume ratio", {"volume_ratio"}))
    w.add("volume_ratio_difference", 1, each(std::minus{}, w.c.column("volume_ratio"), w.r.column("volume_ratio")));
}

void compare_energies(Workshop& w) {
  if (!w.available("energies", {"kinetic", "elastic", "energy"})) return;
  const double reference = energy_reference({&w.r, &w.c}, w.options.facts.energy_unit);
  for (const std::string name : {"kinetic", "elastic", "energy"})
    w.add(name + "_difference", reference, each(std::minus{}, w.c.column(name), w.r.column(name)));
  set_energy_drift(w.r, reference, w.options.facts.tolerance, w.out.model);
  set_energy_drift(w.c, reference, w.options.facts.tolerance, w.out.reference);
}

/// Compares the dissipated energies if both tables have them and at least one value is not 0.
void compare_dissipation(Workshop& w) {
  if (!w.r.has_column("dissipated") || !w.c.has_column("dissipated")) return;
  const std::vector<double> r = w.r.column("dissipated"), c = w.c.column("dissipated");
  if (const double reference = std::max(largest(r), largest(c)); reference > 0)
    w.add("dissipated_difference", reference, each(std::minus{}, c, r));
}

/// Compares the extreme principal stretches in the body, if both tables have them. For a pseudo-rigid body, these are
/// the principal stretches of Q.
void compare_stretches(Workshop& w) {
  for (const auto& [name, of_mean] : {std::pair{"max_stretch", "stretch1"}, std::pair{"min_stretch", "stretch3"}}) {
    const std::string of_model = w.r.has_column(name) ? name : of_mean;
    if (!w.r.has_column(of_model) || !w.c.has_column(name)) continue;
    w.add(fmt::format("{}_difference", name), 1,
          each([](double c, double r) { return ratio_or_zero(c - r, r); }, w.c.column(name), w.r.column(of_model)));
  }
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Bound of the relative error of the strain C − Id, if every entry of Q has the error e at most: 2 |Q| 3e / |C − Id|,
/// with the largest values of both norms over the samples.
double relative_error_of_strain(const io::Table& table, double e) {
  double size = 0, strain = 0;
  for (const Matrix3d& Q : read<Matrix3d>(table, Q_columns)) {
    size = std::max(size, Q.norm());
    strain = std::max(strain, (Q.transpose() * Q - Matrix3d::Identity()).norm());
  }
  return ratio_or_zero(6 * e * size, strain);
}

/// The error of the ratio `value` of the stress `name`, whose samples in the table of the reference are c
/// (StressRatio).
ErrorBar error_of_stress_ratio(const Workshop& w, const std::string& name, const std::vector<double>& c, double value) {
  ErrorBar error{.time = {}, .space = w.of_reference.space == 0.0 ? w.of_reference.space : std::nullopt};
  const OtherResolution* other = w.of_reference.other;
  if (other && other->samples.has_column(name) && other->samples.n_rows() >= c.size()) {
    // `each` uses the first c.size() samples. The comparison has fewer samples if model r stopped early.
    const double apart = root_mean_square(each(std::minus{}, c, other->samples.column(name)));
    const double relative = other->factor_of_stress * apart / root_mean_square(c);
    error.space = value * relative / (1 - std::min(relative, 0.5));
  }
  const auto part = [&](std::optional<double> RunErrors::*of_Q) -> std::optional<double> {
    const auto &a = w.of_model.*of_Q, &b = w.of_reference.*of_Q;
    if (!a || !b || !w.out.has_state) return {};
    // Without a strain of the affine motion, nothing follows from its error.
    const double relative = relative_error_of_strain(w.r, *a) + relative_error_of_strain(w.c, *b);
    return std::isfinite(relative) ? std::optional(value * relative) : std::nullopt;
  };
  error.time = part(&RunErrors::time);
  error.quadrature = part(&RunErrors::quadrature);
  return error;
}

/// Compares the von Mises stresses, if both tables have them. Stresses up to 1e-10 of the unit of stress are round-off.
void compare_stresses(Workshop& w) {
  const double round_off = 1e-10 * w.options.facts.stress_unit;
  for (const std::string name : {"mean_von_mises", "max_von_mises", "center_von_mises"}) {
    if (!w.r.has_column(name) || !w.c.has_column(name)) continue;
    const std::vector<double> r = w.r.column(name), c = w.c.column(name);
    const double reference = std::max(largest(r), largest(c));
    if (reference > round_off) w.add(name + "_difference", reference, each(std::minus{}, c, r));
    if (largest(c) <= round_off) continue;
    const double ratio = root_mean_square(r) / root_mean_square(c);
    w.out.stress_ratios[name] = {ratio, error_of_stress_ratio(w, name, c, ratio)};
  }
}

using Drift = std::optional<double> ModelSummary::*;

/// Adds the series of an angular momentum or a circulation, and sets the drifts of both models. If a table lacks one of
/// the columns, only adds an entry to `not_compared`.
void compare_momentum(Workshop& w, const std::string& name, const Columns& columns, Drift drift_of) {
  if (!w.available(name == "circulation" ? "circulation" : "angular momentum", columns)) return;
  const auto r = read<Vector3d>(w.r, columns), c = read<Vector3d>(w.c, columns);
  double reference = momentum_reference(w.r, r);
  if (reference == 0) reference = largest(norms(c));
  w.add(name + "_difference", reference, distances(c, r));
  w.out.model.*drift_of = drift(r, reference);
  w.out.reference.*drift_of = drift(c, reference);
}

/// Replaces the drift of the body's angular momentum by the drift of the total angular momentum if a table has the
/// columns of the total. Only the total of body and companions is constant.
void judge_total_momentum(Workshop& w) {
  for (const auto& [table, summary] : {std::pair{&w.r, &w.out.model}, std::pair{&w.c, &w.out.reference}})
    if (table->has_column("total_J1"))
      summary->angular_momentum_drift = momentum_drift(*table, columns_of_angular_momentum(*table));
}

void compare_multipliers(Workshop& w) {
  if (!w.available("multiplier", {"multiplier"})) return;
  const std::vector<double> r = w.r.column("multiplier"), c = w.c.column("multiplier");
  w.add("multiplier_difference", std::max(largest(r), largest(c)), each(std::minus{}, c, r));
}

/// Adds the series of the non-affine motion, its mean fraction of the kinetic energy, and the extremes of det F, from
/// the table of the reference. If the table lacks a column of the non-affine motion, only adds an entry to
/// `not_compared`.
void report_nonaffine_motion(Workshop& w) {
  const Columns columns{"nonaffine_kinetic_fraction", "nonaffine_displacement"};
  if (!w.has(w.c, w.out.reference, "non-affine motion", columns)) return;
  for (const std::string& name : columns) w.add(name, 1, w.c.column(name));
  if (w.c.has_column("min_jacobian")) w.out.min_jacobian = std::ranges::min(w.c.column("min_jacobian"));
  if (w.c.has_column("volume_error")) w.out.volume_error = std::ranges::max(w.c.column("volume_error"));
  if (w.c.has_column("max_volume_error")) w.out.max_volume_error = std::ranges::max(w.c.column("max_volume_error"));
  if (!w.c.has_column("kinetic")) return;
  w.out.mean_nonaffine_kinetic_fraction = weighted_mean(w.c.column(columns[0]), w.c.column("kinetic"));
}

}  // namespace

const Series* Comparison::find(std::string_view name) const {
  const auto found = std::ranges::find(series, name, &Series::name);
  return found == series.end() ? nullptr : &*found;
}

Comparison compare(const ModelRunTable& model, const ModelRunTable& reference, const ComparisonOptions& options) {
  Workshop w{model.table, reference.table, model.errors, reference.errors, options, {}};
  w.of_model.space = 0;
  w.of_model.other = nullptr;
  w.out.model.name = model.name, w.out.model.adjective = model.adjective;
  w.out.reference.name = reference.name, w.out.reference.adjective = reference.adjective;
  w.out.model.n_failed_intervals = model.n_failed_intervals;
  w.out.reference.n_failed_intervals = reference.n_failed_intervals;
  w.out.time = common_times(model, reference);
  w.out.surface_limit_time = options.surface_limit_time;
  compare_states(w);
  compare_axes(w);
  compare_energies(w);
  compare_dissipation(w);
  compare_stretches(w);
  compare_stresses(w);
  compare_momentum(w, "angular_momentum", {"J1", "J2", "J3"}, &ModelSummary::angular_momentum_drift);
  judge_total_momentum(w);
  compare_momentum(w, "circulation", {"Z1", "Z2", "Z3"}, &ModelSummary::circulation_drift);
  compare_multipliers(w);
  report_nonaffine_motion(w);
  return std::move(w.out);
}

}  // namespace pseudorigid::analysis
