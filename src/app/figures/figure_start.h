#pragma once
/// The start of a motion from the model's own figure of a family (Initial state/Figure = own), with a small motion
/// about this figure (Initial state/Mode). The figure has the positions φ and the spin Ω. The small motion in the
/// turning frame is Re(y exp(st)), with the complex field y. In the inertial frame, the motion starts at
///
///   x = φ + Re y,   v = Ω ê₃×x + Re(s y).

#include <cmath>
#include <complex>
#include <string_view>

#include "app/figures/figure_families.h"

namespace pseudorigid::app {

/// The figure from which a motion starts, and its small motion. The family and the parameter of the figure are those of
/// scene.initial_state.origin.
struct OwnFigure {
  mechanics::FigureMember member;
  RateOfClass motion{};  ///< rate and class of the small motion; not set without a small motion

  double spin() const { return std::sqrt(std::max(member.figure.drive, 0.0)); }
};

/// The failure of a start with the entry of the scene that it concerns, as in the messages of UserError.
mechanics::Status at_entry(std::string_view path, std::string_view reason);

/// Sets `start` to the figure from which the motion of the scene starts. `analyse` computes the stability of a figure,
/// and is called only if the scene has a small motion. Fails if the body with these equations does not have the figure
/// or the small motion. The reason names the entry.
mechanics::Status find_own_figure(const scene::Scene& scene, const mechanics::FigureEquations& equations,
                                  const mechanics::StabilityOfFigure& analyse, OwnFigure& start);

/// Fails if a small motion lacks a plane of symmetry of the computed sector. `lost` is the largest part of its complex
/// shape that the sector cannot represent, divided by the largest part of the whole shape.
mechanics::Status check_symmetry_of_motion(double lost);

}  // namespace pseudorigid::app
