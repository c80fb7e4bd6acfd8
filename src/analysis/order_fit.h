#pragma once
/// Order of convergence from errors at several step or mesh sizes.
///
///   log e = log C + p log h,   least squares over the points between the coarsest and the round-off plateau.
///
/// The rule that finds the plateau, with local slopes p_i = log(e_i/e_{i+1}) / log(h_i/h_{i+1}), h decreasing:
///   1. points without a positive finite h and e are left out (an error of zero lies below any plateau);
///   2. the reference slope is the upper quartile of the p_i;
///   3. from the finest point on, points are dropped while the slope that leads to them is below half the reference;
///   4. the largest error dropped is the plateau's height, and points less than `margin` times above it, whose error is
///      in part round-off, are dropped as well. A point at the margin 30 biases one local slope by at most 0.05.

#include <cstddef>
#include <limits>
#include <span>

namespace pseudorigid::analysis {

struct ErrorPoint {
  double h = 0;
  double error = 0;
};

struct OrderFit {
  double order = std::numeric_limits<double>::quiet_NaN();          ///< p
  double constant = std::numeric_limits<double>::quiet_NaN();       ///< C
  double standard_error = std::numeric_limits<double>::infinity();  ///< of p; two points determine none
  std::size_t n_used = 0;                                           ///< points of the fit, the coarsest ones
  double plateau = 0;                                               ///< its height, 0 if none was met

  /// False if fewer than two points converge, as for a method that is exact up to round-off.
  explicit operator bool() const { return n_used >= 2; }
};

/// Points in any order; two of them with the same h are a std::invalid_argument.
OrderFit fit_order(std::span<const ErrorPoint> points, double margin = 30);

}  // namespace pseudorigid::analysis
