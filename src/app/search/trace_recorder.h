#pragma once
/// Q at the samples of a run, for a search that asks for it (deformation_trace.h), from states as they come and from
/// the rows that an interrupted run has left.

#include <Eigen/Core>
#include <cmath>

#include "app/run/run_context.h"
#include "app/search/deformation_trace.h"
#include "io/csv.h"

namespace pseudorigid::app {

class TraceRecorder {
 public:
  /// `trace`: null if nobody asks for it.
  TraceRecorder(const RunContext& context, DeformationTrace* trace) : context_(context), trace_(trace) {}

  template <class ConfigurationOf>
  void note(double time, const ConfigurationOf& configuration) {
    if (trace_) (*trace_)[sample_at(time)] = configuration();
  }

  void take_up(const io::Table& rows) {
    if (!trace_ || !rows.has_column("Q11")) return;
    const std::size_t first = rows.column_index("Q11");
    for (std::size_t n = 0; n < rows.n_rows(); ++n)
      (*trace_)[sample_at(rows.row(n)[0])] = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(rows.row(n).data() + first);
  }

 private:
  long sample_at(double time) const {
    return std::lround(time / context_.scene.time.end * static_cast<double>(context_.scene.output.samples));
  }

  const RunContext& context_;
  DeformationTrace* trace_;
};

}  // namespace pseudorigid::app
