#include "analysis/difference_error.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace pseudorigid::analysis {
namespace {

using Eigen::Matrix3d;

/// Samples of a vector of any number of components.
std::vector<Eigen::VectorXd> vectors(const io::Table& table, const Columns& columns) {
  std::vector<Eigen::VectorXd> samples(table.n_rows(), Eigen::VectorXd(Eigen::Index(columns.size())));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::size_t column = table.column_index(columns[k]);
    for (std::size_t n = 0; n < samples.size(); ++n) samples[n][Eigen::Index(k)] = table.row(n)[column];
  }
  return samples;
}

bool has(const io::Table& table, const Columns& columns) {
  return std::ranges::all_of(columns, [&](const std::string& name) { return table.has_column(name); });
}

/// max_t |x − x₀|
double size_of(const io::Table& table, const Columns& columns, double undeformed) {
  return largest(each([&](const Eigen::VectorXd& x) { return (x.array() - undeformed).matrix().norm(); },
                      vectors(table, columns)));
}

}  // namespace

double relative_error_of_strain(const io::Table& table, double e) {
  double size = 0, strain = 0;
  for (const Matrix3d& Q : read<Matrix3d>(table, Q_columns)) {
    size = std::max(size, Q.norm());
    strain = std::max(strain, (Q.transpose() * Q - Matrix3d::Identity()).norm());
  }
  return ratio_or_zero(6 * e * size, strain);
}

ErrorBar DifferenceErrors::of_function_of_Q(double lipschitz) const {
  const auto of_both = [&](Part part) {
    const auto &a = of_model_.*part, &b = of_reference_.*part;
    return a && b ? if_finite(3 * lipschitz * (*a + *b)) : std::nullopt;
  };
  ErrorBar bar{.time = of_both(&RunErrors::time), .space = {}, .quadrature = of_both(&RunErrors::quadrature)};
  if (of_reference_.space)
    bar.space = if_finite(lipschitz * *of_reference_.space * largest(norms(read<Matrix3d>(c_, Q_columns))));
  return bar;
}

ErrorBar DifferenceErrors::of_function_of_model(double lipschitz) const {
  const auto part = [&](Part of_Q) {
    const auto& e = of_model_.*of_Q;
    return e ? if_finite(3 * lipschitz * *e) : std::nullopt;
  };
  return {.time = part(&RunErrors::time), .space = 0, .quadrature = part(&RunErrors::quadrature)};
}

ErrorBar DifferenceErrors::of_quantity(const ComparedQuantity& quantity, double divisor) const {
  const auto over_divisor = [divisor](const std::optional<double>& error) {
    return error ? if_finite(ratio_or_zero(*error, divisor)) : std::nullopt;
  };
  const auto in_time = quantity.constant ? drift_of_both(quantity) : relative_to_strain(quantity, &RunErrors::time);
  return {.time = over_divisor(in_time),
          .space = over_divisor(in_space(quantity)),
          .quadrature = over_divisor(relative_to_strain(quantity, &RunErrors::quadrature))};
}

std::optional<double> DifferenceErrors::relative_to_strain(const ComparedQuantity& quantity, Part part) const {
  const auto of_one = [&](const io::Table& table, const RunErrors& errors,
                          const Columns& columns) -> std::optional<double> {
    const auto e = errors.*part;
    if (e == 0.0) return 0;
    if (!e || !has(table, Q_columns)) return {};
    const double size = size_of(table, columns, quantity.undeformed);
    return size == 0 ? 0 : quantity.n_strains * relative_error_of_strain(table, *e) * size;
  };
  const auto of_reference = of_one(c_, of_reference_, quantity.columns);
  if (!quantity.in_both_models || !of_reference) return of_reference;
  const auto of_model = of_one(r_, of_model_, quantity.of_model.empty() ? quantity.columns : quantity.of_model);
  return of_model ? if_finite(*of_model + *of_reference) : std::nullopt;
}

/// max_t |x − x(0)| of both models
std::optional<double> DifferenceErrors::drift_of_both(const ComparedQuantity& quantity) const {
  double sum = 0;
  for (const io::Table* table : {&r_, &c_}) {
    const auto x = vectors(*table, quantity.columns);
    sum += largest(each([&](const Eigen::VectorXd& value) { return (value - x.front()).norm(); }, x));
  }
  return sum;
}

/// f max_t |x_c − x'_c|
std::optional<double> DifferenceErrors::in_space(const ComparedQuantity& quantity) const {
  const OtherResolution* other = of_reference_.other;
  if (!other) return of_reference_.space == 0.0 ? of_reference_.space : std::nullopt;
  if (!has(other->samples, quantity.columns) || other->samples.n_rows() < c_.n_rows()) return {};
  // The comparison has fewer samples if model r stopped early. `distances` uses those of the reference.
  const auto apart = distances(vectors(c_, quantity.columns), vectors(other->samples, quantity.columns));
  if (!std::ranges::all_of(apart, [](double value) { return std::isfinite(value); })) return {};
  return other->*quantity.factor * largest(apart);
}

}  // namespace pseudorigid::analysis
