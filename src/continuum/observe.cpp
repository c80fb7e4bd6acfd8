#include <Eigen/Dense>
#include <cmath>

#include "continuum/elastic_ball.h"
#include "mechanics/principal_axes.h"

namespace pseudorigid::continuum {
namespace {

/// Σ m_n |x_n − A X_n|² over the sector.
double squared_distance_from_affine(const ElasticBall& ball, const Vector& x, const Eigen::Matrix3d& A) {
  const Vector affine = ball.affine_field(A);
  double sum = 0;
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i) {
    const double difference = x.local_element(i) - affine.local_element(i);
    sum += ball.space().mass().local_element(i) * difference * difference;
  }
  return sum;
}

double squared_norm(const ElasticBall& ball, const Vector& x) {
  return squared_distance_from_affine(ball, x, Eigen::Matrix3d::Zero());
}

double ratio(double part, double whole) { return whole == 0 ? 0 : part / whole; }

/// Mass-weighted mean of a nodal field over the whole ball; components across a symmetry plane cancel.
Eigen::Vector3d mean(const ElasticBall& ball, const Vector& x) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double mass = 0;
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3) {
    const double m = ball.space().mass().local_element(i);
    mass += m;
    for (int c = 0; c < 3; ++c) sum[c] += m * x.local_element(i + c);
  }
  for (int c = 0; c < 3; ++c)
    if (ball.space().mesh().sector().reflect[c]) sum[c] = 0;
  return sum / mass;
}

Eigen::Matrix3d to_eigen(const dealii::Tensor<2, 3>& t) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = t[i][j];
  return m;
}

/// (1/m̄)∫λ_h dV: the integral tests the constraint force with the dilation x, ∫λ_h F⁻ᵀ:∇x dV = 3∫λ_h dV.
double mean_multiplier(const ElasticBall& ball, const Vector& x, const Vector& lambda) {
  Vector reaction = ball.make_vector();
  ball.add_reaction(x, lambda, reaction);
  const double m_bar = ball.E0().trace() / 3;
  return ball.space().mesh().sector().n_images() * (reaction * x) / (3 * m_bar);
}

}  // namespace

mechanics::Status observe(const ElasticBall& ball, const mechanics::State<ElasticBall>& state,
                          ElasticBall::Workspace& workspace, const mechanics::ObservableRequest& request,
                          mechanics::ContinuumObservables& o) {
  const int n_images = ball.space().mesh().sector().n_images();
  o.Q = ball.mass_moment(state.q);
  o.Qdot = ball.mass_moment(state.v);
  o.center = mean(ball, state.q);
  o.velocity = mean(ball, state.v);

  const CellIntegrals sums = ball.kernels().integrals(state.q, state.v);
  o.F = ball.whole_ball(to_eigen(sums.F)) / ball.volume();
  o.volume_ratio = n_images * sums.volume / ball.volume();
  if (request.energies) {
    o.kinetic = 0.5 * n_images * squared_norm(ball, state.v);
    o.elastic = n_images * sums.elastic;
  }
  if (request.momenta) {
    const double mass = n_images * ball.space().mass().l1_norm() / 3;
    o.angular_momentum =
        mechanics::axial_vector(ball.nodal_moment(state.q, state.v)) - mass * o.center.cross(o.velocity);
    o.circulation = mechanics::axial_vector(ball.whole_ball(to_eigen(sums.X_pulled_back)));
  }
  if (request.axes) o.semi_axes = mechanics::singular_values(o.Q);
  if (request.nonaffine) {
    o.nonaffine_kinetic_fraction =
        ratio(squared_distance_from_affine(ball, state.v, o.Qdot), squared_norm(ball, state.v));
    o.nonaffine_displacement =
        std::sqrt(ratio(squared_distance_from_affine(ball, state.q, o.Q), squared_norm(ball, state.q)));
    o.min_jacobian = ball.kernels().locate_least_jacobian(state.q).value;
  }
  if (request.multiplier) {
    Vector lambda = ball.make_multiplier();
    if (auto status = mechanics::multiplier_of_motion(ball, state, workspace, lambda); !status) return status;
    o.multiplier = mean_multiplier(ball, state.q, lambda);
  }
  return {};
}

}  // namespace pseudorigid::continuum
