#include "analysis/order_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

namespace pseudorigid::analysis {
namespace {

using Points = std::vector<ErrorPoint>;

/// The usable points, coarsest first.
Points usable(std::span<const ErrorPoint> points) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  Points kept;
  for (const ErrorPoint& p : points)
    if (positive(p.h) && positive(p.error)) kept.push_back(p);
  std::ranges::sort(kept, std::greater{}, &ErrorPoint::h);
  if (std::ranges::adjacent_find(kept, {}, &ErrorPoint::h) != kept.end())
    throw std::invalid_argument("fit_order: two points have the same h");
  return kept;
}

/// Local slope that leads from point i to the finer point i+1.
double slope(const Points& p, std::size_t i) {
  return std::log(p[i].error / p[i + 1].error) / std::log(p[i].h / p[i + 1].h);
}

double reference_slope(const Points& points) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) slopes.push_back(slope(points, i));
  const auto upper = slopes.begin() + std::lround(0.75 * double(slopes.size() - 1));
  std::ranges::nth_element(slopes, upper);
  return *upper;
}

/// Removes the plateau and returns its height.
double drop_plateau(Points& points, double margin) {
  const double reference = reference_slope(points);
  double height = 0;
  while (points.size() > 1 && !(slope(points, points.size() - 2) >= 0.5 * reference && reference > 0)) {
    height = std::max(height, points.back().error);
    points.pop_back();
  }
  const auto contaminated = [&](const ErrorPoint& p) { return p.error < margin * height; };
  points.erase(std::ranges::find_if(points, contaminated), points.end());
  return height;
}

}  // namespace

OrderFit fit_order(std::span<const ErrorPoint> given, double margin) {
  OrderFit fit;
  Points points = usable(given);
  if (points.size() < 2) return fit;
  fit.plateau = drop_plateau(points, margin);
  if (points.size() < 2) return fit;

  const double n = double(points.size());
  double x_mean = 0, y_mean = 0, xx = 0, xy = 0, squares = 0;
  for (const auto& [h, e] : points) x_mean += std::log(h) / n, y_mean += std::log(e) / n;
  for (const auto& [h, e] : points) {
    xx += std::pow(std::log(h) - x_mean, 2);
    xy += (std::log(h) - x_mean) * (std::log(e) - y_mean);
  }
  fit.n_used = points.size();
  fit.order = xy / xx;
  fit.constant = std::exp(y_mean - fit.order * x_mean);
  for (const auto& [h, e] : points) squares += std::pow(std::log(e) - y_mean - fit.order * (std::log(h) - x_mean), 2);
  if (points.size() > 2) fit.standard_error = std::sqrt(squares / (n - 2) / xx);
  return fit;
}

}  // namespace pseudorigid::analysis
