#pragma once
/// The observables that the output requests from a model, and extreme values over the quadrature points of the body.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <vector>

#include "observables/quantities.h"

namespace pseudorigid::mechanics {

/// A column with an extreme value over the quadrature points of the whole body: the largest value(F) if `largest` is
/// true, otherwise the least value(F). F is the deformation gradient at a point. `bound` saves most evaluations of a
/// costly value: bound(F) is cheap, and it is at least value(F) if `largest` is true, otherwise at most value(F).
struct OverPoints {
  bool largest;
  double (*value)(const Eigen::Matrix3d& F);
  double (*bound)(const Eigen::Matrix3d& F);
};

/// The groups of observables that the output requests. Models need not compute the other groups. `over_points` contains
/// the requested columns of the type OverPoints.
struct ObservableRequest : Quantities {
  std::vector<OverPoints> over_points{};
};

/// Returns one value for each entry of request.over_points. The caller provides the function `least`: least(value)
/// returns the least value(F) over the quadrature points of the whole body. A point has its bound in place of its value
/// if the bound shows that another point has the extreme value.
template <class Least>
std::vector<double> observe_over_points(const ObservableRequest& request, const Least& least) {
  std::vector<double> values;
  for (const OverPoints& asked : request.over_points) {
    const double sign = asked.largest ? -1 : 1;
    double least_so_far = std::numeric_limits<double>::infinity();
    values.push_back(sign * least([&](const Eigen::Matrix3d& F) {
                       const double bound = sign * asked.bound(F);
                       if (bound > least_so_far) return bound;
                       const double value = sign * asked.value(F);
                       least_so_far = std::min(least_so_far, value);
                       return value;
                     }));
  }
  return values;
}

}  // namespace pseudorigid::mechanics
