/// largest_frequency against dense eigenvalue problems.

#include "mechanics/steps/largest_frequency.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/toy_systems.h"
#include "support/dense.h"

namespace pseudorigid {
namespace {

using mechanics::State;
using testing::SpringNetwork;

constexpr int n_masses = 8;

/// Masses 1, 1.1, 1.2, … between walls, joined by springs of stiffness 2, 2.3, 2.6, …
Eigen::VectorXd masses() { return Eigen::VectorXd::LinSpaced(n_masses, 1, 1.7); }
Eigen::MatrixXd chain_stiffness() {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n_masses, n_masses);
  for (int i = 0; i <= n_masses; ++i) {
    const double k = 2 + 0.3 * i;
    if (i > 0) K(i - 1, i - 1) += k;
    if (i < n_masses) K(i, i) += k;
    if (i > 0 && i < n_masses) K(i, i - 1) = K(i - 1, i) = -k;
  }
  return K;
}

/// ω of K restricted to the span of the columns of B.
double largest_frequency_on(const Eigen::MatrixXd& B) {
  const Eigen::MatrixXd M = masses().asDiagonal();
  return std::sqrt(
      testing::generalized_eigenvalues(B.transpose() * chain_stiffness() * B, B.transpose() * M * B).maxCoeff());
}

double estimate(const SpringNetwork& system, int n_iterations, double scale_of_q = 1) {
  State<SpringNetwork> state{0, system.make_vector(), system.make_vector()};
  state.q.setConstant(scale_of_q);
  SpringNetwork::Workspace workspace;
  const auto report = mechanics::largest_frequency(system, state, workspace, n_iterations);
  EXPECT_TRUE(report.status) << report.status.reason();
  return report.omega;
}

TEST(LargestFrequency, OfAChain) {
  const SpringNetwork chain(masses().cwiseInverse(), chain_stiffness());
  const double exact = largest_frequency_on(Eigen::MatrixXd::Identity(n_masses, n_masses));
  EXPECT_NEAR(estimate(chain, n_masses), exact, 1e-8 * exact);
  EXPECT_NEAR(estimate(chain, 50), exact, 1e-8 * exact) << "iterations beyond the number of modes";
}

TEST(LargestFrequency, IncrementFollowsTheScaleOfThePosition) {
  const SpringNetwork chain(masses().cwiseInverse(), chain_stiffness());
  const double exact = largest_frequency_on(Eigen::MatrixXd::Identity(n_masses, n_masses));
  for (const double scale : {0.0, 1e-9, 1e9}) EXPECT_NEAR(estimate(chain, n_masses, scale), exact, 1e-8 * exact);
}

TEST(LargestFrequency, FewIterationsComeNearAndNotFarBelow) {
  const SpringNetwork chain(masses().cwiseInverse(), chain_stiffness());
  const double exact = largest_frequency_on(Eigen::MatrixXd::Identity(n_masses, n_masses));
  for (int n = 3; n < n_masses; ++n) {
    EXPECT_GE(estimate(chain, n), exact * 0.99) << n << " iterations";
    EXPECT_LE(estimate(chain, n), exact * 1.3) << n << " iterations";
  }
}

TEST(LargestFrequency, OnTheTangentSpaceOfConstraints) {
  Eigen::MatrixXd A(2, n_masses);  // the stiffest end is tied to its neighbours
  A << 0, 0, 0, 0, 0, 1, -1, 0, /**/ 0, 0, 0, 0, 1, 1, 0, -1;
  const SpringNetwork chain(masses().cwiseInverse(), chain_stiffness(), A);
  const Eigen::MatrixXd tangent = testing::kernel(A);
  const double exact = largest_frequency_on(tangent);
  ASSERT_LT(exact, 0.98 * largest_frequency_on(Eigen::MatrixXd::Identity(n_masses, n_masses)));
  EXPECT_NEAR(estimate(chain, n_masses, 0), exact, 1e-8 * exact);
}

TEST(LargestFrequency, SurvivesComponentsThatAreHeldFixed) {
  Eigen::VectorXd inverse_mass = masses().cwiseInverse();
  inverse_mass(3) = inverse_mass(7) = 0;
  Eigen::MatrixXd free = Eigen::MatrixXd::Zero(n_masses, 6);
  for (int j = 0, i = 0; i < n_masses; ++i)
    if (inverse_mass(i) > 0) free(i, j++) = 1;
  const double exact = largest_frequency_on(free);
  EXPECT_NEAR(estimate(SpringNetwork(inverse_mass, chain_stiffness()), n_masses), exact, 1e-8 * exact);
}

TEST(LargestFrequency, IsZeroWhereNothingOscillates) {
  const SpringNetwork free(masses().cwiseInverse(), Eigen::MatrixXd::Zero(n_masses, n_masses));
  EXPECT_EQ(estimate(free, 5), 0);
  const SpringNetwork unstable(masses().cwiseInverse(), -chain_stiffness());
  EXPECT_LT(estimate(unstable, n_masses), 1e-3);
  const SpringNetwork tied(masses().cwiseInverse(), chain_stiffness(), Eigen::MatrixXd::Identity(n_masses, n_masses));
  EXPECT_LT(estimate(tied, n_masses, 0), 1e-3);
}

TEST(LargestFrequency, TakesTheReactionIntoAccount) {
  // Small swings of a pendulum of unit length in unit gravity: ω = 1 about the lowest point, all of it due to λ.
  const testing::SphericalPendulum pendulum;
  testing::SphericalPendulum::Workspace workspace;
  const auto report = mechanics::largest_frequency(pendulum, {0, {0, 0, -1}, {0, 0, 0}}, workspace, 4);
  EXPECT_NEAR(report.omega, 1, 1e-9);
}

TEST(LargestFrequency, ReportsAForceThatFails) {
  const testing::SphericalPendulum pendulum(testing::SphericalPendulum::Trouble::failure, 0);
  testing::SphericalPendulum::Workspace workspace;
  const auto report = mechanics::largest_frequency(pendulum, {0, {0, 0, -1}, {0, 0, 0}}, workspace, 4);
  EXPECT_EQ(report.status.reason(), "the rope is cut");
}

}  // namespace
}  // namespace pseudorigid
