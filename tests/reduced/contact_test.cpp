/// Contact of the pseudo-rigid body with rigid planes: its closed form is the integral over the surface, forces are
/// derivatives of the energy, motions keep what planes leave, and the ball that bounces has the limits of PHYSICS 12.

#include <gtest/gtest.h>

#include <initializer_list>
#include <numbers>
#include <random>
#include <utility>

#include "mechanics/steps/largest_frequency.h"
#include "reduced/bodies_on_planes.h"
#include "support/differences.h"
#include "support/order_fit.h"
#include "support/runs.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using loads::AffineForce;
using loads::EllipsoidContact;
using loads::Plane;
using loads::PlaneContact;
using reduced::ReferenceBody;
using Body = BodyOnPlanes;
using State = StateOnPlanes;

const Matrix3d sample_shape = Vector3d(1.2, 0.9, 1).asDiagonal();
Matrix3d sample_map() { return (Matrix3d() << 1.2, 0.2, -0.1, 0.1, 0.9, 0.15, -0.2, 0.1, 1).finished(); }

/// A plane that the sample body is behind by `depth`.
Plane plane_at(double depth, double damping = 0) {
  const Vector3d n = Vector3d(0.3, -0.4, 0.8).normalized();
  const double reach = (sample_shape * sample_map().transpose() * n).norm();
  return {.normal = n, .position = n.dot(Vector3d(0.1, 0.2, 0.3)) - reach + depth, .stiffness = 70, .damping = damping};
}
EllipsoidContact contact(const Plane& plane, const Matrix3d& dQ = Matrix3d::Zero(),
                         const Vector3d& dc = Vector3d::Zero()) {
  return {plane, sample_shape, sample_map() + dQ, Vector3d(0.1, 0.2, 0.3) + dc};
}

/// Midpoints in the cosine about the deepest direction and in the longitude: the kink is on a circle of latitude.
template <class Visit>
void visit_sphere(const Vector3d& pole, int n, const Visit& visit) {
  const Vector3d e = pole.unitOrthogonal(), f = pole.cross(e);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < 32; ++j) {
      const double u = -1 + (2.0 * i + 1) / n, s = std::sqrt(1 - u * u), phi = 2 * std::numbers::pi * (j + 0.5) / 32;
      visit(u * pole + s * (std::cos(phi) * e + std::sin(phi) * f), 4 * std::numbers::pi / (32.0 * n));
    }
}

TEST(EllipsoidContact, IsTheIntegralOverTheSurface) {
  for (const double depth : {0.02, 0.4, 1.5, 4.0}) {  // in the last all of it is behind the plane
    const Plane plane = plane_at(depth, 0.7);
    const Vector3d g = sample_shape * sample_map().transpose() * plane.normal, c(0.1, 0.2, 0.3);
    const Matrix3d Qdot = (Matrix3d() << 0.3, -0.1, 0.2, 0.4, 0.1, -0.3, 0.2, 0.5, -0.4).finished();
    const Vector3d cdot(0.2, -0.1, -0.6);
    PlaneContact expected;
    AffineForce force, damping;
    double power = 0;
    visit_sphere(-g.normalized(), 20000, [&](const Vector3d& xi, double weight) {
      const Vector3d X = sample_shape * xi, x = c + sample_map() * X, v = cdot + Qdot * X;
      expected.add(plane, x, weight);
      const double d = -plane.height(x), rate = -plane.normal.dot(v);
      if (d <= 0) return;
      force.on_center += weight * plane.stiffness * d * plane.normal;
      force.on_Q += weight * plane.stiffness * d * plane.normal * X.transpose();
      damping.on_center += weight * plane.stiffness * plane.damping * d * rate * plane.normal;
      damping.on_Q += weight * plane.stiffness * plane.damping * d * rate * plane.normal * X.transpose();
      power += weight * plane.stiffness * plane.damping * d * rate * rate;
    });
    const PlaneContact exact = contact(plane).contact();
    AffineForce f, of_damping;
    contact(plane).add_force(f);
    const double taken = contact(plane).add_damping(Qdot, cdot, of_damping).taken;
    const double midpoints = depth < 0.1 ? 1e-4 : 1e-6;  // the fewer of them touch, the larger their error
    EXPECT_NEAR(exact.energy, expected.energy, midpoints * exact.energy);
    EXPECT_NEAR(exact.force, expected.force, midpoints * exact.force);
    EXPECT_NEAR(exact.area, expected.area, 1e-2 * exact.area);
    EXPECT_LT((exact.moment - expected.moment).norm(), midpoints * exact.moment.norm());
    const double radius = loads::summary({plane}, {exact}).pressure_radius;
    EXPECT_NEAR(radius, loads::summary({plane}, {expected}).pressure_radius, midpoints * radius);
    EXPECT_LT((f.on_Q - force.on_Q).norm(), midpoints * force.on_Q.norm());
    EXPECT_LT((f.on_center - force.on_center).norm(), midpoints * force.on_center.norm());
    EXPECT_LT((of_damping.on_Q - damping.on_Q).norm(), midpoints * damping.on_Q.norm());
    EXPECT_LT((of_damping.on_center - damping.on_center).norm(), midpoints * damping.on_center.norm());
    EXPECT_NEAR(taken, power, midpoints * power);
  }
}

