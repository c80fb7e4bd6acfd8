#include "app/continuum/figure_start.h"

#include "app/continuum/figure_setup.h"
#include "app/figures/figure_start.h"
#include "continuum/statics/octant_fields.h"
#include "continuum/statics/turned.h"

namespace pseudorigid::app {
namespace {

/// Adds the small motion of the scene to the positions x and the velocities v in the turning frame. Fails if this
/// motion cannot be computed, or if it does not have the symmetry planes of the sector.
mechanics::Status add_motion(const scene::Scene& scene, const continuum::BallFigures& figures, const OwnFigure& own,
                             const continuum::OctantContinuation& continuation, const continuum::BallSpace& space,
                             continuum::Vector& x, continuum::Vector& v) {
  continuum::SmallMotionOfBall motion;
  if (auto status = continuum::small_motion_of(figures, own.member.figure, n_eigenvectors_of_figure,
                                               own.motion.of_class, own.motion.s, motion);
      !status)
    return at_entry("Initial state/Mode", status.reason());
  const continuum::BallSpace& octant = figures.body().space();
  const std::complex<double> factor =
      mechanics::factor_of_shape(scene.initial_state.mode_amplitude, continuum::mean_square(octant, motion),
                                 continuum::at_phase_points(octant, motion));
  const std::complex<double> of_velocity = factor * motion.rate;
  double lost = 0, largest = 0;
  for (const auto& [parity, real, imaginary] : motion.parts) {
    continuation.add(factor.real(), parity, real, x);
    continuation.add(-factor.imag(), parity, imaginary, x);
    continuation.add(of_velocity.real(), parity, real, v);
    continuation.add(-of_velocity.imag(), parity, imaginary, v);
    const double size = std::max(real.linfty_norm(), imaginary.linfty_norm());
    largest = std::max(largest, size);
    for (std::size_t j = 0; j < 3; ++j)
      if (space.mesh().sector().reflect[j] && parity.sign[j] < 0) lost = std::max(lost, size);
  }
  return check_symmetry_of_motion(lost / largest);
}

}  // namespace

mechanics::Status start_from_figure(const scene::Scene& scene, int n_refinements, const continuum::BallSpace& space,
                                    continuum::Vector& x, continuum::Vector& v) {
  const mechanics::Figure figure = family_of_figures(scene, scene.initial_state.origin->family).figure;
  const continuum::BallFigures figures(figure_setup(scene, space.degree(), n_refinements, figure),
                                       {space.communicator()});
  OwnFigure own;
  const auto analyse = [&](const auto& of, auto only, auto& classes) {
    return continuum::stability_of(figures, of, n_eigenvectors_of_figure, only, classes);
  };
  if (auto status = find_own_figure(scene, figures, analyse, own); !status) return status;
  const continuum::OctantContinuation continuation(figures.body().space(), space);
  continuation.add(1, {}, figures.positions(own.member.figure), x);
  if (scene.initial_state.mode != 0)
    if (auto status = add_motion(scene, figures, own, continuation, space, x, v); !status) return status;
  v.add(own.spin(), continuum::turned(space, 2, x));
  return {};
}

}  // namespace pseudorigid::app
