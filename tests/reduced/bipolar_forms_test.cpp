/// The bipolar observables on every form of the body: SL(3) and GL⁺(3), with dissipation, diagonal; and the stretch of
/// path that their residual is made of.

#include <gtest/gtest.h>

#include <optional>

#include "reduced/diagonal_body.h"
#include "reduced/dissipative_body.h"
#include "reduced/local_path.h"
#include "reduced/potentials.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

using mechanics::ExplicitMultiplier;
using reduced::Bipolar;

constexpr reduced::Dissipation dissipation{.viscosity = 0.1, .drag = 0.2};

/// Axes well apart, turning and circulating in all directions.
template <class Body>
State<Body> apart() {
  const Matrix3d A = diagonal(2, 1.1, 1 / 2.2);
  return moving<Body>(A, A * matrix({0.3, 0.7, -0.2, 0.5, -0.5, 0.9, 0.4, 0.2, 0.2}));
}
/// The bipolar observables at a state, of a path that begins there.
template <class System>
mechanics::ReducedObservables bipolar_observed(const System& system, const State<System>& state) {
  auto o = observed(system, state);
  auto w = system.make_workspace();
  std::optional<Bipolar> before;
  const auto status = reduced::observe_bipolar(system, state, w, before, o);
  EXPECT_TRUE(status) << status.reason();
  EXPECT_TRUE(before.has_value());
  return o;
}

/// What is left of (5.121): the force of dissipation belongs to it, on GL⁺(3) there is no multiplier.
TEST(BipolarForms, ResidualIsSmallOnEveryForm) {
  const auto sl3 = loaded_body<LoadedSl3>(Law{1, 0}, {moderate_gravity, generic_quadratic()});
  const auto gl3 = loaded_body<LoadedGl3>(Law{1, 2}, {moderate_gravity, generic_quadratic()});
  const reduced::DissipativeBody damped_sl3(sl3, dissipation);
  const reduced::DissipativeBody damped_gl3(gl3, dissipation);
  EXPECT_LT(bipolar_observed(sl3, apart<LoadedSl3>()).bipolar_residual, 1e-9);
  EXPECT_LT(bipolar_observed(gl3, apart<LoadedGl3>()).bipolar_residual, 1e-9);
  EXPECT_LT(bipolar_observed(damped_sl3, damped_sl3.state_of(apart<LoadedSl3>())).bipolar_residual, 1e-9);
  EXPECT_LT(bipolar_observed(damped_gl3, damped_gl3.state_of(apart<LoadedGl3>())).bipolar_residual, 1e-9);

  const auto ellipsoid =
      elastic_sl3({moderate_gravity, Matrix3d::Zero(), reduced::ReferenceBody::ellipsoid({1.3, 1, 0.8})});
  EXPECT_LT(bipolar_observed(ellipsoid, apart<LoadedSl3>()).bipolar_residual, 1e-9);

  const auto diagonal_load = elastic_sl3({moderate_gravity, diagonal(0.1, -0.2, 0.3)});
  const reduced::DiagonalBody three(diagonal_load);
  auto start = moving<LoadedSl3>(diagonal(2, 1.1, 1 / 2.2), diagonal(2, 1.1, 1 / 2.2) * diagonal(0.5, -0.8, 0.3));
  const auto o = bipolar_observed(three, three.state_of(start));
  EXPECT_LT(o.bipolar_residual, 1e-9);
  EXPECT_EQ(o.Omega_star, Vector3d::Zero());
  EXPECT_EQ(o.Lambda_star, Vector3d::Zero());
}

/// Without its force the dissipative motion does not obey (5.121): the residual sees dissipation.
TEST(BipolarForms, ResidualSeesAForceThatIsLeftOut) {
  const auto body = elastic_sl3({moderate_gravity});
  const reduced::DissipativeBody damped(body, dissipation);
  const auto start = apart<LoadedSl3>();
  reduced::LocalPath<reduced::DissipativeBody<LoadedSl3>> path;
  const double h = 0.002;
  ASSERT_TRUE(reduced::local_path(damped, damped.state_of(start), h, path));
  std::array<mechanics::VectorState<Matrix3d>, 9> motions;
  for (std::size_t k = 0; k < path.size(); ++k) motions[k] = damped.motion(path[k]);
  const auto residual = reduced::residual_of_5_121(motions, h, body.energy_density().gradient(start.q),
                                                   observed(damped, damped.state_of(start)).multiplier, body.E0());
  EXPECT_GT(residual.norm(), 0.1);
}

/// The states at t + jh of the path are those of the motion, backwards as well: the error of 32 steps of order 4 is
/// some h⁵ of the eighth part.
TEST(LocalPath, IsTheMotionOnBothSides) {
  const auto body = elastic_sl3({moderate_gravity});
  auto start = apart<LoadedSl3>();
  start.t = 0.7;
  const double h = 0.005;
  reduced::LocalPath<LoadedSl3> path;
  ASSERT_TRUE(reduced::local_path(body, start, h, path));
  EXPECT_EQ(distance(path[4], start), 0);
  for (int j = -4; j <= 4; ++j) {
    const auto exact = integrate(ExplicitMultiplier(body), start, start.t + j * h, 1e-14);
    EXPECT_NEAR(path[4 + j].t, exact.t, 1e-15);
    EXPECT_LT(distance(path[4 + j], exact), 1e-12);
  }
}

/// A body that is inside out has no path: a report, no numbers.
TEST(LocalPath, FailsWhereTheForceFails) {
  const auto body = elastic_sl3({moderate_gravity});
  reduced::LocalPath<LoadedSl3> path;
  auto inside_out = apart<LoadedSl3>();
  inside_out.q.col(0) *= -1;
  const auto status = reduced::local_path(body, inside_out, 0.01, path);
  ASSERT_FALSE(status);
  EXPECT_NE(status.reason().find("inside out"), std::string::npos) << status.reason();
}

}  // namespace
}  // namespace pseudorigid::testing
