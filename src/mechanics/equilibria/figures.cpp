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
  constexpr double longest = 0.25;  // largest step of the parameter, so that the search does not jump to other branches
  constexpr double astray = 0.5;    // bound of the distance between solution and prediction, as a fraction of the step
  const double way = condition.value - from;
  double at = from, step = std::copysign(std::min(std::abs(way), longest), way);
  while (at != condition.value) {
    const bool is_last = std::abs(step) >= std::abs(condition.value - at);
    if (is_last) step = condition.value - at;
    const double next = is_last ? condition.value : at + step;
    EquilibriumFigure predicted = figure;
    add(step, tangent({condition.parameter, at}, figure), predicted);
    EquilibriumFigure found = predicted;
    Status status = Status::failure("the family ends here, or turns back");
    if (predicted.x.allFinite() && is_admissible(predicted.x)) {
      Status end = newton({condition.parameter, next}, found);
      const double off = (found.x - predicted.x).norm(), moved = (predicted.x - figure.x).norm();
      if (!end || off <= astray * moved + error_of_solver()) status = std::move(end);
    }
    if (status) {
      figure = found;
      at = next;
      step = std::copysign(std::min(2 * std::abs(step), longest), way);
    } else {
      step /= 2;
      if (std::abs(step) < shortest * std::abs(way)) return status;
    }
  }
  return complete(figure);
}

}  // namespace pseudorigid::mechanics
