/// Rates of the elements on a nonlinear isochoric motion with body force and traction, on curved cells that are not
/// images of a cube under affine maps: u in L² with h^{k+1}, p with h^k (PHYSICS 7.6).

#include <gtest/gtest.h>

#include "continuum/manufactured_motion.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

TEST(ManufacturedMotion, IsIsochoric) {
  const ManufacturedMotion motion;
  for (const Vector3d& X : {Vector3d(0.1, 0.5, 0.3), Vector3d(0.6, 0, 0.7)})
    EXPECT_NEAR(motion.deformation_gradient(X, 0.8).determinant(), 1, 1e-14);
  // The acceleration is the second derivative of the position: central differences of 1e-4 err by 1e-8.
  const Vector3d X(0.3, 0.4, 0.5);
  const double h = 1e-4;
  const Vector3d difference =
      (motion.position(X, 0.8 + h) - 2 * motion.position(X, 0.8) + motion.position(X, 0.8 - h)) / (h * h);
  EXPECT_LT((motion.acceleration(X, 0.8) - difference).norm(), 1e-6);
}

class ManufacturedRates : public ::testing::TestWithParam<int> {};

TEST_P(ManufacturedRates, OfPositionAndPressure) {
  const int degree = GetParam(), finest = degree == 2 ? 3 : 2;
  std::vector<ErrorPoint> position, multiplier;
  for (int n_refinements = degree == 4 ? 0 : 1; n_refinements <= finest; ++n_refinements) {
    const ManufacturedBall system(octant, degree, n_refinements);
    // Order 4 with steps below the stability limit ~ h/k²: the time error is below that of space by far.
    const long n_steps = (degree == 2 ? 2 : degree == 3 ? 3 : 5) << n_refinements;
    const auto r = run<mechanics::Rattle4>(system, system.initial(), 0.125, 1, n_steps);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    auto workspace = system.make_workspace();
    auto lambda = system.make_multiplier();
    ASSERT_TRUE(mechanics::multiplier_of_motion(system, r.last(), workspace, lambda));
    const auto errors = system.errors(r.last(), lambda);
    const double h = std::pow(0.5, n_refinements);
    position.push_back({h, errors.position});
    multiplier.push_back({h, errors.multiplier});
    std::printf("k = %d, refined %d: |x_h - x| %.3e, |p_h - p| %.3e\n", degree, n_refinements, errors.position,
                errors.multiplier);
  }
  const auto of_position = fit_order(position), of_multiplier = fit_order(multiplier);
  std::printf("k = %d: fitted rates %.2f and %.2f\n", degree, of_position.order, of_multiplier.order);
  EXPECT_GE(of_position.order, degree + 1 - 0.3);
  EXPECT_GE(of_multiplier.order, degree - 0.3);
}
INSTANTIATE_TEST_SUITE_P(Degree, ManufacturedRates, ::testing::Values(2, 3, 4));

}  // namespace
}  // namespace pseudorigid::testing
