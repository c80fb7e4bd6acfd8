#include "polynomial/observe.h"

#include <Eigen/Dense>
#include <cmath>

#include "mechanics/core/axial_vectors.h"
#include "mechanics/core/principal_axes.h"
#include "observables/orbit.h"
#include "observables/whole_body.h"
#include "polynomial/dense_kernels.h"
#include "polynomial/observe_stress.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {
namespace {

/// Integrals of F, J, (ln J)² and ρ X ⊗ Fᵀẋ over the whole body, and the largest |ln J| at the quadrature points.
struct Integrals {
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero(), X_pulled_back = Eigen::Matrix3d::Zero();
  double volume = 0, squared_log_J = 0, largest_log_J = 0;
};

Integrals integrals(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& v) {
  const int n = space.n_points();
  ScratchArray F(space.gradients().size(3));
  space.gradients().evaluate(space.blocks(), 3, q.data(), F);
  Integrals sums;
  const PointValues velocity = space.values_at_points(v);
  for (int p = 0; p < n; ++p) {
    const double w = space.weights()[p];
    if (w == 0) continue;
    Eigen::Matrix3d F_p;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) F_p(i, k) = F[static_cast<std::ptrdiff_t>(3 * i + k) * n + p];
    const auto& xi = space.points()[p];
    const Eigen::Vector3d X = space.semi_axes().cwiseProduct(Eigen::Vector3d(xi[0], xi[1], xi[2]));
    sums.F += w * F_p;
    const double J = F_p.determinant(), log_J = std::log(J);
    sums.volume += w * J;
    sums.squared_log_J += w * log_J * log_J;
    sums.largest_log_J = std::max(sums.largest_log_J, std::abs(log_J));
    sums.X_pulled_back += w * X * (F_p.transpose() * velocity.row(p).transpose()).transpose();
  }
  sums.F = mechanics::without_odd_entries(sums.F, space.reflect());
  sums.X_pulled_back = mechanics::without_odd_entries(sums.X_pulled_back, space.reflect());
  return sums;
}

/// Squared L² norms of a vector field minus its mean, and of the non-affine part of this field.
struct Parts {
  double whole, nonaffine;
};
Parts parts(const PolynomialSpace& space, const Eigen::VectorXd& relative) {
  Eigen::VectorXd affine = Eigen::VectorXd::Zero(space.n_unknowns());
  space.set_affine(space.affine_part(relative), Eigen::Vector3d::Zero(), affine);
  return {relative.squaredNorm(), (relative - affine).squaredNorm()};
}

/// The coefficients of x minus the mean of x.
Eigen::VectorXd relative(const PolynomialSpace& space, const Eigen::VectorXd& x) {
  Eigen::VectorXd result = x.head(space.n_unknowns());
  for (int i = 0; i < 3; ++i)
    if (const int at = space.place(i, 0); at >= 0) result[at] = 0;
  return result;
}

/// Sets the energies in `o`. The energy that loads have given by their change in time is subtracted from `external`. A
/// load that depends on time then does not change the total energy.
void observe_energies(const PolynomialBody& body, const BodyState& state, mechanics::ContinuumObservables& o) {
  const PotentialEnergies V = body.potential_energies(state.t, state.q);
  o.kinetic = body.kinetic_energy(state.v);
  o.elastic = V.elastic;
  o.volumetric = V.volumetric;
  o.viscoelastic = V.viscoelastic;
  o.gravitational = V.gravitational;
  o.external = V.external - body.given(state.v);
  o.dissipated = body.dissipated(state.v);
  o.dissipated_by_branches = Eigen::Vector4d::Map(body.dissipated_by_branches(state.v).data());
}

/// Sets all requested observables except the multiplier. The deformation must be admissible. Fails as observe_stress
/// does.
mechanics::Status observe_motion(const PolynomialBody& body, const BodyState& state,
                                 const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& o) {
  const PolynomialSpace& space = body.space();
  if (request.stresses)
    if (auto status = observe_stress(body, state.q, o.stress); !status) return status;
  const auto q = state.q.head(space.n_unknowns()), v = state.v.head(space.n_unknowns());
  o.center = space.mean(q);
  o.velocity = space.mean(v);
  o.Q = space.affine_part(q);
  o.Qdot = space.affine_part(v);
  const Eigen::VectorXd x = relative(space, state.q), u = relative(space, state.v);
  const Integrals sums = integrals(space, x, u);
  o.F = sums.F / space.volume();
  o.volume_ratio = sums.volume / space.volume();
  if (request.energies) observe_energies(body, state, o);
  o.contact.take(body.contact(state.t, state.q));
  if (body.orbit().n() > 0 && (request.orbit || request.energies))
    o.orbit = mechanics::observe_orbit(body.orbit(), body.companions(state.q), body.companions(state.v),
                                       space.moment(x, x), mechanics::axial_vector(space.moment(x, u)));
  if (request.momenta) {
    o.angular_momentum = mechanics::axial_vector(space.moment(x, u));
    o.circulation = mechanics::axial_vector(sums.X_pulled_back);
  }
  o.over_points =
      mechanics::observe_over_points(request, [&](const auto& value) { return body.least(state.q, value); });
  if (request.axes) o.semi_axes = mechanics::singular_values(o.Q * Eigen::Matrix3d(space.semi_axes().asDiagonal()));
  if (request.nonaffine) {
    const Parts of_x = parts(space, x), of_u = parts(space, u);
    o.nonaffine_kinetic_fraction = mechanics::share(of_u.nonaffine, of_u.whole);
    o.nonaffine_displacement = std::sqrt(mechanics::share(of_x.nonaffine, of_x.whole));
    o.min_jacobian = body.least(state.q, [](const Eigen::Matrix3d& F) { return F.determinant(); });
    o.volume_error = std::sqrt(sums.squared_log_J / space.volume());
    o.max_volume_error = sums.largest_log_J;
  }
  return {};
}

}  // namespace

mechanics::Status observe(const IncompressibleBody& body, const BodyState& state,
                          IncompressibleBody::Workspace& workspace, const mechanics::ObservableRequest& request,
                          mechanics::ContinuumObservables& o) {
  if (auto status = body.admissible(state.q); !status) return status;
  if (auto status = observe_motion(body, state, request, o); !status) return status;
  if (mechanics::is_compliant(body)) o.multiplier = 0;  // as of other compressible bodies
  if (!request.multiplier || mechanics::is_compliant(body)) return {};
  Eigen::VectorXd lambda = body.make_multiplier();
  if (auto status = mechanics::multiplier_of_motion(body, state, workspace, lambda); !status) return status;
  o.multiplier = body.mean_multiplier(state.q, lambda);
  return {};
}

mechanics::Status observe(const CompressibleBody& body, const BodyState& state, CompressibleBody::Workspace&,
                          const mechanics::ObservableRequest& request, mechanics::ContinuumObservables& o) {
  if (auto status = body.admissible(state.q); !status) return status;
  if (auto status = observe_motion(body, state, request, o); !status) return status;
  o.multiplier = 0;
  return {};
}

}  // namespace pseudorigid::polynomial
