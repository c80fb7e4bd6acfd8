/// Loads and dissipation on the finite-element ball, compressible or not: restricted to x = x_c + QX they are those of
/// the pseudo-rigid body and its centre of mass (PHYSICS 7.3), every law included; what they do to moments and momenta
/// on motions that are not affine (PHYSICS 7.1).

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "materials/law_table.h"
#include "reduced/center_of_mass.h"
#include "reduced/dissipative_body.h"
#include "reduced/observe.h"
#include "reduced/potential.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

template <class Ball>
inline constexpr bool incompressible = std::is_same_v<Ball, ElasticBall>;

/// The ball's pseudo-rigid twin, with the inertia, volume and mass of its mesh.
template <class Ball>
auto twin_of(const Ball& ball, const materials::AnyLaw& law, loads::Loads loads) {
  if (incompressible<Ball>) loads = loads::at_constant_volume(loads);
  const loads::Forcing forcing = loads::constant_forcing(loads);
  const reduced::ReferenceBody reference{ball.E0(), ball.volume(), ball.mass()};
  using Body = reduced::PseudoRigidBody<reduced::Potential, incompressible<Ball>>;
  return reduced::DissipativeBody<Body>({reduced::Potential(law, reference, forcing), reference},
                                        reduced::Dissipation::of(forcing), loads);
}

template <class Ball>
class LoadedTwin : public ::testing::Test {
 protected:
  static constexpr double tolerance = 1e-12;

  /// The ball and its twin at one state: moment and resultant of the force, power, energies.
  void compare(const Ball& ball, const materials::AnyLaw& law, const loads::Loads& loads, std::mt19937& generator) {
    const Sector& sector = ball.space().mesh().sector();
    const Matrix3d Q = admissible(sector, Matrix3d::Identity() + 0.3 * random_matrix(generator));
    const Matrix3d Qdot = admissible(sector, random_matrix(generator));
    Vector3d center = random_matrix(generator).col(0), velocity = random_matrix(generator).col(0);
    for (int i = 0; i < 3; ++i)
      if (sector.reflect[i]) center[i] = velocity[i] = 0;
    const double t = 0.4;
    const continuum::BallState state{t, ball.affine_field(Q, center), ball.affine_field(Qdot, velocity)};

    const auto twin = twin_of(ball, law, loads);
    const auto twin_state = twin.state_of({t, Q, Qdot});
    typename std::decay_t<decltype(twin)>::Workspace twin_workspace;
    auto expected = twin.make_vector();
    ASSERT_TRUE(twin.force(t, twin_state.q, twin_state.v, twin_workspace, expected));
    auto workspace = ball.make_workspace();
    Vector f = ball.make_vector();
    ASSERT_TRUE(ball.force(t, state.q, state.v, workspace, f));
    const Matrix3d moment = twin.matrix(expected);
    EXPECT_LT((moment_of_force(ball, f) - moment).norm(), tolerance * (1 + moment.norm()));

    ball.apply_inverse_mass(f, f);
    loads::Forcing forcing = loads::constant_forcing(loads);
    forcing += loads::driving(loads, t);
    const Vector3d center_acceleration =
        forcing.acceleration - forcing.quadratic * center - forcing.drag * velocity;  // center_of_mass.h
    EXPECT_LT((ball.mean(f) - center_acceleration).norm(), tolerance);
    const double drag_on_center = forcing.drag * ball.mass() * velocity.squaredNorm();
    EXPECT_NEAR(ball.dissipated(f), expected(0, 3) + drag_on_center, tolerance * (1 + expected(0, 3)));
    const loads::Forcing rate = loads::driving_rate(loads, t);
    const double given_to_center =
        ball.mass() * (0.5 * center.dot(rate.quadratic * center) - rate.acceleration.dot(center));
    EXPECT_NEAR(ball.given(f), expected(1, 3) + given_to_center, tolerance * (1 + std::abs(expected(1, 3))));

    const auto o = observed(ball, state, {{.multiplier = false}});
    mechanics::ReducedObservables of_twin;
    ASSERT_TRUE(reduced::observe(twin, twin_state, twin_workspace, {{.multiplier = false}}, of_twin));
    const reduced::CenterOfMass at_center{
        .position = center, .velocity = velocity, .acceleration = forcing.acceleration, .quadratic = forcing.quadratic};
    EXPECT_NEAR(o.elastic, of_twin.elastic, tolerance * (1 + std::abs(of_twin.elastic)));
    EXPECT_NEAR(o.external, of_twin.external + ball.mass() * at_center.potential({center, velocity}), tolerance * 10);
    EXPECT_NEAR(o.kinetic, of_twin.kinetic + 0.5 * ball.mass() * velocity.squaredNorm(), tolerance * 10);
    EXPECT_LT((o.center - center).norm() + (o.velocity - velocity).norm(), tolerance);
    EXPECT_LT((o.Q - Q).norm() + (o.Qdot - Qdot).norm() + (o.F - Q).norm(), tolerance);
    EXPECT_LT((o.angular_momentum - of_twin.angular_momentum).norm(), tolerance);
    EXPECT_LT(o.nonaffine_kinetic_fraction + o.nonaffine_displacement, tolerance);
  }
};

