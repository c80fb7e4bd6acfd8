/// The scaled constraint |g| and its rate |Gv| are zero to 1e-12 at every sample, at small and at large amplitude. The
/// moment identities of PHYSICS 7.1 hold for any multiplier; this is what tests the constraint solves.

#include <gtest/gtest.h>

#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

struct Amplitude {
  int degree;
  double rate;  ///< ẋ = rate diag(1, 1, −2) X
};

class Constraint : public ::testing::TestWithParam<Amplitude> {
 protected:
  template <class Method>
  void expect_kept() {
    const ElasticBall ball(octant, GetParam().degree, 0, neo_hookean);
    const auto start = affine_state(ball, Matrix3d::Identity(), GetParam().rate * diagonal(1, 1, -2));
    const auto r = run<Method>(ball, start, 3, 24, 10);  // steps of 0.0125
    ASSERT_TRUE(r.finished()) << r.result.reason;
    continuum::Vector g = ball.make_multiplier(), rate = g;
    double worst_g = 0, worst_rate = 0;
    for (const auto& state : r.states) {
      ASSERT_TRUE(ball.constraint(state.q, g));
      ball.constraint_rate(state.q, state.v, rate);
      worst_g = std::max(worst_g, g.linfty_norm() / ball.multiplier_scale());
      worst_rate = std::max(worst_rate, rate.linfty_norm() / ball.multiplier_scale());
    }
    EXPECT_LE(worst_g, 1e-12);
    EXPECT_LE(worst_rate, 1e-12);
    EXPECT_GT((ball.mass_moment(r.last().q) - Matrix3d::Identity()).norm(), 0.1 * GetParam().rate);
  }
};

TEST_P(Constraint, IsKeptByRattle) { expect_kept<mechanics::Rattle>(); }
TEST_P(Constraint, IsKeptByTheCompositionOfOrder4) { expect_kept<mechanics::Rattle4>(); }

INSTANTIATE_TEST_SUITE_P(Amplitudes, Constraint,
                         ::testing::Values(Amplitude{3, 1e-3}, Amplitude{3, 0.3}, Amplitude{4, 1e-3},
                                           Amplitude{4, 0.3}),
                         [](const auto& info) {
                           return std::to_string(info.param.degree) + (info.param.rate < 0.1 ? "Small" : "Large");
                         });

}  // namespace
}  // namespace pseudorigid::testing
