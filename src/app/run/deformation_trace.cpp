#include "app/run/deformation_trace.h"

#include <Eigen/Core>
#include <algorithm>
#include <map>
#include <vector>

#include "analysis/samples.h"
#include "app/run/run_context.h"
#include "io/csv.h"

namespace pseudorigid::app {

TraceDifference difference(const DeformationTrace& a, const DeformationTrace& b) {
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

std::vector<double> numbers_of(const DeformationTrace& trace) {
  std::vector<double> numbers;
  for (const auto& [sample, Q] : trace) {
    numbers.push_back(static_cast<double>(sample));
    numbers.insert(numbers.end(), Q.data(), Q.data() + Q.size());
  }
  return numbers;
}

DeformationTrace trace_of(const std::vector<double>& numbers) {
  DeformationTrace trace;
  for (std::size_t i = 0; i + 9 < numbers.size(); i += 10)
    trace[static_cast<long>(numbers[i])] = Eigen::Matrix3d(numbers.data() + i + 1);
  return trace;
}

io::Table table_of(const DeformationTrace& trace, const RunContext& context) {
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