using BothBalls = ::testing::Types<ElasticBall, CompressibleBall>;
TYPED_TEST_SUITE(LoadedTwin, BothBalls);

TYPED_TEST(LoadedTwin, EveryLawUnderEachLoadAndAllOfThem) {
  std::mt19937 generator(1);
  const loads::Loads all = all_loads();
  std::vector<loads::Loads> cases{{}, all};
  all.for_each([&](const auto& load) {
    if (loads::present(load)) cases.emplace_back(load);
  });
  cases.push_back(all);
  cases.back().get<loads::Rise>() = {1};
  for (const auto& law : materials::law_table) {
    if (law.name == "none") continue;
    const materials::AnyLaw made =
        law.make({.shear_modulus = 1.3, .lame_lambda = 0.8, .mooney_fraction = 0.3}, incompressible<TypeParam>);
    for (const loads::Loads& loads : cases) {
      SCOPED_TRACE(law.name);
      const TypeParam ball(whole, 2, 0, made, loads);
      this->compare(ball, made, loads, generator);
    }
  }
}

TYPED_TEST(LoadedTwin, SectorsDegreesAndRefinedMeshes) {
  std::mt19937 generator(2);
  const materials::AnyLaw law = ciarlet_geymonat;
  for (const Sector& sector : all_sectors)
    for (int degree = incompressible<TypeParam> ? 2 : 1; degree <= 6; ++degree) {
      const loads::Loads loads = all_loads(sector);
      this->compare(TypeParam(sector, degree, 0, law, loads), law, loads, generator);
    }
  const loads::Loads loads = all_loads(octant);
  this->compare(TypeParam(octant, 3, 1, law, loads), law, loads, generator);
}

TYPED_TEST(LoadedTwin, NothingOfTheLoadsIsThereWithoutThem) {
  const TypeParam plain(octant, 2, 0, neo_hookean), loaded(octant, 2, 0, neo_hookean, {loads::Drag{0.1}});
  EXPECT_FALSE(plain.dissipative() || plain.velocity_dependent() || plain.space().account());
  EXPECT_TRUE(loaded.dissipative() && loaded.velocity_dependent());
  EXPECT_EQ(loaded.make_vector().size(), plain.make_vector().size() + 3);
}

scene::Matrix3 rows(const Matrix3d& A) {
  scene::Matrix3 result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i][j] = A(i, j);
  return result;
}

/// A compressible ball under loads of every kind, away from affine states, and one step of RATTLE.
struct LoadedStep : ::testing::Test {
  static constexpr double h = 0.002;  // the viscous iteration converges
  const loads::Forcing loads{
      .quadratic = (Matrix3d() << 0.6, 0.1, 0, 0.1, 0.3, -0.15, 0, -0.15, 0.2).finished(),
      .acceleration = Vector3d(0.3, -0.2, 0.1),
      .nominal_traction = (Matrix3d() << 0.4, 0.1, -0.2, 0.3, -0.1, 0.15, 0.05, -0.25, 0.2).finished(),
      .viscosity = 0.07,
      .drag = 0.11};
  const CompressibleBall ball{
      whole,
      3,
      0,
      neo_hookean,
      {loads::Tide{rows(loads.quadratic)}, loads::Acceleration{{0.3, -0.2, 0.1}},
       loads::Traction{rows(loads.nominal_traction)}, loads::Viscosity{loads.viscosity}, loads::Drag{loads.drag}}};
  mechanics::RattleWorkspace<CompressibleBall> workspace{ball};
  continuum::BallState before, after;

  void SetUp() override {
    Matrix3d Q, L;
    Q << 1.1, 0.2, 0, -0.1, 0.9, 0.15, 0.05, 0, 1;
    L << 0.2, -0.7, 0.3, 0.8, -0.3, 0.2, -0.1, 0.4, 0.1;
    before = {0, ball.affine_field(Q, Vector3d(0.3, -0.1, 0.2)), ball.affine_field(L * Q, Vector3d(-0.2, 0.4, 0.1))};
    for (int i = 0; i < 150; ++i) advance(before);
    after = before;
    advance(after);
    ASSERT_GT(observed(ball, before).nonaffine_displacement, 1e-3);
  }
  void advance(continuum::BallState& state) {
    const auto status = mechanics::Rattle::advance(ball, h, state, workspace);
    ASSERT_TRUE(status) << status.reason();
  }

