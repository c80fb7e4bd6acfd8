#include "continuum/output/observe.h"

#include <Eigen/Dense>
#include <cmath>

#include "continuum/body/companion_sums.h"
#include "continuum/output/observe_stress.h"
#include "continuum/parallel/ranks.h"
#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/principal_axes.h"
#include "observables/orbit.h"
#include "observables/whole_body.h"

namespace pseudorigid::continuum {
namespace {

/// Σ m_n |x_n − A X_n|² over the nodes n of the sector on all ranks, with the nodal masses m_n. Collective.
double squared_distance_from_affine(const BallBody& ball, const Vector& x, const Eigen::Matrix3d& A) {
  const Vector affine = ball.affine_field(A);
  double sum = 0;
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i) {
    const double difference = x.local_element(i) - affine.local_element(i);
    sum += ball.space().mass().local_element(i) * difference * difference;
  }
  return sum_over_ranks(sum, ball.space().communicator());
}

double squared_norm(const BallBody& ball, const Vector& x) {
  return squared_distance_from_affine(ball, x, Eigen::Matrix3d::Zero());
}

/// Returns the nodal field x − c.
Vector relative(const BallBody& ball, const Vector& x, const Eigen::Vector3d& c) {
  Vector result = x;
  result.add(-1.0, ball.affine_field(Eigen::Matrix3d::Zero(), c));
  return result;
}

Eigen::Matrix3d to_eigen(const CellIntegrals::Matrix& t) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = t[i][j];
  return m;
}

}  // namespace

/// λ_h is the pressure field of the multiplier. The scalar product of the reaction of λ_h with x is ∫λ_h F⁻ᵀ:∇x dX =
/// 3∫λ_h dX. With the potential φ of self-gravity, Jp = λ_h − ρ(φ − φ̄) (nodal_fields.h). With the volume V and the
/// energy Ê of gravity/surface_gravity.h, ρφ̄V = (5/3)Ê and ∫ρφ dX = 2Ê. Therefore ∫Jp dX = ∫λ_h dX − Ê/3.
double mean_multiplier(const BallBody& ball, const Vector& x, const Vector& lambda) {
  Vector reaction = ball.make_vector();
  ball.kernels().add_reaction(x, lambda, reaction);
  const double m_bar = ball.E0().trace() / 3;
  const double of_gravity = ball.gravity() ? ball.gravity()->energy(x) / 3 : 0;
  return ball.space().mesh().sector().n_images() * ((reaction * x) / 3 - of_gravity) / m_bar;
}

mechanics::Status observe_motion(const BallBody& ball, const BallState& state,
                                 const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& o) {
  const int n_images = ball.space().mesh().sector().n_images();
  o.center = ball.mean(state.q);
  o.velocity = ball.mean(state.v);
  const Vector x = relative(ball, state.q, o.center), v = relative(ball, state.v, o.velocity);
  o.Q = ball.mass_moment(x);
  o.Qdot = ball.mass_moment(v);

  const CellIntegrals sums = ball.integrals(x, v);
  if (auto status = ball.judge(sums.least, x); !status) return status;
  const Eigen::Matrix3d F_integral = ball.whole_ball(to_eigen(sums.F));
  o.F = F_integral / ball.volume();
  o.volume_ratio = n_images * sums.volume / ball.volume();
  o.contact.take(ball.contact(state.t, state.q));
  if (request.energies) {
    o.kinetic = 0.5 * n_images * squared_norm(ball, state.v);
    o.volumetric = n_images * sums.volumetric;
    o.viscoelastic = ball.energy_of_branches(state.q);
    o.elastic = n_images * sums.elastic + o.volumetric + o.viscoelastic + ball.bulk_energy(state.q);
    o.external = ball.loads().potential(state.t, ball.nodal_moment(state.q, state.q), ball.mass() * o.center,
                                        F_integral, n_images * sums.volume);
    o.gravitational = ball.gravity() ? n_images * ball.gravity()->energy(state.q) : 0;
    if (ball.time_dependent()) o.external -= ball.given(state.v);
    o.dissipated = ball.dissipated(state.v);
    if (ball.relaxes()) o.dissipated_by_branches = Eigen::Vector4d::Map(ball.dissipated_by_branches(state.v).data());
  }
  if (ball.orbit().n() > 0 && (request.orbit || request.energies))
    o.orbit = mechanics::observe_orbit(ball.orbit(), ball.companions(state.q), ball.companions(state.v),
                                       ball.nodal_moment(x, x), mechanics::axial_vector(ball.nodal_moment(x, v)));
  if (ball.orbit().full_potential() && (request.orbit || request.energies)) {
    const mechanics::Orbit::Columns r = ball.orbit().relative(ball.companions(state.q));
    const CompanionSums sums = companion_sums(ball.orbit(), ball.space(), state.q, o.center, r);
    o.orbit.interaction = sums.energy + ball.orbit().energy_of_companions(r);
    o.orbit.torque = sums.torque;
  }
  if (request.momenta) {
    o.angular_momentum = mechanics::axial_vector(ball.nodal_moment(x, v));
    o.circulation = mechanics::axial_vector(ball.whole_ball(to_eigen(sums.X_pulled_back)));
  }
  o.over_points =
      mechanics::observe_over_points(request, [&](const auto& value) { return ball.least(state.q, value).value; });
  if (request.stresses)
    if (auto status = observe_stress(ball, state.q, o.stress); !status) return status;
  if (request.axes) o.semi_axes = mechanics::singular_values(o.Q);
  if (request.nonaffine) {
    o.nonaffine_kinetic_fraction =
        mechanics::share(squared_distance_from_affine(ball, v, o.Qdot), squared_norm(ball, v));
    o.nonaffine_displacement =
        std::sqrt(mechanics::share(squared_distance_from_affine(ball, x, o.Q), squared_norm(ball, x)));
    o.min_jacobian = ball.least_jacobian(x).value;
    o.volume_error = std::sqrt(n_images * sums.squared_log_J / ball.volume());
    o.max_volume_error = std::sqrt(sums.largest_squared_log_J);
  }
  return {};
}

mechanics::Status observe(const ElasticBall& ball, const BallState& state, ElasticBall::Workspace& workspace,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& o) {
  if (auto status = observe_motion(ball, state, request, o); !status) return status;
  if (mechanics::is_compliant(ball)) o.multiplier = 0;  // as of other compressible bodies
  if (!request.multiplier || mechanics::is_compliant(ball)) return {};
  Vector lambda = ball.make_multiplier();
  if (auto status = mechanics::multiplier_of_motion(ball, state, workspace, lambda); !status) return status;
  o.multiplier = mean_multiplier(ball, state.q, lambda);
  return {};
}

mechanics::Status observe(const CompressibleBall& ball, const BallState& state, CompressibleBall::Workspace&,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& o) {
  o.multiplier = 0;
  return observe_motion(ball, state, request, o);
}

Eigen::Vector2d energies(const BallBody& ball, const BallState& state) {
  mechanics::ContinuumObservables o;
  const mechanics::ObservableRequest request{
      {.state = false, .momenta = false, .multiplier = false, .axes = false, .nonaffine = false}};
  if (!observe_motion(ball, state, request, o)) return Eigen::Vector2d::Constant(NAN);
  const double kinetic = o.kinetic + o.orbit.kinetic;
  return {kinetic, o.energy() - kinetic};
}

}  // namespace pseudorigid::continuum
