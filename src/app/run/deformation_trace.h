#pragma once
/// The history of the affine part Q of a motion, a 3×3 matrix, at the samples of a run. Two measures describe the
/// difference between a history Q and another history Q'. Their maxima are over the samples that both histories
/// contain:
///
///   largest   max_t max_ij |Q_ij − Q'_ij|,     relative   max_t |Q − Q'| / |Q|   (Frobenius).
///
/// Both measures are 0 if the histories do not have a common sample.

#include <Eigen/Core>
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
TraceDifference difference(const DeformationTrace& a, const DeformationTrace& b);

/// Conversion of a history to the array of a checkpoint, and back. The array has ten numbers for each sample: the
/// number of the sample, and the entries of Q column by column.
std::vector<double> numbers_of(const DeformationTrace& trace);
DeformationTrace trace_of(const std::vector<double>& numbers);

/// The history as a table with the columns time, in the user's units, and Q11 to Q33.
io::Table table_of(const DeformationTrace& trace, const RunContext& context);

}  // namespace pseudorigid::app