  Matrix3d moment(const Vector& field) const { return ball.nodal_moment(field, ball.space().reference_positions()); }
  /// ∫P − traction − body forces, the right-hand side of PHYSICS 7.1 less the viscous stress, none of it by the force.
  Matrix3d applied_moment(const continuum::BallState& s) const {
    const auto& kernels = ball.kernels();
    const Vector& X = ball.space().reference_positions();
    Vector one = ball.space().make_multiplier(), rate = one;
    kernels.constraint_rate(X, X, one);
    one /= 3;
    Matrix3d inverse_transposed;  // ∫F⁻ᵀ
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const Matrix3d unit = Vector3d::Unit(i) * Vector3d::Unit(j).transpose();
        kernels.constraint_rate(s.q, ball.affine_field(unit), rate);
        inverse_transposed(i, j) = one * rate;
      }
    const Matrix3d stress = ball.volume() * observed(ball, s).F - inverse_transposed;  // neo-Hookean, P = F − F⁻ᵀ
    return -stress + ball.volume() * loads.nominal_traction - loads.quadratic * moment(s.q) - loads.drag * moment(s.v);
  }
  Vector viscous_force(const continuum::BallState& s) const {
    Vector f = ball.make_vector();
    ball.kernels().add_viscous_force(loads.viscosity, s.q, s.v, f);
    return f;
  }
  /// Σ (x_n − 0) × f_n of the loads: elasticity and viscosity have no torque.
  Vector3d torque(const continuum::BallState& s) const {
    const Matrix3d second = ball.nodal_moment(s.q, s.q);
    const Vector3d center = ball.mean(s.q);
    const Matrix3d xf = -second * loads.quadratic + ball.mass() * center * loads.acceleration.transpose() -
                        loads.drag * ball.nodal_moment(s.q, s.v) +
                        ball.volume() * observed(ball, s).F * loads.nominal_traction.transpose();
    return mechanics::axial_vector(xf);
  }
};

TEST_F(LoadedStep, ObeysTheIdentityOfMoments) {
  const Matrix3d left = moment(after.v) - moment(before.v);
  const Matrix3d viscous = moment_of_force(ball, viscous_force(before)) + moment_of_force(ball, viscous_force(after));
  const Matrix3d right = h / 2 * (applied_moment(before) + applied_moment(after) + viscous);
  EXPECT_GT(left.norm(), 1e-3);
  EXPECT_LT((left - right).norm(), 1e-13);
}

TEST_F(LoadedStep, BalancesTheAngularMomentum) {
  const auto J = [&](const continuum::BallState& s) { return mechanics::axial_vector(ball.nodal_moment(s.q, s.v)); };
  const Vector3d change = J(after) - J(before);
  EXPECT_GT(change.norm(), 1e-3);
  EXPECT_LT((change - h / 2 * (torque(before) + torque(after))).norm(), 1e-13);
}

TEST_F(LoadedStep, MovesTheCenterOfMassAsOnePoint) {
  const auto acceleration = [&](const continuum::BallState& s) {
    return Vector3d(loads.acceleration - loads.quadratic * ball.mean(s.q) - loads.drag * ball.mean(s.v));
  };
  const Vector3d change = ball.mean(after.v) - ball.mean(before.v);
  EXPECT_LT((change - h / 2 * (acceleration(before) + acceleration(after))).norm(), 1e-15);
}

/// The whole ball and the sectors move alike.
TEST(LoadedSectors, MoveAsTheWholeBall) {
  loads::Loads loads = all_loads(quarter);
  loads.get<loads::Viscosity>().viscosity = 0.03;
  const auto end_of = [&](const Sector& sector) {
    const ElasticBall ball(sector, 2, 0, neo_hookean, loads);
    continuum::BallState start = affine_state(ball, diagonal(1.2, 1, 1 / 1.2), diagonal(0.24, 0.1, -0.3 / 1.2));
    start.q.add(1.0, ball.affine_field(Matrix3d::Zero(), Vector3d(0, 0, 0.3)));
    const auto r = run<mechanics::Rattle>(ball, start, 0.5, 1, 50);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    return observed(ball, r.last());
  };
  const auto expected = end_of(whole), o = end_of(quarter);
  EXPECT_GT(expected.dissipated, 1e-2);
  EXPECT_NEAR(o.dissipated, expected.dissipated, 1e-12);
  EXPECT_NEAR(o.external, expected.external, 1e-12);
  EXPECT_LT((o.Q - expected.Q).norm() + (o.center - expected.center).norm(), 1e-12);
}

}  // namespace
}  // namespace pseudorigid::testing
