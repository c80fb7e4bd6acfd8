#include "app/figures/figure_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace pseudorigid::app {

namespace {

/// Sets `motion` to the small motion of the scene about a figure with its stability. Fails if the figure has no such
/// motion.
mechanics::Status find_motion(const mechanics::FigureMember& member, const std::optional<int>& number,
                              RateOfClass& motion) {
  const std::vector<RateOfClass> rates = rates_by_frequency(member);
  if (!number) {
    if (!fastest_growing(member)) return at_entry("Initial state/Mode", "no small motion about the figure grows");
    motion = *std::ranges::max_element(rates, {}, [](const RateOfClass& rate) { return rate.s.real(); });
    return {};
  }
  if (static_cast<std::size_t>(*number) > rates.size())
    return at_entry("Initial state/Mode", fmt::format("the figure has {} rates of small motions", rates.size()));
  motion = rates[static_cast<std::size_t>(*number) - 1];
  return {};
}

}  // namespace

mechanics::Status at_entry(std::string_view path, std::string_view reason) {
  return mechanics::Status::failure(fmt::format("{}: {}", path, reason));
}

mechanics::Status find_own_figure(const scene::Scene& scene, const mechanics::FigureEquations& equations,
                                  const mechanics::StabilityOfFigure& analyse, OwnFigure& start) {
  const std::optional<int>& number = scene.initial_state.mode;
  const scene::Scene::InitialState::Origin& origin = *scene.initial_state.origin;
  const auto analyse_if_needed = [&](const auto& figure, auto only, auto& classes) {
    return number == 0 ? mechanics::Status() : analyse(figure, only, classes);
  };
  mechanics::FigureFinder finder(equations, analyse_if_needed, family_of_figures(scene, origin.family));
  if (const auto status = finder.member(origin.parameter, start.member); !status)
    return at_entry("Initial state/Figure", status.reason());
  return number == 0 ? mechanics::Status() : find_motion(start.member, number, start.motion);
}

mechanics::Status check_symmetry_of_motion(double lost) {
  constexpr double round_off = 1e-9;
  if (lost <= round_off) return {};
  return at_entry("Continuum/Symmetry", "its planes are not symmetry planes of the small motion; use auto");
}

}  // namespace pseudorigid::app
