/// The stages of Gauss collocation of systems in lanes: the same as one after the other; sections of the motion by
/// systems behind an interface.

#include <gtest/gtest.h>

#include "mechanics/core/any_field.h"
#include "mechanics/core/any_system.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/methods/gauss_16.h"
#include "support/runs.h"
#include "systems/double_pendulum.h"
#include "systems/double_pendulum_chart.h"
#include "systems/euler_top.h"

namespace pseudorigid::testing {
namespace {

using mechanics::Gauss16;
using mechanics::State;

/// A system whose stages are not in lanes, since it does not say that they could be.
template <class S>
struct OneByOne {
  using Vector = typename S::Vector;
  using Workspace = typename mechanics::FieldOf<S>::Workspace;
  const S& system;
  mechanics::Status acceleration(double t, const Vector& q, const Vector& v, Workspace& w, Vector& a) const {
    return mechanics::field_of(system).acceleration(t, q, v, w, a);
  }
  Vector make_vector() const { return system.make_vector(); }
  Workspace make_workspace() const { return mechanics::field_of(system).make_workspace(); }
};

template <class S>
void expect_same_step(const S& system, const State<S>& start, double h) {
  ASSERT_TRUE(mechanics::has_stages_in_lanes(mechanics::field_of(system)));
  const OneByOne<S> slow{system};
  ASSERT_FALSE(mechanics::has_stages_in_lanes(slow));
  mechanics::Gauss16Workspace<S> w(system);
  mechanics::Gauss16Workspace<OneByOne<S>> of_slow(slow);
  auto a = start, b = start;
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(Gauss16::advance(system, h, a, w));
    ASSERT_TRUE(Gauss16::advance(slow, h, b, of_slow));
  }
  EXPECT_GT(distance(a, start), 0.1);
  EXPECT_LT(distance(a, b), 2e-13);
}

systems::DoublePendulum pendulum() { return systems::DoublePendulum({1.3, 0.7, 0.8, 1.1, 0.9}); }
State<systems::DoublePendulum> swinging_pendulum() {
  State<systems::DoublePendulum> start;
  pendulum().from_angles({0.6, 0.8}, {0.2, -0.3}, start.q, start.v);
  return start;
}

TEST(StagesOfSystems, OfTheDoublePendulumInBothForms) {
  expect_same_step(pendulum(), swinging_pendulum(), 0.1);
  const mechanics::ChartField angles(systems::DoublePendulumChart{1.3, 0.7, 0.8, 1.1, 0.9});
  expect_same_step(angles, {0, {0.6, 0.8}, {0.2, -0.3}}, 0.2);
}

TEST(StagesOfSystems, OfEulersTopUnderItsWeight) {
  using Top = systems::EulerTop<systems::LoadTorque>;
  Eigen::Matrix3d A;
  A << 1, 0.1, 0, 0.1, 2, 0.2, 0, 0.2, 2.5;
  const systems::BodyLoads loads{.mass = 1.2, .center = {0.1, -0.2, 0.3}, .gravity = {0.1, 0.2, -1}};
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const auto start = Top::turning(R, {0.4, 1, 0.6});
  expect_same_step(Top({.A = A, .torque = {loads}}), {0, start.q, start.v}, 0.2);
  systems::BodyLoads with_spring = loads;
  with_spring.springs.push_back({{1, 0, 0}, {2, 0, 0}, {1, 0.5}});
  EXPECT_FALSE(Top({.A = A, .torque = {with_spring}}).has_stages_in_lanes());
}

/// In principal axes, where the field is a shorter one, and in others.
TEST(StagesOfSystems, OfEulersTopWithoutWeight) {
  using Top = systems::EulerTop<>;
  Eigen::Matrix3d A;
  A << 1, 0.1, 0, 0.1, 2, 0.2, 0, 0.2, 2.5;
  const auto start = Top::turning(Eigen::Matrix3d::Identity(), {0.4, 1, 0.6});
  for (const Eigen::Matrix3d& inertia : {A, Eigen::Matrix3d(A.diagonal().asDiagonal())})
    expect_same_step(Top({.A = inertia}), {0, start.q, start.v}, 0.2);
}

/// Behind one type: the same bits, and projected at the samples.
TEST(StagesOfSystems, BehindAnInterface) {
  const auto start = swinging_pendulum();
  const mechanics::AnySystem<mechanics::dynamic_constraints> any(pendulum());
  EXPECT_TRUE(any.has_stages_in_lanes());
  const auto own = run<Gauss16>(pendulum(), start, 10, 10, 10);
  const auto behind = run<Gauss16>(any, {0, Eigen::VectorXd(start.q), Eigen::VectorXd(start.v)}, 10, 10, 10);
  ASSERT_TRUE(own.finished() && behind.finished());
  EXPECT_LT((own.last().q - behind.last().q).norm(), 1e-13);
  EXPECT_LT((own.last().v - behind.last().v).norm(), 1e-13);
  const mechanics::AnyField field(mechanics::ChartField(systems::DoublePendulumChart{}));
  EXPECT_TRUE(field.has_stages_in_lanes());
}

}  // namespace
}  // namespace pseudorigid::testing
