#include "mechanics/equilibria/figures.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pseudorigid::mechanics {

void add(double factor, const EquilibriumFigure& change, EquilibriumFigure& figure) {
  figure.x += factor * change.x;
  figure.lambda += factor * change.lambda;
  figure.drive += factor * change.drive;
}

Status FigureEquations::solve(const FigureCondition& condition, EquilibriumFigure& figure) const {
  if (Status status = newton(condition, figure); !status) return status;
  return complete(figure);
}

Status FigureEquations::follow(double from, const FigureCondition& condition, EquilibriumFigure& figure) const {
  constexpr double shortest = 1.0 / 512;  // shortest step, as a fraction of the distance between the parameters
  // The largest changes of the logarithm of a ratio of axes, and of an entry of x in a prediction, so that the search
  // does not jump to other branches.
  constexpr double largest_ratio = 0.25, largest_move = 0.25;
  constexpr double of_prediction = 1e-5;  // relative tolerance of a prediction
  constexpr double astray = 0.5;  // bound of the distance between solution and prediction, as a fraction of the step
  const double way = condition.value - from;
  if (!std::isfinite(way)) return Status::failure("there is no figure with this parameter");
  const double longest = condition.parameter == FigureParameter::drive ? std::abs(way) : largest_ratio;
  double at = from, step = std::min(std::abs(way), longest);
  EquilibriumFigure along;
  bool is_known = false;  // whether `along` is the tangent at `figure`
  while (at != condition.value) {
    if (!is_known) along = tangent({condition.parameter, at}, figure, of_prediction);
    is_known = true;
    const double rate = along.x.lpNorm<Eigen::Infinity>();
    if (std::isfinite(rate) && rate * step > largest_move)
      step = std::max(largest_move / rate, shortest * std::abs(way));
    const bool is_last = step >= std::abs(condition.value - at);
    const double signed_step = is_last ? condition.value - at : std::copysign(step, way);
    const double next = is_last ? condition.value : at + signed_step;
    EquilibriumFigure predicted = figure;
    add(signed_step, along, predicted);
    EquilibriumFigure found = predicted;
    Status status = Status::failure("the family ends here, or turns back");
    if (predicted.x.allFinite() && is_admissible(predicted.x)) {
      Status end = newton({condition.parameter, next}, found);
      const double off = (found.x - predicted.x).norm(), moved = (predicted.x - figure.x).norm();
      if (!end || off <= astray * moved + error_of_solver() * predicted.x.norm()) status = std::move(end);
    }
    if (status) {
      figure = found;
      at = next;
      step = std::min(2 * std::abs(signed_step), longest);
      is_known = false;
    } else {
      step = std::abs(signed_step) / 2;
      if (step < shortest * std::abs(way)) return status;
    }
  }
  return complete(figure);
}

}  // namespace pseudorigid::mechanics
