#pragma once
/// Q at the samples of a run, and how far two runs are apart: over the samples that both have,
///
///   largest   max_t max_ij |Q_ij − Q'_ij|,     relative   max_t |Q − Q'| / |Q|   (Frobenius).

#include <Eigen/Core>
#include <algorithm>
#include <map>

namespace pseudorigid::app {

struct TraceDifference {
  double largest = 0, relative = 0;
};

/// Sample → Q.
using DeformationTrace = std::map<long, Eigen::Matrix3d>;

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

}  // namespace pseudorigid::app
