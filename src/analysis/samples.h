#pragma once
/// Functions that read the samples of a run as Eigen objects and compute numbers from them.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "io/csv.h"

namespace pseudorigid::analysis {

using Columns = std::vector<std::string>;

inline const Columns Q_columns{"Q11", "Q12", "Q13", "Q21", "Q22", "Q23", "Q31", "Q32", "Q33"};
inline const Columns Qdot_columns{"Qdot11", "Qdot12", "Qdot13", "Qdot21", "Qdot22",
                                  "Qdot23", "Qdot31", "Qdot32", "Qdot33"};

/// Reads the columns `names` of a table, which must have at least one row. Throws UserError if the table lacks a
/// column. Returns an Eigen vector or matrix of fixed size for each row of the table. The columns, in the order of
/// `names`, are the entries of the vector or matrix, row by row.
template <class Value>
std::vector<Value> read(const io::Table& table, const Columns& names) {
  std::vector<Value> samples(table.n_rows());
  for (std::size_t k = 0; k < names.size(); ++k) {
    const std::size_t column = table.column_index(names[k]);
    const Eigen::Index n_columns = samples.front().cols(), i = Eigen::Index(k) / n_columns,
                       j = Eigen::Index(k) % n_columns;
    for (std::size_t n = 0; n < samples.size(); ++n) samples[n](i, j) = table.row(n)[column];
  }
  return samples;
}

/// Returns f(a[n], b[n], …) for each index n of one or more lists a, b, … of the same length.
template <class F, class First, class... Rest>
std::vector<double> each(F f, const std::vector<First>& first, const std::vector<Rest>&... rest) {
  std::vector<double> values(first.size());
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = f(first[n], rest[n]...);
  return values;
}

/// The norm of each sample: Euclidean for vectors, Frobenius for matrices.
template <class T>
std::vector<double> norms(const std::vector<T>& samples) {
  return each([](const T& x) { return x.norm(); }, samples);
}

/// The norm of a[n] − b[n] for each index n. Both lists must have the same length.
template <class T>
std::vector<double> distances(const std::vector<T>& a, const std::vector<T>& b) {
  return each([](const T& x, const T& y) { return (x - y).norm(); }, a, b);
}

/// The largest absolute value; 0 for an empty list.
inline double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

/// The quotient a/b, but 0 for a = 0, even if b = 0.
inline double ratio_or_zero(double a, double b) { return a == 0 ? 0 : a / b; }

/// The weighted mean Σ w v / Σ w of the values v with the weights w. The result is 0 if Σ w v = 0, even if Σ w = 0.
inline double weighted_mean(const std::vector<double>& values, const std::vector<double>& weights) {
  double total = 0, sum = 0;
  for (std::size_t n = 0; n < values.size(); ++n) total += weights[n], sum += values[n] * weights[n];
  return ratio_or_zero(sum, total);
}

/// The largest distance of a value from the first value, divided by `reference`. The result is 0 for an empty list. It
/// is also 0 if all values are equal, even if `reference` is 0.
inline double drift(const std::vector<double>& values, double reference) {
  return ratio_or_zero(largest(each([&](double v) { return v - values[0]; }, values)), reference);
}
inline double drift(const std::vector<Eigen::Vector3d>& values, double reference) {
  return ratio_or_zero(largest(each([&](const Eigen::Vector3d& x) { return (x - values[0]).norm(); }, values)),
                       reference);
}

}  // namespace pseudorigid::analysis
