/// Viscoelastic branches of the finite elements: affine motions are those of the pseudo-rigid body, the force is the
/// derivative of the energy, and the flow takes the energy that it returns.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "materials/eigen_tensor.h"
#include "reduced/loaded_body.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

struct Branches : ::testing::TestWithParam<int> {
  static loads::Loads branched() {
    loads::Viscoelasticity branches;
    branches.moduli = {0.7, 3};
    branches.times = {2, 0.05};
    return loads::Loads(branches);
  }
  const CompressibleBall ball{quarter, GetParam(), 0, neo_hookean, branched()};
  std::mt19937 generator{5};

  Matrix3d deformation() { return admissible(quarter, Matrix3d::Identity() + 0.25 * random_matrix(generator)); }
  /// A position with irregular metrics. The noise is of the size of the distance between nodes.
  Vector irregular() {
    const double noise = 0.04 / (GetParam() + 1) / (GetParam() + 1);
    Vector x = ball.affine_field(Matrix3d::Identity()), y = x;
    ball.start_branches(false, x);
    y.add(noise, random_field(x, generator));
    y.metrics = x.metrics;
    relax(0.3, x, y);
    y.add(noise, random_field(x, generator));
    return y;
  }
  /// Replaces the metrics of x by those after the time h. Returns the energy that the whole ball loses.
  double relax(double h, const Vector& before, Vector& x) const {
    Vector v = ball.make_vector();
    ball.relax(h, before, x, v);
    const materials::BranchEnergies of_branches = ball.dissipated_by_branches(v);
    EXPECT_NEAR(of_branches[0] + of_branches[1], ball.dissipated(v), 1e-15);
    return ball.dissipated(v);
  }
  /// The force of the branches alone.
  Vector force(const Vector& x) const {
    Vector f = ball.make_vector();
    ball.kernels().add_branch_force(ball.branches(), x, f);
    return f;
  }
};

TEST_P(Branches, AffineMotionsAreThoseOfThePseudoRigidBody) {
  const auto reference = reduced::ReferenceBody::of_inertia(ball.E0(), ball.volume());
  using Body = reduced::PseudoRigidBody<CiarletGeymonat, false>;
  const reduced::LoadedBody<Body> body(Body(neo_hookean, reference), branched());
  const Matrix3d Q0 = deformation(), Q1 = deformation();
  const auto before = body.start({0, Q0, Matrix3d::Zero()}, Vector3d::Zero(), Vector3d::Zero());
  auto q = before.q;
  q.leftCols<3>() = Q1;
  Vector x0 = ball.affine_field(Q0), x = ball.affine_field(Q1);
  ball.start_branches(false, x);
  for (const double h : {0.01, 0.4}) {
    auto taken = body.make_vector();
    body.relax(h, before.q, q, taken);
    Vector v = ball.make_vector();
    ball.relax(h, x0, x, v);
    const double expected = body.dissipated({0, q, taken}), lost = ball.dissipated(v);
    EXPECT_NEAR(lost, expected, 1e-13 * (1 + expected));
    for (int b = 0; b < 2; ++b)
      EXPECT_NEAR(ball.dissipated_by_branches(v)[b], body.dissipated_by_branches({0, q, taken})[b],
                  1e-13 * (1 + expected));
    EXPECT_GT(lost, 0);
  }
  EXPECT_NEAR(ball.energy_of_branches(x), body.energy_of_branches(q), 1e-12);
  const Matrix3d expected = -reference.volume * body.stress_of_branches(q);
  EXPECT_LT((moment_of_force(ball, force(x)) - expected).norm(), 1e-12 * expected.norm());
}

TEST_P(Branches, ForceIsTheDerivativeOfTheEnergy) {
  const Vector x = irregular(), direction = random_field(x, generator);
  constexpr double h = 1e-6;
  Vector more = x, less = x;
  more.add(h, direction);
  less.add(-h, direction);
  const int n_images = ball.space().mesh().sector().n_images();
  const double slope = (ball.energy_of_branches(more) - ball.energy_of_branches(less)) / (2 * h * n_images);
  EXPECT_NEAR(force(x) * direction, -slope, 1e-6 * force(x).l2_norm());
}

TEST_P(Branches, FlowTakesTheEnergyThatItReturns) {
  const Vector x = irregular();
  Vector later = x;
  const double lost = relax(0.1, x, later);
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(ball.energy_of_branches(x) - ball.energy_of_branches(later), lost, 1e-12);
  EXPECT_EQ(mechanics::max_norm(later), mechanics::max_norm(x));
}

TEST_P(Branches, RelaxedBranchesHaveNoForce) {
  Vector x = irregular();
  ball.start_branches(true, x);
  EXPECT_LT(mechanics::max_norm(force(x)), 1e-13);
  EXPECT_LT(std::abs(ball.energy_of_branches(x)), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Branches, ::testing::Range(1, 9));

}  // namespace
}  // namespace pseudorigid::testing
