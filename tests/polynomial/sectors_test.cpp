/// A sector of the ball is the whole ball on motions with its symmetry: energies, momenta, forces, constraint and
/// reactions, for all eight choices of planes.

#include <gtest/gtest.h>

#include "polynomial/observe.h"
#include "polynomial/samples.h"

namespace pseudorigid::testing {
namespace {

template <class Body>
class Sectors : public ::testing::TestWithParam<int> {
 protected:
  static constexpr double time = 0.7, tolerance = 1e-12;

  static loads::Loads everything(const Planes& planes) {
    loads::Loads all;
    all.for_each([&]<class L>(L& load) {
      if (incompressible<Body> || !std::is_same_v<L, loads::SelfGravity>) load = with_entries<L>(planes);
    });
    return all;
  }
  static Body body(const Planes& planes, const loads::Loads& loads) {
    return Body(BodySetup{.degree = 3,
                          .reflect = planes,
                          .semi_axes = {1.2, 0.9, 1},
                          .law = materials::MooneyRivlin{1, 3, 0.3},
                          .volumetric_stiffness = 0.4,
                          .loads = loads});
  }

  static void expect_same_energies_and_momenta(const Body& sector, const Body& ball, const VectorXd& q,
                                               const VectorXd& v) {
    const VectorXd Q = in_whole_ball(sector, ball, q), V = in_whole_ball(sector, ball, v);
    EXPECT_NEAR(sector.kinetic_energy(v), ball.kinetic_energy(V), tolerance);
    const auto of_sector = sector.potential_energies(time, q), of_ball = ball.potential_energies(time, Q);
    EXPECT_NEAR(of_sector.elastic, of_ball.elastic, tolerance * of_ball.elastic);
    EXPECT_NEAR(of_sector.volumetric, of_ball.volumetric, tolerance * of_ball.elastic);
    EXPECT_NEAR(of_sector.external, of_ball.external, tolerance * of_ball.elastic);
    EXPECT_NEAR(of_sector.gravitational, of_ball.gravitational, tolerance * std::abs(of_ball.gravitational));
    EXPECT_LT((sector.space().moment(q, v) - ball.space().moment(Q, V)).norm(), tolerance);
    EXPECT_LT((sector.space().affine_part(v) - ball.space().affine_part(V)).norm(), tolerance);
    EXPECT_LT((sector.space().mean(v) - ball.space().mean(V)).norm(), tolerance);
  }