/// Between the kinks.
TEST(EllipsoidContact, ForceAndRateAreDerivatives) {
  const Matrix3d dQ = (Matrix3d() << 0.3, -0.1, 0.2, 0.4, 0.1, -0.3, 0.2, 0.5, -0.4).finished();
  const Vector3d dc(0.2, -0.1, -0.6);
  for (const double depth : {0.4, 4.0}) {
    const Plane plane = plane_at(depth);
    const auto at = [&](double s) { return contact(plane, s * dQ, s * dc); };
    AffineForce f, rate;
    at(0).add_force(f);
    at(0).add_force_rate(dQ, dc, rate);
    const double slope = first_difference([&](int k) { return at(1e-2 * k).contact().energy; }, 1e-2);
    EXPECT_NEAR(-slope, f.on_Q.cwiseProduct(dQ).sum() + f.on_center.dot(dc), 1e-10 * std::abs(slope));
    const auto force_at = [&](int k) {
      AffineForce there;
      at(1e-2 * k).add_force(there);
      return (Eigen::Matrix<double, 3, 4>() << there.on_Q, there.on_center).finished();
    };
    const Eigen::Matrix<double, 3, 4> difference = first_difference(force_at, 1e-2);
    EXPECT_LT((difference - (Eigen::Matrix<double, 3, 4>() << rate.on_Q, rate.on_center).finished()).norm(),
              1e-9 * difference.norm());
  }
}

loads::RigidPlanes floor_at(double height, double stiffness, double damping = 0) {
  return {.normals = {0, 0, 1}, .points = {0, 0, height}, .stiffness = stiffness, .damping = damping};
}

/// A tilted spheroid falls on a floor a hundred times. The floor leaves the horizontal momentum and J₃.
TEST(BouncingBody, KeepsWhatTheFloorLeaves) {
  constexpr double g = 2;
  const Body body = ball_on(loads::Loads(floor_at(0, 200), loads::Acceleration{{0, 0, -g}}));
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(0.3, 1, 0.2).normalized()).toRotationMatrix();
  const Matrix3d stretch = Vector3d(1.1, 1, 1 / 1.1).asDiagonal();
  const Matrix3d spin = (Matrix3d() << 0, -0.3, 0, 0.3, 0, 0.1, 0, -0.1, 0).finished();  // tr(Q⁻¹Q̇) = 0
  const State start = Body::state_of({0, turn * stretch, turn * spin * stretch}, {0, 0, 1.6}, {0.1, -0.2, 0});
  const auto r = run<mechanics::Rattle>(body, start, 210, 2100, 40);
  ASSERT_TRUE(r.finished()) << r.result.reason;
  int n_bounces = 0;
  double worst_momentum = 0;
  std::array<double, 2> worst_energy{};  // of each half
  const auto J3 = [&](const State& s) {
    return mechanics::axial_vector(body.matrix(s.q) * body.body().E0() * body.matrix(s.v).transpose())[2];
  };
  const double energy = energy_of(body, start, g);
  for (std::size_t k = 0; k < r.states.size(); ++k) {
    const State& s = r.states[k];
    if (k > 0 && body.center(r.states[k - 1].v)[2] < 0 && body.center(s.v)[2] >= 0) ++n_bounces;
    double& worst = worst_energy[2 * k / r.states.size()];
    worst = std::max(worst, std::abs(energy_of(body, s, g) - energy));
    worst_momentum = std::max(
        {worst_momentum, (body.center(s.v) - body.center(start.v)).head<2>().norm(), std::abs(J3(s) - J3(start))});
  }
  EXPECT_GE(n_bounces, 100);
  EXPECT_LT(worst_momentum, 1e-12);
  EXPECT_LT(worst_energy[0], 1e-3 * energy) << "the error of the step";
  EXPECT_LT(worst_energy[1], 2 * worst_energy[0]) << "it does not drift";
  RecordProperty("worst_energy", std::to_string(worst_energy[0]) + ", " + std::to_string(worst_energy[1]));
}

