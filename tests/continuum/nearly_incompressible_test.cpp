/// The nearly incompressible ball: a projected bulk term that RATTLE integrates implicitly. On affine states ln det F
/// is uniform, so the projection is exact, and the ball of the pointwise law is the reference.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "mechanics/core/memory.h"
#include "mechanics/steps/largest_frequency.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

using continuum::StoredEnergy;
using continuum::Vector;

StoredEnergy projected(double lambda) { return {neo_hookean, 0, lambda}; }

loads::Loads with_pressure() {
  loads::Loads loads;
  loads.get<loads::Pressure>().pressure = 0.3;
  return loads;
}

TEST(NearlyIncompressibleBall, AffineStatesAreThoseOfThePointwiseLaw) {
  const double lambda = 40;
  std::mt19937 generator(3);
  for (const int degree : {2, 4})
    for (const int n_refinements : {0, 1}) {  // 4 and 32 cells: few lanes and whole vectors
      const ElasticBall ball(half, degree, n_refinements, projected(lambda), with_pressure());
      const CompressibleBall pointwise(half, degree, n_refinements, CiarletGeymonat{1, lambda}, with_pressure());
      const Matrix3d Q = 1.05 * Matrix3d::Identity() + 0.1 * admissible(half, random_matrix(generator));
      const auto state = affine_state(ball, Q, admissible(half, random_matrix(generator)));
      const auto o = observed(ball, state), expected = observed(pointwise, state);
      EXPECT_NEAR(o.elastic, expected.elastic, 1e-12 * expected.elastic);
      EXPECT_NEAR(o.external, expected.external, 1e-12);
      EXPECT_EQ(o.multiplier, 0);

      auto workspace = ball.make_workspace();
      auto none = pointwise.make_workspace();
      Vector multiplier = ball.make_multiplier(), f = ball.make_vector(), of_law = f;
      ASSERT_TRUE(mechanics::multiplier_of_compliance(ball, state.q, multiplier));
      ASSERT_TRUE(ball.force(0, state.q, state.v, workspace, f));
      ball.add_reaction(state.q, multiplier, f);
      ASSERT_TRUE(pointwise.force(0, state.q, state.v, none, of_law));
      const double scale = of_law.linfty_norm();
      EXPECT_GT(scale, 0.1);
      f -= of_law;
      EXPECT_LT(f.linfty_norm(), 1e-11 * scale);
    }
}

/// The reaction −Gᵀb is the derivative of the bulk energy, also where ln det F is not uniform.
TEST(NearlyIncompressibleBall, ReactionIsTheDerivativeOfTheBulkEnergy) {
  std::mt19937 generator(4);
  const ElasticBall ball(octant, 4, 0, projected(7));
  Vector u = random_field(ball.make_vector(), generator), a = u;
  ball.apply_inverse_mass(u, a);  // 0 at the components that the planes fix
  a *= 0.02 / a.linfty_norm();
  Vector x = ball.affine_field(diagonal(1.1, 0.95, 1.05));
  x += a;
  Vector multiplier = ball.make_multiplier(), reaction = ball.make_vector();
  ASSERT_TRUE(mechanics::multiplier_of_compliance(ball, x, multiplier));
  ball.add_reaction(x, multiplier, reaction);
  const double h = 1e-4, n_images = 8;
  Vector forwards = x, backwards = x;
  forwards.add(h, a);
  backwards.add(-h, a);
  const double slope = (ball.bulk_energy(forwards) - ball.bulk_energy(backwards)) / (2 * h);
  EXPECT_NEAR(slope, -n_images * (reaction * a), 1e-6 * std::abs(slope));
}

/// λ = 10⁵ and steps of the shear waves: momentum to round-off, energy without drift, and the same after a restart.
TEST(NearlyIncompressibleBall, KeepsMomentumAndEnergyAndResumes) {
  using Method = mechanics::Rattle;
  const ElasticBall ball(half, 3, 0, projected(1e5));
  Matrix3d Qdot;
  Qdot << 0.1, -0.3, 0, 0.3, 0.1, 0, 0, 0, -0.2;
  const auto start = affine_state(ball, Matrix3d::Identity(), Qdot);
  const auto before = observed(ball, start);
  const auto r = run<Method>(ball, start, 3, 6, 50);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (const auto& state : r.states) {
    const auto o = observed(ball, state);
    EXPECT_NEAR(o.energy(), before.energy(), 1e-3 * before.energy());
    EXPECT_LT((o.angular_momentum - before.angular_momentum).norm(), 1e-12);
    EXPECT_LT(std::abs(o.volume_ratio - 1), 1e-4);
  }
  auto state = start;
  Method::Workspace<ElasticBall> workspace(ball), other(ball);
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(Method::advance(ball, 0.02, state, workspace));
  std::vector<double> memory;
  mechanics::save_memory(workspace, memory);
  ASSERT_TRUE(mechanics::restore_memory(other, memory));
  auto resumed = state;
  for (int k = 0; k < 5; ++k) {
    ASSERT_TRUE(Method::advance(ball, 0.02, state, workspace));
    ASSERT_TRUE(Method::advance(ball, 0.02, resumed, other));
    ASSERT_EQ(distance(state, resumed), 0) << k;
  }
}

/// The step is that of shear waves: 20 times that of the pointwise law with λ = 10⁴.
TEST(NearlyIncompressibleBall, StepDoesNotDependOnTheBulkModulus) {
  const auto omega = [](const auto& ball) {
    auto workspace = ball.make_workspace();
    const auto rest = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
    const auto report = mechanics::largest_frequency(ball, rest, workspace, 60);
    EXPECT_TRUE(report.status);
    return report.omega;
  };
  const double soft = omega(ElasticBall(octant, 3, 0, projected(1))),
               stiff = omega(ElasticBall(octant, 3, 0, projected(1e4))),
               pointwise = omega(CompressibleBall(octant, 3, 0, CiarletGeymonat{1, 1e4}));
  EXPECT_NEAR(stiff / soft, 1, 1e-6);
  EXPECT_GT(pointwise / stiff, 20);
}

/// Both forms of the bulk term have one limit in degree. The reference has the pointwise law, in which λ = 100 does not
/// lock at degree 7.
TEST(NearlyIncompressibleBall, ConvergesToTheMotionOfThePointwiseLaw) {
  const Matrix3d Qdot = diagonal(0.3, 0.3, -0.6);
  const auto Q33_of = [&]<class Ball>(const Ball& ball, long n) {
    using Method = std::conditional_t<std::is_same_v<Ball, ElasticBall>, mechanics::Rattle, mechanics::Rattle4>;
    const auto r = run<Method>(ball, affine_state(ball, Matrix3d::Identity(), Qdot), 1, 1, n);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    return ball.mass_moment(r.last().q)(2, 2);
  };
  const double exact = Q33_of(CompressibleBall(octant, 7, 0, CiarletGeymonat{1, 100}), 1200);
  std::vector<double> errors;
  for (const int degree : {2, 3, 4})
    errors.push_back(std::abs(Q33_of(ElasticBall(octant, degree, 0, projected(100)), 2000) - exact));
  EXPECT_LT(errors[0], 1e-2);
  EXPECT_LT(errors[2], 1e-4);
  EXPECT_LT(errors[2], errors[0] / 5);
}

}  // namespace
}  // namespace pseudorigid::testing
