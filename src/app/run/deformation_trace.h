#pragma once
/// The history of the affine part Q of a motion, a 3×3 matrix, at the samples of a run. Two measures describe the
/// difference between a history Q and another history Q'. The maxima are over the samples that both histories contain:
///
///   largest   max_t max_ij |Q_ij − Q'_ij|,     relative   max_t |Q − Q'| / |Q|   (Frobenius).
///
/// Both measures are 0 if the histories do not have a common sample.

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <vector>

#include "analysis/samples.h"
#include "app/run/run_context.h"
#include "io/csv.h"

namespace pseudorigid::app {

struct TraceDifference {
  double largest = 0, relative = 0;
};

/// Maps the number of a sample to Q.
using DeformationTrace = std::map<long, Eigen::Matrix3d>;

/// The difference between the history `a`, which is Q in the formulas above, and the history `b`, which is Q'.
inline TraceDifference difference(const DeformationTrace& a, const DeformationTrace& b) {
  TraceDifference d;
  for (const auto& [sample, Q] : a) {
    const auto other = b.find(sample);
    if (other == b.end()) continue;
    const Eigen::Matrix3d apart = Q - other->second;
    d.largest = std::max(d.largest, apart.cwiseAbs().maxCoeff());
    d.relative = std::max(d.relative, apart.norm() / Q.norm());
  }
  return d;
}

/// Conversion of a history to the array of a checkpoint, and back. The array has ten numbers for each sample: the
/// number of the sample, and the entries of Q column by column.
inline std::vector<double> numbers_of(const DeformationTrace& trace) {
  std::vector<double> numbers;
  for (const auto& [sample, Q] : trace) {
    numbers.push_back(static_cast<double>(sample));
    numbers.insert(numbers.end(), Q.data(), Q.data() + Q.size());
  }
  return numbers;
}
inline DeformationTrace trace_of(const std::vector<double>& numbers) {
  DeformationTrace trace;
  for (std::size_t i = 0; i + 9 < numbers.size(); i += 10)
    trace[static_cast<long>(numbers[i])] = Eigen::Matrix3d(numbers.data() + i + 1);
  return trace;
}

/// The history as a table with the columns time, in the user's units, and Q11 to Q33.
inline io::Table table_of(const DeformationTrace& trace, const RunContext& context) {
  io::Table table{.columns = {"time"}, .values = {}};
  table.columns.insert(table.columns.end(), analysis::Q_columns.begin(), analysis::Q_columns.end());
  for (const auto& [sample, Q] : trace) {
    table.values.push_back(context.time_of_sample(sample));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) table.values.push_back(Q(i, j));
  }
  return table;
}

}  // namespace pseudorigid::app
