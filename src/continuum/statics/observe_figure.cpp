#include "continuum/statics/observe_figure.h"

#include <algorithm>
#include <cmath>

#include "continuum/output/observe.h"
#include "continuum/statics/turned.h"

namespace pseudorigid::continuum {

mechanics::Status observe_figure(const BallFigures& figures, const mechanics::EquilibriumFigure& figure,
                                 mechanics::ContinuumObservables& o, Eigen::Vector3d& surface) {
  const BallBody& ball = figures.body();
  const BallSpace& space = ball.space();
  const BallState state{0, figures.positions(figure), ball.make_vector()};
  mechanics::ObservableRequest request;
  request.multiplier = false;
  if (auto status = observe_motion(ball, state, request, o); !status) return status;
  if (figures.drive() == Drive::loads) o.external *= figure.drive;
  o.multiplier = figure.lambda.size() > 0 ? mean_multiplier(ball, state.q, figures.multiplier(figure)) : 0;

  const double spin = figures.drive() == Drive::rotation ? std::sqrt(std::max(figure.drive, 0.0)) : 0;
  const int n_images = space.mesh().sector().n_images();
  const Eigen::Matrix3d moment = ball.nodal_moment(state.q, state.q);
  o.angular_momentum[2] = spin * (moment(0, 0) + moment(1, 1));
  o.kinetic = spin * o.angular_momentum[2] / 2;
  // The integrand ρ(X ⊗ Fᵀẋ)₁₂ of the circulation is even under the reflections of the octant. The integral over the
  // ball is therefore n_images times the integral over the octant.
  const CellIntegrals::Matrix pulled_back = ball.kernels().integrals(state.q, turned(space, 2, state.q)).X_pulled_back;
  o.circulation[2] = spin * n_images * (pulled_back[0][1] - pulled_back[1][0]);

  const Vector& X = space.reference_positions();
  for (unsigned int node = 0; node < space.n_nodes(); ++node)
    for (unsigned int c = 0; c < 3; ++c)
      if (std::abs(X.local_element(3 * node + c) - 1) < 1e-12) surface[c] = state.q.local_element(3 * node + c);
  return {};
}

}  // namespace pseudorigid::continuum
