/// Nearly incompressible polynomial bodies: a projected bulk term that methods integrate implicitly. Degree 1 has one
/// value of det F, so its projection is exact, and the body of the pointwise law is the reference.

#include <gtest/gtest.h>

#include "mechanics/core/memory.h"
#include "mechanics/steps/largest_frequency.h"
#include "mechanics/steps/slow_motion.h"
#include "mechanics/steps/step_size.h"
#include "polynomial/motions.h"
#include "support/conserved.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

IncompressibleBody body_with_bulk(double lambda, const Planes& planes, int degree = 3) {
  return IncompressibleBody(BodySetup{
      .degree = degree, .reflect = planes, .law = materials::CiarletGeymonat{1, 0}, .projected_bulk = lambda});
}

/// A start that changes the volume at once.
State<IncompressibleBody> breathing(const IncompressibleBody& body) {
  State<IncompressibleBody> state = pulsating(body);
  state.v += 0.1 * body.affine(Matrix3d::Identity());
  return state;
}

/// Steps of RATTLE at this part of the limit of the elastic waves without the bulk term.
double stable_step(const IncompressibleBody& body, const State<IncompressibleBody>& state, double part) {
  auto workspace = body.make_workspace();
  const auto report = mechanics::largest_frequency(body, state, workspace, 60);
  EXPECT_TRUE(report.status);
  return part * mechanics::Rattle::stability_limit / report.omega;
}

double energy_of(const IncompressibleBody& body, const State<IncompressibleBody>& state) {
  return body.kinetic_energy(state.v) + body.potential_energy(state.q);
}

}  // namespace

/// The error of the state at the end, against steps 16 times as short as the shortest of the fit.
TEST(NearlyIncompressibleBody, HasOrder2) {
  const auto body = body_with_bulk(200, all_planes);
  const auto start = breathing(body);
  constexpr double end = 0.4;
  const auto at_end = [&](long n) {
    const auto r = run<mechanics::Rattle>(body, start, end, 1, n);
    EXPECT_TRUE(r.finished()) << r.result.reason;
    return r.last();
  };
  const auto reference = at_end(16 * 1600);
  std::vector<ErrorPoint> points;
  for (const long n : {200L, 400L, 800L, 1600L})
    points.push_back({end / static_cast<double>(n), distance(at_end(n), reference)});
  const auto fit = fit_order(points);
  EXPECT_GE(fit.n_used, 3u);
  EXPECT_NEAR(fit.order, 2, 0.1);
}

