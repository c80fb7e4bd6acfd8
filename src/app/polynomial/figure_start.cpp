#include "app/polynomial/figure_start.h"

#include "app/figures/figure_start.h"
#include "app/polynomial/body_setup.h"
#include "polynomial/figure_spectrum.h"

namespace pseudorigid::app {
namespace {

using polynomial::PolynomialSpace;

/// The displacements of the phase points, which determine the phase of a small motion (mechanics::factor_of_shape).
/// `shape` has the coefficients of the motion in `space`, the space of the whole body.
mechanics::PhaseDisplacements at_phase_points(const PolynomialSpace& space, const Eigen::VectorXcd& shape) {
  mechanics::PhaseDisplacements u;
  Eigen::Index k = 0;
  for (const Eigen::Vector3d& X : mechanics::phase_points()) {
    const auto functions = space.functions_at({X[0], X[1], X[2]});
    u.col(k).real() = space.value(functions, shape.real());
    u.col(k++).imag() = space.value(functions, shape.imag());
  }
  return u;
}

/// The largest coefficient of the whole body that `sector` does not have, divided by the largest one.
double part_beyond(const PolynomialSpace& sector, const PolynomialSpace& whole, const Eigen::VectorXcd& shape) {
  double lost = 0;
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < sector.n_functions(); ++a)
      if (sector.place(i, a) < 0) lost = std::max(lost, std::abs(shape[whole.place(i, a)]));
  return lost / shape.cwiseAbs().maxCoeff();
}

/// Adds the small motion to the coefficients x of the positions and v of the velocities of the whole body, in the
/// turning frame. Fails if this motion cannot be computed, or if it lacks a symmetry plane of `sector`.
mechanics::Status add_motion(const scene::Scene& scene, const polynomial::FigureSpectrum& spectrum,
                             const OwnFigure& own, const PolynomialSpace& sector, Eigen::VectorXd& x,
                             Eigen::VectorXd& v) {
  mechanics::SmallMotion motion;
  if (auto status = spectrum.motion(own.member.figure, own.motion.of_class, own.motion.s, motion); !status)
    return at_entry("Initial state/Mode", status.reason());
  // The functions are orthonormal with respect to the mass, so |shape|² is the integral of |y|² over the mass.
  const PolynomialSpace& space = spectrum.space();
  const Eigen::VectorXcd y =
      mechanics::factor_of_shape(scene.initial_state.mode_amplitude, motion.shape.squaredNorm() / space.volume(),
                                 at_phase_points(space, motion.shape)) *
      motion.shape;
  x += y.real();
  v += (motion.rate * y).real();
  return check_symmetry_of_motion(part_beyond(sector, space, motion.shape));
}

}  // namespace

mechanics::Status start_from_figure(const scene::Scene& scene, const PolynomialSpace& space, Eigen::VectorXd& x,
                                    Eigen::VectorXd& v) {
  const polynomial::FigureSetup setup{body_setup(scene, {}, space.degree()), scene.body.incompressible,
                                      mechanics::Drive::rotation,
                                      family_of_figures(scene, scene.initial_state.origin->family).figure};
  const polynomial::BodyFigures figures(setup);
  const polynomial::FigureSpectrum spectrum(setup);
  OwnFigure own;
  const auto analyse = [&](const auto& of, auto only, auto& classes) { return spectrum.analyse(of, only, classes); };
  if (auto status = find_own_figure(scene, figures, analyse, own); !status) return status;
  Eigen::VectorXd position = spectrum.whole(own.member.figure.x), velocity = Eigen::VectorXd::Zero(position.size());
  if (scene.initial_state.mode != 0)
    if (auto status = add_motion(scene, spectrum, own, space, position, velocity); !status) return status;
  velocity += own.spin() * polynomial::Turns(spectrum.space()).of_space(2, position);
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < space.n_functions(); ++a)
      if (const int at = space.place(i, a); at >= 0) {
        const int of_whole = spectrum.space().place(i, a);
        x[at] = position[of_whole];
        v[at] = velocity[of_whole];
      }
  return {};
}

}  // namespace pseudorigid::app