/// A hundred bounces and back. A difference of 3.2e-11 was seen after 105 bounces, and the bound set after it.
TEST(BouncingBody, IsReversible) {
  const Body body = ball_on(loads::Loads(floor_at(0, 200), loads::Acceleration{{0, 0, -2}}));
  const State start = Body::state_of({0, Matrix3d::Identity(), Matrix3d::Zero()}, {0, 0, 1.1}, {0, 0, 0});
  auto there = run<mechanics::Rattle>(body, start, 170, 1700, 20);
  ASSERT_TRUE(there.finished());
  int n_bounces = 0;
  for (std::size_t k = 1; k < there.states.size(); ++k)
    if (body.center(there.states[k - 1].v)[2] < 0 && body.center(there.states[k].v)[2] >= 0) ++n_bounces;
  EXPECT_GE(n_bounces, 100);
  State turned = there.last();
  turned.t = 0;
  turned.v = -turned.v;
  const auto back = run<mechanics::Rattle>(body, turned, 170, 1700, 20);
  const double difference = (back.last().q - start.q).norm();
  EXPECT_LT(difference, 1e-9);
  RecordProperty("difference", std::to_string(difference * 1e12) + "e-12 after " + std::to_string(n_bounces));
}

/// A ball whose surface is held on all sides has ω² = 10 + 5k, from k∮u² = (4π/3) k |H|² and m̄ = 4π/15. No contact is
/// stiffer, so a step that is stable for it is stable in every contact.
TEST(BouncingBody, NoContactIsStifferThanABodyThatIsHeld) {
  const double k = 500;
  const Body body = ball_on(loads::Loads(floor_at(-1, k)));
  const auto frequency = [&](double depth, bool held) {
    const State state = Body::state_of({0, Matrix3d::Identity(), Matrix3d::Zero()}, {0, 0, -depth}, {0, 0, 0});
    auto workspace = body.make_workspace();
    if (held) workspace.held_at = &state.q;
    const auto report = mechanics::largest_frequency(body, state, workspace, 24);
    EXPECT_TRUE(report.status) << report.status.reason();
    return report.omega;
  };
  EXPECT_NEAR(frequency(0, true), std::sqrt(10 + 5 * k), 1e-6 * std::sqrt(5 * k));
  EXPECT_NEAR(frequency(0.3, true), frequency(0, true), 1e-6 * std::sqrt(5 * k)) << "wherever it is held";
  for (const double depth : {0.01, 0.1, 0.3}) EXPECT_LT(frequency(depth, false), frequency(0, true)) << depth;
}

/// The force of the closed form has a continuous derivative, and the second one jumps at the first and at the last
/// contact: the step with the jump has the error h³ of its velocity, so that order 2 stays and order 4 becomes 3.
/// A point touches planes with the same normal together, and planes that face each other one at a time.
TEST(Planes, StiffnessOfAllBoundsWhatAPointCanTouch) {
  const Vector3d z = Vector3d::UnitZ(), x = Vector3d::UnitX();
  const auto stiffness = [](std::initializer_list<std::pair<Vector3d, double>> all) {
    loads::Planes planes;
    for (const auto& [normal, k] : all) planes.push_back({.normal = normal, .position = -1, .stiffness = k});
    return planes.stiffness_of_all();
  };
  EXPECT_DOUBLE_EQ(stiffness({{z, 1}, {-z, 2}}), 2);
  EXPECT_DOUBLE_EQ(stiffness({{z, 1}, {z, 2}}), 3);
  EXPECT_DOUBLE_EQ(stiffness({{z, 1}, {z, 2}, {-z, 2.5}}), 3);
  EXPECT_DOUBLE_EQ(stiffness({{-z, 2.5}, {z, 1}, {z, 1}}), 2.5);
  EXPECT_DOUBLE_EQ(stiffness({{x, 1}, {z, 2}}), 2);
}