  /// Forces agree, and the ball's have no part without the symmetry.
  static void expect_same_force(const Body& sector, const Body& ball, const VectorXd& f, const VectorXd& F) {
    VectorXd rest = F;
    for_each_coefficient(sector.space(), ball.space(), [&](int of_sector, int of_ball) {
      EXPECT_NEAR(f[of_sector], F[of_ball], tolerance * F.norm());
      rest[of_ball] = 0;
    });
    const int n = ball.space().n_unknowns();
    EXPECT_LT(rest.head(n).norm(), tolerance * F.norm());
    EXPECT_LT((f.tail(2) - F.tail(2)).norm(), tolerance * F.norm()) << "energies taken and given";
  }
};
using Bodies = ::testing::Types<IncompressibleBody, CompressibleBody>;
TYPED_TEST_SUITE(Sectors, Bodies);

TYPED_TEST(Sectors, AreTheWholeBallOnSymmetricMotions) {
  std::mt19937 generator(1);
  for (const Planes& planes : all_sectors()) {
    SCOPED_TRACE(::testing::PrintToString(planes));
    const auto loads = this->everything(planes);
    const auto sector = this->body(planes, loads), ball = this->body(no_planes, loads);
    const VectorXd q = random_position(sector, generator), v = random_direction(sector, generator);
    const VectorXd Q = in_whole_ball(sector, ball, q), V = in_whole_ball(sector, ball, v);
    this->expect_same_energies_and_momenta(sector, ball, q, v);

    auto workspace = sector.make_workspace();
    auto of_ball = ball.make_workspace();
    VectorXd f = sector.make_vector(), F = ball.make_vector();
    ASSERT_TRUE(sector.force(this->time, q, v, workspace, f));
    ASSERT_TRUE(ball.force(this->time, Q, V, of_ball, F));
    this->expect_same_force(sector, ball, f, F);
  }
}

TEST(SectorConstraint, IsThatOfTheWholeBall) {
  std::mt19937 generator(2);
  const IncompressibleBody ball(BodySetup{.degree = 4});
  for (const Planes& planes : all_sectors()) {
    const IncompressibleBody sector(BodySetup{.degree = 4, .reflect = planes});
    const VectorXd q = random_position(sector, generator), v = random_direction(sector, generator);
    const VectorXd Q = in_whole_ball(sector, ball, q), V = in_whole_ball(sector, ball, v);
    const VectorXd lambda = random_vector(sector.space().n_pressures(), generator);
    VectorXd Lambda = ball.make_multiplier(), g = sector.make_multiplier(), G = Lambda;
    const auto place = [&](int b) { return sector.space().pressure_place(b); };
    const auto expect_same = [&](const char* what) {
      for (int b = 0; b < ball.space().n_functions(); ++b) {
        const int of_ball = ball.space().pressure_place(b);
        if (of_ball < 0) continue;
        EXPECT_NEAR(G[of_ball], place(b) >= 0 ? g[place(b)] : 0, 1e-12) << what;
      }
    };
    ASSERT_TRUE(sector.constraint(q, g));
    ASSERT_TRUE(ball.constraint(Q, G));
    expect_same("constraint");
    sector.constraint_rate(q, v, g);
    ball.constraint_rate(Q, V, G);
    expect_same("rate");
    sector.constraint_curvature(q, v, g);
    ball.constraint_curvature(Q, V, G);
    expect_same("curvature");

    for (int b = 0; b < ball.space().n_functions(); ++b)
      if (place(b) >= 0) Lambda[ball.space().pressure_place(b)] = lambda[place(b)];
    VectorXd f = sector.make_vector(), F = ball.make_vector();
    sector.add_reaction(q, lambda, f);
    ball.add_reaction(Q, Lambda, F);
    EXPECT_LT((in_whole_ball(sector, ball, f) - F).norm(), 1e-12 * F.norm());
    f.setZero();
    F.setZero();
    sector.add_reaction_rate(q, v, lambda, f);
    ball.add_reaction_rate(Q, V, Lambda, F);
    EXPECT_LT((in_whole_ball(sector, ball, f) - F).norm(), 1e-12 * F.norm());
  }
}

/// Asked for, they are numbers of the state that was observed, and stay so when it is gone.
TEST(Stretches, AreThoseOfTheStateObserved) {
  const IncompressibleBody body({.degree = 3});
  mechanics::ObservableRequest request;
  request.multiplier = false;
  request.over_points = {{.largest = true,
                          .value = [](const Matrix3d& F) { return mechanics::singular_values(F)[0]; },
                          .bound = mechanics::largest_singular_value_bound},
                         {.largest = false,
                          .value = [](const Matrix3d& F) { return mechanics::singular_values(F)[2]; },
                          .bound = mechanics::least_singular_value_bound}};
  mechanics::ContinuumObservables o;
  {
    const polynomial::BodyState state{0, body.affine(Vector3d(1.25, 1, 0.8).asDiagonal()), body.make_vector()};
    auto workspace = body.make_workspace();
    ASSERT_TRUE(polynomial::observe(body, state, workspace, request, o));
  }
  ASSERT_EQ(o.over_points.size(), 2u);
  EXPECT_NEAR(o.over_points[0], 1.25, 1e-14);
  EXPECT_NEAR(o.over_points[1], 0.8, 1e-14);
}

}  // namespace
}  // namespace pseudorigid::testing
