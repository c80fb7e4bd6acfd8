/// Love numbers of the finite-element ball against those of the exact sphere.

#include "continuum/modes/love_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using namespace continuum;

std::vector<BallLoveNumbers> numbers_of(int degree, int n_refinements, const std::vector<int>& degrees, double gamma) {
  const BallSpace space(BallMesh({{true, true, true}}, n_refinements), degree);
  const StoredEnergy stored(materials::CiarletGeymonat{1, 0}, 0);
  const auto kernels = make_cell_kernels(space, stored);
  const RestProblem problem(space, *kernels, stored, true, 3 * gamma / (4 * std::numbers::pi));
  std::vector<BallLoveNumbers> numbers;
  const auto status = love_numbers(problem, degrees, numbers);
  EXPECT_TRUE(status) << status.reason();
  return numbers;
}

struct Errors {
  double h, l;
};
Errors errors_of(const BallLoveNumbers& found, double gamma) {
  const gravity::LoveNumbers exact = gravity::exact_love_numbers(found.mean.degree, gamma);
  return {std::abs(found.mean.h / exact.h - 1), std::abs(found.mean.l / exact.l - 1)};
}

TEST(BallLoveNumbers, DegreeTwoIsExactToAMillionth) {
  for (const double gamma : {0.1, 1.0, 100.0}) {
    const auto numbers = numbers_of(6, 0, {2}, gamma);
    const Errors errors = errors_of(numbers.front(), gamma);
    EXPECT_LT(errors.h, 1e-6) << gamma;
    EXPECT_LT(errors.l, 1e-6) << gamma;
  }
}

/// The penalty of the constraint follows gravity. With a penalty in proportion to μ the error was 1e-6 here.
TEST(BallLoveNumbers, StrongGravityDoesNotBreakTheConstraint) {
  constexpr double gamma = 1e4;
  const Errors errors = errors_of(numbers_of(7, 0, {2}, gamma).front(), gamma);
  EXPECT_LT(errors.h, 3e-7);
  EXPECT_LT(errors.l, 3e-7);
}

TEST(BallLoveNumbers, HigherDegreesAreExactToTheMesh) {
  for (const auto& [gamma, degrees] :
       {std::pair{0.1, std::vector{3, 6}}, std::pair{100.0, std::vector{3, 4, 5, 6, 7, 8}}})
    for (const BallLoveNumbers& found : numbers_of(8, 0, degrees, gamma)) {
      const Errors errors = errors_of(found, gamma);
      EXPECT_LT(errors.h, 1e-5) << found.mean.degree << " gamma " << gamma;
      EXPECT_LT(errors.l, 1e-5) << found.mean.degree << " gamma " << gamma;
    }
}

/// The compliance is twice as accurate as the displacement: h of order 2k.
TEST(BallLoveNumbers, ErrorFallsAsTheMeshIsRefined) {
  constexpr double gamma = 1;
  std::vector<ErrorPoint> points;
  for (const int r : {0, 1, 2})
    points.push_back({std::pow(0.5, r), errors_of(numbers_of(2, r, {2}, gamma).front(), gamma).h});
  EXPECT_NEAR(fit_order(points).order, 4, 0.5) << points[0].error << ' ' << points[1].error << ' ' << points[2].error;
}

}  // namespace
}  // namespace pseudorigid::testing
