/// The compressible ball in motion: laws, pressure waves and the stability of the step, balances.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "continuum/output/nodal_fields.h"
#include "materials/eigen_tensor.h"
#include "materials/law_table.h"
#include "mechanics/steps/largest_frequency.h"
#include "mechanics/steps/step_size.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

/// Lamé's λ = 100 μ: pressure waves are 10 times as fast as shear waves, and set the step.
TEST(CompressibleBall, StepIsThatOfPressureWaves) {
  const CiarletGeymonat stiff{1, 100}, soft{1, 0};
  CompressibleBall::Workspace workspace;
  const CompressibleBall ball(octant, 3, 0, stiff), slow(octant, 3, 0, soft);
  const auto rest = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
  const auto fast = mechanics::largest_frequency(ball, rest, workspace, 60);
  const auto slower = mechanics::largest_frequency(slow, rest, workspace, 60);
  ASSERT_TRUE(fast.status && slower.status);
  EXPECT_GT(fast.omega / slower.omega, 5);  // at most √((λ + 2μ)/2μ) = 7.1

  const auto growth = [&](double h) {
    std::mt19937 generator(5);
    auto state = rest;
    state.v = random_field(state.v, generator);
    state.v *= 1e-9;
    ball.apply_inverse_mass(state.v, state.v);
    const double at_start = state.v.linfty_norm();
    mechanics::RattleWorkspace<CompressibleBall> w(ball);
    for (int i = 0; i < 400; ++i)
      if (!mechanics::Rattle::advance(ball, h, state, w)) return HUGE_VAL;
    return state.v.linfty_norm() / at_start;
  };
  EXPECT_LT(growth(mechanics::rattle_step_limit(fast.omega, 0)), 20);
  EXPECT_GT(growth(1.05 * mechanics::Rattle::stability_limit / fast.omega), 1e4);
}

/// Released and turning: energy without drift, momenta to round-off.
TEST(CompressibleBall, KeepsEnergyAndMomentum) {
  for (const char* name : {"neo-hookean", "ciarlet-geymonat", "mooney-rivlin", "saint-venant-kirchhoff"}) {
    SCOPED_TRACE(name);
    const CompressibleBall ball(half, 3, 0,
                                materials::make_law(name, {.lame_lambda = 2, .mooney_fraction = 0.3}, false));
    Matrix3d Qdot;
    Qdot << 0, -0.3, 0, 0.3, 0, 0, 0, 0, 0;
    const auto start = affine_state(ball, diagonal(1.1, 1, 0.95), Qdot);
    const auto before = observed(ball, start);
    const auto r = run<mechanics::Rattle4>(ball, start, 4, 8, 50);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    double volume_changes = 0;
    for (const auto& state : r.states) {
      const auto o = observed(ball, state);
      EXPECT_NEAR(o.energy(), before.energy(), 1e-5 * before.energy());  // order 4
      EXPECT_LT((o.angular_momentum - before.angular_momentum).norm(), 1e-12);
      volume_changes = std::max(volume_changes, std::abs(o.volume_ratio / before.volume_ratio - 1));
    }
    EXPECT_GT(volume_changes, 0.01);
  }
}

TEST(CompressibleBall, PressureOfAffineStatesIsThatOfTheLaw) {
  std::mt19937 generator(7);
  const CompressibleBall ball(octant, 3, 0, ciarlet_geymonat);
  const Matrix3d Q = diagonal(1.1, 0.9, 1.3);
  CompressibleBall::Workspace workspace;
  mechanics::BodyFields fields;
  ASSERT_TRUE(nodal_fields(ball, affine_state(ball, Q, Matrix3d::Zero()), workspace, fields));
  const Matrix3d P = materials::to_matrix(ciarlet_geymonat.stress(materials::to_tensor(Q)));
  const double pressure = -(P * Q.transpose()).trace() / (3 * Q.determinant());
  ASSERT_GT(std::abs(pressure), 0.1);
  for (std::size_t i = 0; i < fields.n_points(); ++i)
    ASSERT_NEAR(-Eigen::Map<const Matrix3d>(fields.stress.data() + 9 * i).trace() / 3, pressure, 1e-11);
}

/// Driven into collapse, the ball ends in a message.
TEST(CompressibleBall, InsideOutIsAStatus) {
  const CompressibleBall ball(octant, 2, 0, materials::make_law("saint-venant-kirchhoff", {}, false));
  const auto start = affine_state(ball, Matrix3d::Identity(), -20 * Matrix3d::Identity());
  const auto r = run<mechanics::Rattle>(ball, start, 1, 1, 1000);
  EXPECT_FALSE(r.finished());
  EXPECT_NE(r.result.reason.find("turned inside out"), std::string::npos) << r.result.reason;
}

}  // namespace
}  // namespace pseudorigid::testing
