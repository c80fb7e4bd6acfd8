/// Modes of the gravitating ball against the exact frequencies of the gravitating elastic sphere (PHYSICS 3),
/// γ = ρgr/μ with g = (4/3)πGρr.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "analysis/sphere_frequencies.h"
#include "continuum/modes/modes.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using namespace continuum;
using analysis::sphere_frequency;

std::vector<BallFrequency> modes(int degree, int n_refinements, int n_frequencies, double gamma, double kappa = 0,
                                 std::size_t most_coupled = 3000) {
  const BallSpace space(BallMesh({{true, true, true}}, n_refinements), degree);
  const StoredEnergy stored(materials::CiarletGeymonat{1, 0}, kappa);
  const auto kernels = make_cell_kernels(space, stored);
  const RestProblem problem(space, *kernels, stored, true, 3 * gamma / (4 * std::numbers::pi), most_coupled);
  std::vector<BallFrequency> frequencies;
  ModesReport report;
  const auto status = ball_modes(problem, n_frequencies, frequencies, report);
  EXPECT_TRUE(status) << status.reason();
  return frequencies;
}

/// Relative error of the mean of the copies, and the largest of the copies.
struct Error {
  double mean, largest;
};

Error error(const BallFrequency& f, double gamma) {
  const double exact = sphere_frequency(f.kind == ModeKind::spheroidal, f.degree, f.overtone, gamma);
  return {std::abs(f.omega / exact - 1), std::max(std::abs(f.least / exact - 1), std::abs(f.largest / exact - 1))};
}

Error error_of_S2(int degree, int n_refinements, double gamma, double kappa = 0) {
  for (const BallFrequency& f : modes(degree, n_refinements, 3, gamma, kappa))
    if (f.kind == ModeKind::spheroidal && f.degree == 2 && f.overtone == 0) return error(f, gamma);
  ADD_FAILURE() << "S2 is not among the lowest";
  return {1, 1};
}

TEST(GravitatingModes, EquationOfTheSphereIsThatWithoutGravityForNone) {
  EXPECT_NEAR(sphere_frequency(true, 2, 0, 0), 2.665622189236, 1e-12);
  EXPECT_NEAR(sphere_frequency(true, 2, 0, 1), 2.799400, 1e-6);
  EXPECT_NEAR(sphere_frequency(true, 2, 0, 5), 3.273115, 1e-6);
}

TEST(GravitatingModes, LowestSpheroidalModeIsExactToTheMesh) {
  for (const double gamma : {1.0, 5.0}) {
    const Error coarse = error_of_S2(4, 0, gamma), fine = error_of_S2(5, 0, gamma);
    std::printf("gamma = %g: S2 errs by %.2e at k = 4 (a copy by %.2e), by %.2e at k = 5 (%.2e)\n", gamma, coarse.mean,
                coarse.largest, fine.mean, fine.largest);
    EXPECT_LT(coarse.mean, 1e-6) << gamma;
    EXPECT_LT(fine.largest, 5e-7) << gamma;
  }
}

/// On fine meshes the matrix of self-gravity would be too large, and conjugate gradients take its place.
TEST(GravitatingModes, DoNotDependOnTheSolutionOfGravity) {
  const auto factorized = modes(3, 0, 6, 5), iterated = modes(3, 0, 6, 5, 0, 0);
  ASSERT_EQ(factorized.size(), iterated.size());
  for (std::size_t i = 0; i < factorized.size(); ++i)
    EXPECT_NEAR(factorized[i].omega / iterated[i].omega, 1, 1e-9) << i;
}

/// Degrees 2 to 4, toroidal ones among them, which gravity leaves alone; near 25 two of the spheroidal ones come close.
TEST(GravitatingModes, AllAreThoseOfTheSphereWhateverItsGravity) {
  for (const double gamma : {0.25, 25.0, 100.0}) {
    int n_toroidal = 0, n_spheroidal = 0;
    for (const BallFrequency& f : modes(4, 0, 10, gamma)) {
      if (f.degree < 2 || f.degree > 4) continue;
      EXPECT_LT(error(f, gamma).largest, 1e-3)
          << "gamma " << gamma << ", degree " << f.degree << ", overtone " << f.overtone;
      ++(f.kind == ModeKind::toroidal ? n_toroidal : n_spheroidal);
    }
    EXPECT_GE(n_toroidal, 3) << gamma;
    EXPECT_GE(n_spheroidal, 2) << gamma;
  }
}

/// Rigid motions are told by their field: the noise of strong gravity gives them frequencies of its own.
TEST(GravitatingModes, HaveNoRigidMotionAmongThem) {
  for (const BallFrequency& f : modes(3, 0, 6, 1e4)) EXPECT_GT(f.omega, 1.5) << f.degree;
}

/// The stabilisation stiffens what the pressure space leaves of a change of volume, and costs no order.
TEST(GravitatingModes, StabilisationLeavesTheRateOfConvergence) {
  for (const int k : {2, 3}) {
    std::vector<ErrorPoint> without, with;
    for (const int r : {3 - k, 4 - k}) {
      without.push_back({std::pow(0.5, r), error_of_S2(k, r, 0).largest});
      with.push_back({std::pow(0.5, r), error_of_S2(k, r, 0, 1).largest});
    }
    RecordProperty("without_" + std::to_string(k), std::to_string(fit_order(without).order));
    RecordProperty("with_" + std::to_string(k), std::to_string(fit_order(with).order));
    std::printf("k = %d: errors %.2e, %.2e without, %.2e, %.2e with\n", k, without[0].error, without[1].error,
                with[0].error, with[1].error);
    EXPECT_GE(fit_order(with).order, 2 * k - 0.3);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