TEST(NearlyIncompressibleBody, OfDegree1IsTheBodyOfThePointwiseLaw) {
  const double lambda = 50;
  const auto body = body_with_bulk(lambda, all_planes, 1);
  const CompressibleBody pointwise(
      BodySetup{.degree = 1, .reflect = all_planes, .law = materials::CiarletGeymonat{1, lambda}});
  State<IncompressibleBody> start = breathing(body);
  start.q *= 1.02;
  const State<CompressibleBody> same{start.t, start.q, start.v};
  EXPECT_NEAR(body.potential_energy(start.q), pointwise.potential_energy(start.q), 1e-12);

  auto workspace = body.make_workspace();
  CompressibleBody::Workspace none;
  VectorXd lambda_of_motion = body.make_multiplier(), f = body.make_vector(), expected = f;
  ASSERT_TRUE(mechanics::multiplier_of_compliance(body, start.q, lambda_of_motion));
  ASSERT_TRUE(body.force(0, start.q, start.v, workspace, f));
  body.add_reaction(start.q, lambda_of_motion, f);
  ASSERT_TRUE(pointwise.force(0, start.q, start.v, none, expected));
  EXPECT_LT((f - expected).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_GT(expected.cwiseAbs().maxCoeff(), 1);

  const auto projected = run<mechanics::Rattle>(body, start, 2, 4, 20'000);
  const auto reference = run<mechanics::Rattle8>(pointwise, same, 2, 4, 200);
  ASSERT_TRUE(projected.finished() && reference.finished()) << projected.result.reason;
  for (std::size_t k = 0; k < reference.states.size(); ++k)
    EXPECT_LT(distance(projected.states[k], reference.states[k]), 1e-6) << k;
}

/// After the move, the amplitude of the oscillation of g about −λ/κ is a part of |g| of the order 1/λ. This is the
/// square of the ratio of the slow to the fast frequencies.
TEST(NearlyIncompressibleBody, MovesToTheSlowMotion) {
  std::vector<ErrorPoint> points;
  for (const double lambda : {1e3, 1e4, 1e5}) {
    const auto body = body_with_bulk(lambda, all_planes);
    const auto start = breathing(body);
    auto slow = start;
    const double h = stable_step(body, start, 0.4);
    ASSERT_TRUE(mechanics::move_to_slow_motion(body, h, slow));
    EXPECT_LT(distance(slow, start), 0.3);

    // The time contains several oscillations, and the steps resolve them.
    const double swing_time = 20 / std::sqrt(lambda);
    const auto r = run<mechanics::Rattle>(body, slow, swing_time, 40, 20);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    VectorXd first = body.make_multiplier(), g = first;
    ASSERT_TRUE(body.constraint(r.states.front().q, first));
    double swing = 0;
    for (const auto& state : r.states) {
      auto workspace = body.make_workspace();
      VectorXd of_motion = body.make_multiplier();
      ASSERT_TRUE(body.constraint(state.q, g));
      ASSERT_TRUE(mechanics::multiplier_of_motion(body, state, workspace, of_motion));
      swing = std::max(swing, (g + of_motion / body.constraint_stiffness()).norm() / first.norm());
    }
    points.push_back({1 / lambda, swing});
  }
  EXPECT_LT(points.front().error, 0.1);
  EXPECT_NEAR(fit_order(points).order, 1, 0.25);
}

/// The difference from the incompressible body is proportional to 1/λ.
TEST(NearlyIncompressibleBody, BecomesIncompressible) {
  const auto rigid = elastic_body<IncompressibleBody>(all_planes);
  const auto start = pulsating(rigid);
  const auto reference = run<mechanics::Rattle>(rigid, start, 1.5, 1, 600);
  ASSERT_TRUE(reference.finished());
  std::vector<double> differences;
  for (const double lambda : {1e4, 1e5, 1e6}) {
    const auto soft = run<mechanics::Rattle>(body_with_bulk(lambda, all_planes), start, 1.5, 1, 600);
    ASSERT_TRUE(soft.finished()) << soft.result.reason;
    differences.push_back((soft.last().q - reference.last().q).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(differences[0], 1e-3);
  EXPECT_NEAR(std::log10(differences[0] / differences[1]), 1, 0.15);
  EXPECT_NEAR(std::log10(differences[1] / differences[2]), 1, 0.15);
}

/// λ = 10⁶: pressure waves are a thousand times as fast as shear waves, and do not limit the step.
TEST(NearlyIncompressibleBody, StepIsThatOfShearWaves) {
  for (const Planes& planes : {all_planes, no_planes}) {
    const auto body = body_with_bulk(1e6, planes);
    const auto start = pulsating(body);
    const double h = stable_step(body, start, 0.7), end = 400 * h;
    EXPECT_GT(h, 0.1);
    const auto r = run<mechanics::Rattle>(body, start, end, 400, 1);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    const double E = energy_of(body, start), J = departures(body, r.states).momenta;
    EXPECT_LT(J, 1e-13);
    for (const auto& state : r.states) EXPECT_NEAR(energy_of(body, state), E, 0.1 * E);
  }
}

/// The slow motion at λ = 10⁸, against that of the incompressible body. The fast oscillation of the volume adds about
/// 1e-7.
TEST(NearlyIncompressibleBody, SymmetricMultistepHasOrder4) {
  using Method = mechanics::Symmetric4;
  const auto rigid = elastic_body<IncompressibleBody>(all_planes), soft = body_with_bulk(1e8, all_planes);
  const auto start = pulsating(rigid);
  constexpr double end = 1.5;
  const auto reference = run<Method>(rigid, start, end, 1, 3000).last();
  std::vector<ErrorPoint> points;
  for (const long n : {20L, 30L, 45L, 68L, 100L}) {
    const auto r = run<Method>(soft, start, end, 1, n);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    points.push_back({end / static_cast<double>(n), (r.last().q - reference.q).cwiseAbs().maxCoeff()});
  }
  EXPECT_LT(points.back().error, 1e-5);
  EXPECT_NEAR(fit_order(points).order, 4, 0.5);
}

TEST(NearlyIncompressibleBody, ReturnsWhereItCameFromWhenTimeIsReversed) {
  const auto body = body_with_bulk(1e3, no_planes);
  const auto start = breathing(body);
  const auto there = run<mechanics::Rattle>(body, start, 3, 1, 300);
  ASSERT_TRUE(there.finished()) << there.result.reason;
  auto turned = there.last();
  turned.v = -turned.v;
  auto back = run<mechanics::Rattle>(body, turned, 3, 1, 300).last();
  back.v = -back.v;
  EXPECT_GT(distance(there.last(), start), 0.1);
  EXPECT_LT(distance(back, start), 1e-10);
}

template <class Method>
void check_resuming() {
  const auto body = body_with_bulk(1e3, all_planes);
  State<IncompressibleBody> state = breathing(body);
  typename Method::template Workspace<IncompressibleBody> workspace(body), other(body);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(Method::advance(body, 0.02, state, workspace));
  std::vector<double> memory;
  mechanics::save_memory(workspace, memory);
  ASSERT_TRUE(mechanics::restore_memory(other, memory));
  State<IncompressibleBody> resumed = state;
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(Method::advance(body, 0.02, state, workspace));
    ASSERT_TRUE(Method::advance(body, 0.02, resumed, other));
    ASSERT_EQ(distance(state, resumed), 0) << k;
  }
}

TEST(NearlyIncompressibleBody, ResumesBitByBit) {
  check_resuming<mechanics::Rattle>();
  check_resuming<mechanics::Symmetric4>();
}

/// Compositions can be unstable (composition.h), and symmetric methods of higher order may be.
TEST(NearlyIncompressibleBody, OtherMethodsDoNotFit) {
  const auto body = body_with_bulk(1e3, all_planes), rigid = elastic_body<IncompressibleBody>(all_planes);
  mechanics::for_each_method([&]<class Method>(Method) {
    if constexpr (mechanics::method_fits<Method, IncompressibleBody>()) {
      constexpr bool is_offered =
          std::is_same_v<Method, mechanics::Rattle> || std::is_same_v<Method, mechanics::Symmetric4>;
      EXPECT_EQ(mechanics::fits<Method>(body), is_offered) << Method::name;
      EXPECT_TRUE(mechanics::fits<Method>(rigid)) << Method::name;
    }
  });
}

/// Viscosity and drag, with the velocity solved implicitly: the energy that is dissipated is the energy that is lost.
TEST(NearlyIncompressibleBody, DissipatesWhatItLoses) {
  loads::Loads loads;
  loads.get<loads::Viscosity>().viscosity = 0.1;
  loads.get<loads::Drag>().drag = 0.05;
  const IncompressibleBody body(BodySetup{.degree = 3,
                                          .reflect = all_planes,
                                          .law = materials::CiarletGeymonat{1, 0},
                                          .projected_bulk = 1e3,
                                          .loads = loads});
  const auto start = breathing(body);
  const double E = energy_of(body, start);
  std::vector<double> errors;
  for (const long n : {100L, 200L}) {
    const auto r = run<mechanics::Rattle>(body, start, 2, 1, n);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    const double taken = body.dissipated(r.last().v);
    EXPECT_GT(taken, 0.05 * E);
    errors.push_back(std::abs(energy_of(body, r.last()) + taken - E));
  }
  EXPECT_LT(errors[1], 0.02 * E);
  EXPECT_LT(errors[1], 0.5 * errors[0]);  // order 2 halves the error twice
}

/// 20,000 steps at several λ: no mode of the volume grows. The error of the energy is that of an incompressible body.
template <class Method>
void check_stability(double h) {
  for (const double lambda : {100.0, 300.0, 1e3, 1e4}) {
    const auto body = body_with_bulk(lambda, all_planes);
    const auto start = pulsating(body);
    const double E = energy_of(body, start);
    const auto r = run<Method>(body, start, 20'000 * h, 20, 1000);
    ASSERT_TRUE(r.finished()) << lambda << ": " << r.result.reason;
    for (const auto& state : r.states) EXPECT_NEAR(energy_of(body, state), E, 0.06 * E) << lambda;
  }
}

TEST(NearlyIncompressibleBody, IsStableOverManySteps) {
  check_stability<mechanics::Rattle>(0.1);
  check_stability<mechanics::Symmetric4>(0.07);  // with 0.1 and λ = 100 the motion resonates (docs/theory.md)
}

/// A run that halves its step and doubles it again, 60 times in all. Each change starts the method again from a state
/// with a fast oscillation of the volume, which must not grow. The bound of 10 % was set after values of 1 % were seen;
/// with the starts that it excludes, the energy grew by a factor.
TEST(NearlyIncompressibleBody, SymmetricMultistepKeepsTheEnergyWhenTheStepChanges) {
  using Method = mechanics::Symmetric4;
  for (const double lambda : {100.0, 1e3, 1e4, 1e5, 1e6}) {
    const auto body = body_with_bulk(lambda, all_planes);
    State<IncompressibleBody> state = pulsating(body);
    state.q = body.affine(Matrix3d::Identity());
    state.v *= 1e-2;
    state.v += 1e-4 * body.affine(Matrix3d::Identity());
    const double limit = mechanics::Symmetric4::stability_limit / mechanics::Rattle::stability_limit;
    const double h = stable_step(body, state, 0.5 * limit), E = body.kinetic_energy(state.v);
    const double at_rest = body.potential_energy(state.q);
    Method::Workspace<IncompressibleBody> workspace(body);
    for (int block = 0; block < 60; ++block) {
      const int refinement = 1 + block % 2;
      for (int i = 0; i < 20 * refinement; ++i) {
        const auto status = Method::advance(body, h / refinement, state, workspace);
        ASSERT_TRUE(status) << lambda << ", block " << block << ": " << status.reason();
      }
      ASSERT_TRUE(Method::project_velocity(body, state, workspace));
      ASSERT_NEAR(energy_of(body, state) - at_rest, E, 0.1 * E) << lambda << ", block " << block;
    }
  }
}

/// One fast mode beside a slow one: the step is stable for every stiffness, up to 0.95 of the limit of the slow motion.
TEST(NearlyIncompressibleBody, SymmetricMultistepIsStableForEveryStiffness) {
  for (const double lambda : {100.0, 200.0, 400.0, 800.0, 1600.0, 6400.0, 1e5}) {
    const auto body = body_with_bulk(lambda, all_planes);
    State<IncompressibleBody> start = pulsating(body);
    start.q = body.affine(Matrix3d::Identity());
    start.v *= 1e-3;
    start.v += 1e-5 * body.affine(Matrix3d::Identity());
    const double limit = mechanics::Symmetric4::stability_limit / mechanics::Rattle::stability_limit;
    const double h = stable_step(body, start, 0.95 * limit), E = body.kinetic_energy(start.v);
    const double at_rest = body.potential_energy(start.q);
    const auto r = run<mechanics::Symmetric4>(body, start, 20'000 * h, 20, 1000);
    ASSERT_TRUE(r.finished()) << lambda << ": " << r.result.reason;
    for (const auto& state : r.states) EXPECT_LT(energy_of(body, state) - at_rest, 3 * E) << lambda;
  }
}

}  // namespace pseudorigid::testing
