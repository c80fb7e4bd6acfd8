#include "app/figures/figure_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace pseudorigid::app {

mechanics::Status find_own_figure(const scene::Scene& scene, const mechanics::FigureEquations& equations,
                                  const mechanics::StabilityOfFigure& analyse, OwnFigure& start) {
  const std::optional<int>& number = scene.initial_state.mode;
  const scene::Scene::InitialState::Origin& origin = *scene.initial_state.origin;
  const auto analyse_if_needed = [&](const auto& figure, auto& classes) {
    return number == 0 ? mechanics::Status() : analyse(figure, classes);
  };
  mechanics::FigureFinder finder(equations, analyse_if_needed, family_of_figures(scene, origin.family));
  if (auto status = finder.member(origin.parameter, start.member); !status) return status;
  if (number == 0) return {};
  const std::vector<RateOfClass> rates = rates_by_frequency(start.member);
  if (!number) {
    if (!fastest_growing(start.member)) return mechanics::Status::failure("no small motion about the figure grows");
    start.motion = *std::ranges::max_element(rates, {}, [](const RateOfClass& rate) { return rate.s.real(); });
    return {};
  }
  if (static_cast<std::size_t>(*number) > rates.size())
    return mechanics::Status::failure(fmt::format("the figure has {} rates of small motions", rates.size()));
  start.motion = rates[static_cast<std::size_t>(*number) - 1];
  return {};
}

mechanics::Status check_symmetry_of_start(double lost) {
  constexpr double round_off = 1e-9;
  if (lost <= round_off) return {};
  return mechanics::Status::failure(
      "the small motion does not have the planes of Continuum/Symmetry as symmetry planes; use auto");
}

}  // namespace pseudorigid::app
