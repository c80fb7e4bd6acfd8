/// The stages of Gauss collocation in lanes: the same as one after the other, for every law and form of the body;
/// gravity in lanes; what the method keeps; its order with viscosity, drag and a periodic tide.

#include <gtest/gtest.h>

#include <random>

#include "gravity/ellipsoid_gravity.h"
#include "loads/periodic_tide.h"
#include "materials/eigen_tensor.h"
#include "reduced/diagonal_body.h"
#include "reduced/dissipative_body.h"
#include "reduced/gravity_in_lanes.h"
#include "reduced/potentials.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using mechanics::Gauss16;
using mechanics::GaussStages;
using mechanics::OfStages;
using reduced::ReferenceBody;

/// Largest difference of the stages' accelerations, in units of the largest acceleration.
template <class S>
double difference_of_stages(const S& system, const State<S>& state) {
  const auto n = static_cast<std::size_t>(state.q.size());
  mechanics::GaussTables tables;
  tables.set_step(0.2);
  std::vector<OfStages> in_lanes(n, OfStages{}), one_by_one(n, OfStages{}), sums(n),
      scratch(GaussStages::n_scratch * n);
  GaussStages stages{.n = static_cast<int>(n),
                     .t = 0.3,
                     .h = 0.2,
                     .q = state.q.data(),
                     .v = state.v.data(),
                     .tables = &tables,
                     .outer_h = 0.2,
                     .a = in_lanes.data(),
                     .sums = sums.data(),
                     .scratch = scratch.data()};
  const auto field = mechanics::field_of(system);
  EXPECT_TRUE(field.solve_stages_in_lanes(stages));
  EXPECT_TRUE(stages.converged);
  EXPECT_GT(stages.n_iterations, 3);
  stages.a = one_by_one.data();
  auto workspace = field.make_workspace();
  const mechanics::detail::StageByStage<std::remove_cvref_t<decltype(field)>> by_stage(field, workspace);
  mechanics::solve_gauss_stages(by_stage, stages);
  EXPECT_TRUE(stages.converged) << by_stage.reason().reason();
  double difference = 0;
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < 8; ++i)
      difference = std::max(difference, std::abs(in_lanes[k][i] - one_by_one[k][i]) / stages.scale);
  return difference;
}

constexpr double round_off = 1e-14;

template <class Body>
void expect_same_stages(const materials::AnyLaw& law, std::string_view name) {
  SCOPED_TRACE(name);
  const ReferenceBody ball = ReferenceBody::unit_ball(), ellipsoid = ReferenceBody::ellipsoid({1.2, 1, 0.9});
  const loads::Forcing generic{.gravity_constant = 0.3,
                               .quadratic = generic_quadratic(),
                               .nominal_traction = generic_traction(),
                               .pressure = 0.2};
  loads::Forcing along_axes = generic;
  along_axes.quadratic = Matrix3d(generic.quadratic.diagonal().asDiagonal());
  along_axes.nominal_traction = Matrix3d(generic.nominal_traction.diagonal().asDiagonal());
  const auto body = [&](const ReferenceBody& reference, const loads::Forcing& forcing) {
    return Body(reduced::Potential(law, reference, forcing), reference);
  };
  const auto start = benchmark_state<Body>();
  EXPECT_LT(difference_of_stages(body(ball, {}), start), round_off);
  EXPECT_LT(difference_of_stages(body(ball, generic), start), round_off);
  EXPECT_LT(difference_of_stages(body(ellipsoid, generic), start), round_off);
  const reduced::DiagonalBody<Body> diagonal_form(body(ellipsoid, along_axes));
  EXPECT_LT(difference_of_stages(diagonal_form, {0, {1.3, 1, 1 / 1.3}, {0.3, -0.1, -0.13}}), round_off);
  loads::PeriodicTide tide{.frequency = 2.3, .phase = 0.4};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) tide.amplitude[i][j] = generic_quadratic()(i, j);
  const reduced::DissipativeBody<Body> damped(body(ellipsoid, generic), {.viscosity = 0.1, .drag = 0.2},
                                              loads::Loads{tide});
  EXPECT_LT(difference_of_stages(damped, damped.state_of(start)), round_off);
}

TEST(StagesInLanes, AreThoseOfEachStageForEveryLawAndForm) {
  for (const auto& [name, law] : laws(true)) expect_same_stages<LoadedSl3>(law, name);
  for (const auto& [name, law] : laws(false)) expect_same_stages<LoadedGl3>(law, name);
}

TEST(StagesInLanes, LeaveFlatBodiesWithGravityToThePrincipalAxes) {
  const auto body = fluid_sl3({.G = fluid_time_G});
  const auto flat = moving<LoadedSl3>(spheroid(0.02), Matrix3d::Zero());
  mechanics::GaussStages stages{.q = flat.q.data(), .v = flat.v.data()};
  EXPECT_FALSE(body.solve_stages_in_lanes(stages));
}

/// Against the force by principal axes, on random deformations with ratios of the axes up to what lanes are used for.
TEST(GravityInLanes, IsThatOfThePrincipalAxes) {
  std::mt19937 generator(1);
  const auto random = [&] { return static_cast<double>(generator()) / 0x1p31 - 1; };
  for (const double ratio : {1.0, 1.0 + 1e-9, 1.01, 1.5, 4.0, 8.0})
    for (int n = 0; n < 200; ++n) {
      const Matrix3d U = Eigen::Quaterniond(random(), random(), random(), random()).normalized().toRotationMatrix(),
                     V = Eigen::Quaterniond(random(), random(), random(), random()).normalized().toRotationMatrix();
      const double size = std::log(ratio) / 2;
      const Matrix3d F = U * diagonal(std::exp(size), std::exp(size * random()), std::exp(-size)) * V.transpose();
      const Matrix3d exact = gravity::EllipsoidGravity{1.7}.gradient(F);
      const Matrix3d found = materials::to_matrix(reduced::ellipsoid_force(
          1.7, materials::to_tensor(F), [](double x) { return std::sqrt(x); }, [](double x) { return x; }));
      EXPECT_LT((found - exact).norm(), 3e-14 * exact.norm()) << ratio;
    }
}

