#pragma once
/// Order of convergence from errors at several step or mesh sizes.
///
///   log e = log C + p log h,   least squares over the points between the coarsest and the round-off plateau.
///
/// The rule that finds the plateau, with local slopes p(i,j) = log(e_i/e_j) / log(h_i/h_j), h decreasing:
///   1. points without a positive finite h and e are left out (an error of zero lies below any plateau);
///   2. the reference slope is the upper quartile of the p(i,i+1);
///   3. the range ends before the first point j that does not fall: p(j−1,j) below one half of the reference and
///      p(j−2,j) below three quarters of it (the second clause forgives a neighbour that is too good by chance);
///   4. the largest error from there on is the plateau's height, and points less than `margin` times above it, whose
///      error is in part round-off, are dropped as well. A point at the margin 30 biases one local slope by at most
///      0.05 if h is halved.

#include <cstddef>
#include <limits>
#include <span>

namespace pseudorigid::testing {

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

}  // namespace pseudorigid::testing
