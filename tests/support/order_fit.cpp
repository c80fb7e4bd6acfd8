#include "support/order_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

namespace pseudorigid::testing {
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

double slope(const ErrorPoint& coarse, const ErrorPoint& fine) {
  return std::log(coarse.error / fine.error) / std::log(coarse.h / fine.h);
}

double reference_slope(const Points& points) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) slopes.push_back(slope(points[i], points[i + 1]));
  const auto upper = slopes.begin() + std::lround(0.75 * double(slopes.size() - 1));
  std::ranges::nth_element(slopes, upper);
  return *upper;
}

bool falls(const Points& points, std::size_t j, double reference) {
  return slope(points[j - 1], points[j]) >= 0.5 * reference ||
         (j >= 2 && slope(points[j - 2], points[j]) >= 0.75 * reference);
}

/// Removes the plateau and returns its height.
double drop_plateau(Points& points, double margin) {
  const double reference = reference_slope(points);
  std::size_t n_falling = 1;
  while (reference > 0 && n_falling < points.size() && falls(points, n_falling, reference)) ++n_falling;
  double height = 0;
  for (; points.size() > n_falling; points.pop_back()) height = std::max(height, points.back().error);
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

}  // namespace pseudorigid::testing