TEST(BouncingBody, StepsAcrossContactsHaveOrderTwoOrThree) {
  const Body body = ball_on(loads::Loads(floor_at(-1, 200)));
  constexpr double end = 4;
  const auto at_end = [&]<class Method>(Method, double height, long n) {
    const State start = Body::state_of({0, Matrix3d::Identity(), Matrix3d::Zero()}, {0, 0, height}, {0, 0, -0.5});
    return run<Method>(body, start, end, 1, n).last();
  };
  // The error of a single run depends on the place of the contact within its step.
  const std::vector<double> heights{0.13, 0.1327, 0.1341, 0.1366, 0.1382};
  std::vector<State> exact;
  for (const double height : heights) exact.push_back(at_end(mechanics::Rattle4{}, height, 60000));
  ASSERT_GT(Body::center(exact.front().v)[2], 0.2) << "it has bounced";
  const auto order_of = [&]<class Method>(Method method) {
    std::vector<ErrorPoint> errors;
    for (const long n : {400, 800, 1600, 3200, 6400}) {
      errors.push_back({end / static_cast<double>(n), 0});
      for (std::size_t i = 0; i < heights.size(); ++i)
        errors.back().error += distance(at_end(method, heights[i], n), exact[i]);
    }
    return fit_order(errors).order;
  };
  const double of_two = order_of(mechanics::Rattle{}), of_four = order_of(mechanics::Rattle4{});
  RecordProperty("orders", std::to_string(of_two) + ", " + std::to_string(of_four));
  EXPECT_NEAR(of_two, 2, 0.15);
  EXPECT_NEAR(of_four, 3, 0.4);
}

/// Speed after, and time of, an impact of the ball at rest with the speed v.
struct Impact {
  double e, duration, energy_taken;
};
Impact impact(double v, double stiffness, double damping, double step) {
  const Body body = ball_on(loads::Loads(floor_at(-1, stiffness, damping)));
  const State start = Body::state_of({0, Matrix3d::Identity(), Matrix3d::Zero()}, {0, 0, 0}, {0, 0, -v});
  const double end = 4;
  const auto r = run<mechanics::Rattle>(body, start, end, std::lround(end / step), 1);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  double last = 0;
  for (const State& s : r.states)
    if (body.contact(s.t, s.q).height < 0) last = s.t;
  return {body.center(r.last().v)[2] / v, last, r.last().v(0, 4) / (0.5 * body.body().reference().mass * v * v)};
}

/// Small motions, a stiff conservative contact: the pole, whose mass is 3M/13, bounces three times within the impact,
/// at the times 0, 0.708453 and 1.300442 r/c, and the ball leaves with e = 0.796704 (a billiard of the centre and of
/// the pulsation with ω² = 10; the numbers are those of its roots). The law of the contact makes each bounce as long as
/// (k v)^(-1/3).
TEST(Impact, OfAStiffConservativeContactIsABilliard) {
  std::vector<ErrorPoint> errors;
  for (const double kv : {1e5, 1e6, 1e7}) {
    const double v = 1e-4;
    const Impact result = impact(v, kv / v, 0, 0.02 * std::cbrt(1 / kv));
    errors.push_back({1 / kv, std::abs(result.e - 0.796704401728443)});
    EXPECT_NEAR(result.duration, 1.300442, 6 * std::cbrt(1 / kv));
    EXPECT_NEAR(result.energy_taken, 0, 1e-15);
    RecordProperty("e_" + std::to_string(errors.size()), std::to_string(result.e));
  }
  EXPECT_LT(errors.back().error, 1e-2);
  EXPECT_NEAR(fit_order(errors).order, 1.0 / 3, 0.1);
}

/// With a strong damping the pole comes to rest in the first contact and stays on the plane: e = 10/13, contact for
/// π√(13/30) r/c, and 3/13 of the energy is taken (PHYSICS 12).
TEST(Impact, OfADampedContactIsPlastic) {
  const double v = 1e-4;
  const Impact result = impact(v, 1e12, 30 / v, 1e-4);
  RecordProperty("e", std::to_string(result.e));
  RecordProperty("duration", std::to_string(result.duration));
  RecordProperty("energy_taken", std::to_string(result.energy_taken));
  EXPECT_NEAR(result.e, 10.0 / 13, 1e-3);
  EXPECT_NEAR(result.duration, std::numbers::pi * std::sqrt(13.0 / 30), 0.02);
  EXPECT_NEAR(result.energy_taken, 3.0 / 13, 1e-3);
}

/// A ball on a floor under an acceleration g rests with N = πkδ²/G = Mg: the penetration of the affine body falls as
/// k^(-1/2), since the area that touches falls as well.
TEST(RestingBody, HasItsOwnLawOfContact) {
  for (const double k : {1e3, 1e5}) {
    const double G = 1.02, depth = 0.01;
    const Plane plane{.normal = Vector3d::UnitZ(), .position = -G + depth, .stiffness = k};
    const Matrix3d shape = Matrix3d::Identity();
    const EllipsoidContact contact(plane, shape, Matrix3d(Vector3d(1, 1, G).asDiagonal()), Vector3d::Zero());
    EXPECT_NEAR(contact.contact().force, std::numbers::pi * k * depth * depth / G, 1e-12 * k);
    EXPECT_NEAR(std::sqrt(contact.contact().area / std::numbers::pi), std::sqrt(2 * depth / G), 1e-12);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
