#include "analysis/comparison.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "analysis/comparison_workshop.h"
#include "analysis/samples.h"
#include "scene/user_error.h"

namespace pseudorigid::analysis {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

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

/// The exact volume of an incompressible body is known, so that its error is known as well. Otherwise the error in time
/// of the volume is that of det Q, at most |cof Q| |δQ|.
void compare_volumes(Workshop& w) {
  const Columns volume{"volume_ratio"};
  if (!w.available("volume ratio", volume)) return;
  const std::vector<double> c = w.c.column(volume[0]), r = w.r.column(volume[0]);
  ErrorBar error = unknown;
  if (w.options.facts.incompressible) {
    const auto error_of = [](const std::vector<double>& ratios) {
      return largest(each([](double ratio) { return ratio - 1; }, ratios));
    };
    error = {.time = error_of(c) + error_of(r), .space = 0};
  } else if (w.out.has_state) {
    double cofactor = 0;
    for (const io::Table* table : {&w.r, &w.c})
      for (const Matrix3d& Q : read<Matrix3d>(*table, Q_columns))
        cofactor = std::max(cofactor, Q.norm() * Q.norm() / std::numbers::sqrt3);  // |cof Q| ≤ |Q|²/√3
    error = w.errors.of_function_of_Q(cofactor);
    error.space = w.errors.of_quantity({.columns = volume}, 1).space;
  }
  w.add("volume_ratio_difference", 1, each(std::minus{}, c, r), error);
}

/// Adds the series of the semi-axes, which are r times the singular values of Q, with the radius r of the ball.
void compare_axes(Workshop& w) {
  const Columns axes{"a1", "a2", "a3"};
  if (w.available("semi-axes", axes)) {
    const auto a = read<Vector3d>(w.r, axes);
    const double radius = w.out.has_state ? a[0].norm() / read<Matrix3d>(w.r, Q_columns)[0].norm() : 0;
    for (const std::string& axis : axes) {
      const std::vector<double> of_c = w.c.column(axis), of_r = w.r.column(axis);
      const double lipschitz = radius / std::ranges::min(of_r);
      const ErrorBar error = w.out.has_state ? w.errors.of_function_of_Q(lipschitz) : unknown;
      w.add(axis + "_difference", 1, each([](double c, double r) { return ratio_or_zero(c - r, r); }, of_c, of_r),
            error, w.errors.of_function_of_model(lipschitz));
    }
  }
  compare_volumes(w);
}

void compare_energies(Workshop& w) {
  if (!w.available("energies", {"kinetic", "elastic", "energy"})) return;
  const double reference = energy_reference({&w.r, &w.c}, w.options.facts.energy_unit);
  const auto error_of = [&](const std::string& name, bool constant) {
    return w.errors.of_quantity({.columns = {name}, .n_strains = 2, .constant = constant}, reference);
  };
  const ErrorBar of_reference = sum(error_of("kinetic", false), error_of("elastic", false));
  for (const std::string name : {"kinetic", "elastic", "energy"})
    w.add(name + "_difference", reference, each(std::minus{}, w.c.column(name), w.r.column(name)),
          error_of(name, name == "energy"), of_reference);
  set_energy_drift(w.r, reference, w.options.facts.tolerance, w.out.model);
  set_energy_drift(w.c, reference, w.options.facts.tolerance, w.out.reference);
}

/// Compares the dissipated energies if both tables have them and at least one value is not 0.
void compare_dissipation(Workshop& w) {
  if (!w.r.has_column("dissipated") || !w.c.has_column("dissipated")) return;
  const std::vector<double> r = w.r.column("dissipated"), c = w.c.column("dissipated");
  const double reference = std::max(largest(r), largest(c));
  if (reference == 0) return;
  const ErrorBar error = w.errors.of_quantity({.columns = {"dissipated"}, .n_strains = 2}, reference);
  w.add("dissipated_difference", reference, each(std::minus{}, c, r), error, error);
}

/// Compares the extreme principal stretches in the body, if both tables have them. For a pseudo-rigid body, these are
/// the principal stretches of Q.
void compare_stretches(Workshop& w) {
  for (const auto& [name, of_mean] : {std::pair{"max_stretch", "stretch1"}, std::pair{"min_stretch", "stretch3"}}) {
    const std::string of_model = w.r.has_column(name) ? name : of_mean;
    if (!w.r.has_column(of_model) || !w.c.has_column(name)) continue;
    const std::vector<double> r = w.r.column(of_model);
    const ErrorBar error = w.errors.of_quantity(
        {.columns = {name}, .of_model = {of_model}, .undeformed = 1, .factor = &OtherResolution::factor_of_stress},
        std::ranges::min(r));
    w.add(fmt::format("{}_difference", name), 1,
          each([](double c, double r) { return ratio_or_zero(c - r, r); }, w.c.column(name), r), error, error);
  }
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
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
    if (reference > round_off) {
      const ErrorBar error =
          w.errors.of_quantity({.columns = {name}, .factor = &OtherResolution::factor_of_stress}, reference);
      w.add(name + "_difference", reference, each(std::minus{}, c, r), error, error);
    }
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
  const ErrorBar error =
      w.errors.of_quantity({.columns = columns, .n_strains = 2, .constant = w.options.facts.is_free}, reference);
  w.add(name + "_difference", reference, distances(c, r), error, error);
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
  const double reference = std::max(largest(r), largest(c));
  const ErrorBar error = w.errors.of_quantity({.columns = {"multiplier"}, .n_strains = 2}, reference);
  w.add("multiplier_difference", reference, each(std::minus{}, c, r), error, error);
}

/// Sets the mean of the non-affine fraction η of the kinetic energy K, weighted by K, and its error. In time, K and ηK
/// have the relative error 2ε of energies, of their largest values.
void set_mean_nonaffine_fraction(Workshop& w) {
  const std::string fraction = "nonaffine_kinetic_fraction";
  const std::size_t n = w.c.n_rows();
  const auto mean_of = [&](const io::Table& table) {
    std::vector<double> eta = table.column(fraction), K = table.column("kinetic");
    eta.resize(n), K.resize(n);  // the other discretisation has more samples if model r stopped early
    return weighted_mean(eta, K);
  };
  const std::vector<double> eta = w.c.column(fraction), K = w.c.column("kinetic");
  const double mean = mean_of(w.c);
  w.out.mean_nonaffine_kinetic_fraction = mean;
  double sum_of_K = 0;
  for (const double value : K) sum_of_K += value;
  const double most = largest(each(std::multiplies{}, eta, K)) + mean * largest(K);
  const auto from = [&](const std::optional<double>& e) -> std::optional<double> {
    if (e == 0.0 || most == 0) return 0;
    if (!e || !w.out.has_state) return {};
    return if_finite(2 * relative_error_of_strain(w.c, *e) * most * double(n) / sum_of_K);
  };
  ErrorBar& error = w.out.mean_nonaffine_error;
  error = {.time = from(w.of_reference.time), .space = {}, .quadrature = from(w.of_reference.quadrature)};
  const OtherResolution* other = w.of_reference.other;
  if (!other)
    error.space = w.of_reference.space == 0.0 ? w.of_reference.space : std::nullopt;
  else if (other->samples.n_rows() >= n && other->samples.has_column(fraction) && other->samples.has_column("kinetic"))
    error.space = if_finite(other->factor * std::abs(mean - mean_of(other->samples)));
}

/// Adds the series of the non-affine motion, its mean fraction of the kinetic energy, and the extremes of det F, from
/// the table of the reference. If the table lacks a column of the non-affine motion, only adds an entry to
/// `not_compared`.
void report_nonaffine_motion(Workshop& w) {
  const Columns columns{"nonaffine_kinetic_fraction", "nonaffine_displacement"};
  if (!w.has(w.c, w.out.reference, "non-affine motion", columns)) return;
  // The fraction has narrow peaks when the affine motion turns back, whose values nothing bounds.
  w.add(columns[0], 1, w.c.column(columns[0]), unknown);
  w.add(columns[1], 1, w.c.column(columns[1]),
        w.errors.of_quantity({.columns = {columns[1]}, .in_both_models = false}, 1));
  if (w.c.has_column("min_jacobian")) w.out.min_jacobian = std::ranges::min(w.c.column("min_jacobian"));
  if (w.c.has_column("volume_error")) w.out.volume_error = std::ranges::max(w.c.column("volume_error"));
  if (w.c.has_column("max_volume_error")) w.out.max_volume_error = std::ranges::max(w.c.column("max_volume_error"));
  if (w.c.has_column("kinetic")) set_mean_nonaffine_fraction(w);
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