TEST(Gauss16OnBodies, KeepsMomentaVolumeAndEnergyToRoundOff) {
  const Sl3 body = neo_hookean_sl3();
  const auto start = benchmark_state<Sl3>();
  const auto before = observed(body, start);
  const auto r = run<Gauss16>(body, start, 2000, 500, 16);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  for (const auto& s : r.states) {
    const auto o = observed(body, s);
    EXPECT_LT((o.angular_momentum - before.angular_momentum).norm(), 1e-13);
    EXPECT_LT((o.circulation - before.circulation).norm(), 1e-13);
    EXPECT_NEAR(o.energy(), before.energy(), 1e-12);
    EXPECT_LT(std::abs(s.q.determinant() - 1), 1e-14);
    EXPECT_LT(std::abs((s.q.inverse() * s.v).trace()), 1e-14);
  }
}

/// Stages iterated to what a tolerance of the configuration needs: fewer iterations, another motion by a part of the
/// tolerance, energy and momenta kept to it.
TEST(Gauss16OnBodies, EndsTheIterationAtWhatTheToleranceNeeds) {
  const Sl3 body = neo_hookean_sl3();
  const auto start = benchmark_state<Sl3>();
  constexpr double end = 100;
  constexpr long n_steps = 400;
  const auto move = [&](double iteration_tolerance) {
    mechanics::Gauss16Workspace<Sl3> w(body);
    w.iteration_tolerance = iteration_tolerance;
    auto state = start;
    for (long k = 0; k < n_steps; ++k) EXPECT_TRUE(Gauss16::advance(body, end / n_steps, state, w));
    return std::pair(state, static_cast<double>(w.counters.n_force));
  };
  const auto [exact, n_exact] = move(0);
  for (const double tolerance : {1e-10, 1e-8, 1e-6, 1e-4}) {
    SCOPED_TRACE(tolerance);
    const auto [state, n] = move(Gauss16::iteration_tolerance(tolerance, end));
    EXPECT_LT((state.q - exact.q).cwiseAbs().maxCoeff(), tolerance / 6);
    EXPECT_GT((state.q - exact.q).cwiseAbs().maxCoeff(), tolerance * 1e-4);
    EXPECT_LT(n, (tolerance < 1e-9 ? 0.95 : 0.8) * n_exact);
    const auto found = observed(body, state), wanted = observed(body, start);
    EXPECT_NEAR(found.energy(), wanted.energy(), tolerance / 10);
    EXPECT_LT((found.angular_momentum - wanted.angular_momentum).norm(), tolerance / 10);
  }
}

TEST(Gauss16OnBodies, ReturnsWhereItCameFrom) {
  const Sl3 body = neo_hookean_sl3();
  const auto start = benchmark_state<Sl3>();
  const auto there = run<Gauss16>(body, start, 10, 1, 40);
  ASSERT_TRUE(there.finished());
  auto turned = there.last();
  turned.v = -turned.v;
  auto back = run<Gauss16>(body, turned, 10, 1, 40).last();
  back.v = -back.v;
  EXPECT_GT(distance(there.last(), start), 0.1);
  EXPECT_LT(distance(back, start), 1e-12);
}

/// With viscosity, drag and a tide that depends on time: the order, and the balance of the energy. The steps are those
/// between where the method begins to resolve the motion and round-off, as found by trial.
TEST(Gauss16OnBodies, HasItsOrderWhereEnergyIsNotConstant) {
  using Damped = reduced::DissipativeBody<LoadedSl3>;
  loads::PeriodicTide tide{.frequency = 2.3, .phase = 0.4};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) tide.amplitude[i][j] = 0.5 * generic_quadratic()(i, j);
  const LoadedSl3 body = elastic_sl3({.G = weak_gravity});
  const Damped damped(body, {.viscosity = 0.05, .drag = 0.05}, loads::Loads{tide});
  const auto start = damped.state_of(benchmark_state<LoadedSl3>());
  constexpr double end = 3;
  const auto reference = run<Gauss16>(damped, start, end, 1, 30);
  ASSERT_TRUE(reference.finished()) << reference.result.reason;
  std::vector<ErrorPoint> points;
  for (const long n : {5, 6, 7, 8, 9}) {
    const auto r = run<Gauss16>(damped, start, end, 1, n);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    ASSERT_EQ(r.counters.n_substeps, n) << "a step has been halved";
    points.push_back({end / static_cast<double>(n), distance(r.last(), reference.last())});
  }
  const auto fit = fit_order(points);
  EXPECT_GE(fit.n_used, 4u);
  EXPECT_GE(fit.order, 12);
  const auto energy = [&](const State<Damped>& s) {
    const auto motion = damped.motion(s);
    return body.kinetic_energy(motion.v) + body.potential_energy(motion.q) + damped.dissipated(s) +
           damped.driven_energy(s);
  };
  EXPECT_GT(damped.dissipated(reference.last()), 0.1);
  EXPECT_NEAR(energy(reference.last()), energy(start), 1e-12);
}

}  // namespace
}  // namespace pseudorigid::testing
