/// Contact of the finite-element ball with rigid planes: restricted to affine motions it is the sum over its own
/// points, which tends to the closed form of the pseudo-rigid body; forces are derivatives of the energy; sectors are
/// parts of the whole. Friction and planes in motion as well.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "continuum/body/contact_forces.h"
#include "loads/ellipsoid_friction.h"
#include "support/differences.h"
#include "support/order_fit.h"
#include "support/planes.h"

namespace pseudorigid::testing {
namespace {

using continuum::ContactForces;
using continuum::Vector;

Matrix3d sample_map() { return (Matrix3d() << 1.1, 0.2, -0.1, 0.1, 0.9, 0.15, -0.2, 0.1, 1).finished(); }

/// Energy and moment of the force tend to those of the closed form as the points become denser. The integrand has a
/// kink at the edge of the contact, whose place among the points decides the error: the mean over many contacts has an
/// order.
TEST(ContinuumContact, OfAffineMotionsTendsToTheClosedForm) {
  const ElasticBall ball(whole, 4, 0, neo_hookean);
  const Matrix3d Q = sample_map(), S = Matrix3d::Identity();
  const Vector3d c(0.05, -0.02, 0.03);
  const Vector x = ball.affine_field(Q, c);
  std::vector<ErrorPoint> of_energy, of_force;
  for (const int n : {6, 12, 24, 48}) {
    constexpr int n_contacts = 12;
    of_energy.push_back({1.0 / n, 0});
    of_force.push_back({1.0 / n, 0});
    for (int i = 0; i < n_contacts; ++i) {
      const Vector3d normal = Vector3d(0.3 + 0.05 * i, -0.4, 0.8).normalized();
      const double lowest = normal.dot(c) - (Q.transpose() * normal).norm();
      const loads::Plane plane{.normal = normal, .position = lowest + 0.15 + 0.003 * i, .stiffness = 30};
      loads::AffineForce exact;
      const loads::EllipsoidContact closed_form(plane, S, Q, c);
      closed_form.add_force(exact);
      const ContactForces contact({plane}, ball.space(), n);
      Vector f = ball.make_vector();
      contact.add(0, x, f);
      of_energy.back().error += std::abs(contact.contact(0, x).energy / closed_form.contact().energy - 1) / n_contacts;
      of_force.back().error += (moment_of_force(ball, f) - exact.on_Q).norm() / exact.on_Q.norm() / n_contacts;
    }
  }
  EXPECT_LT(of_energy.back().error, 1e-5);  // the error of the surface of degree 4: 2e-6 was seen
  of_energy.pop_back();
  EXPECT_GT(fit_order(of_energy).order, 2);
  EXPECT_GT(fit_order(of_force).order, 1.5);
}

TEST(ContinuumContact, FrictionOfAffineMotionsTendsToThatOfThePseudoRigidBody) {
  const ElasticBall ball(whole, 4, 0, neo_hookean);
  const Matrix3d Q = sample_map(), S = Matrix3d::Identity(),
                 Qdot = (Matrix3d() << 0.3, -0.1, 0.2, 0.4, 0.1, -0.3, 0.2, 0.5, -0.4).finished();
  constexpr double t = 0.7;
  std::vector<ErrorPoint> of_force, of_power;
  for (const int n : {6, 12, 24}) {
    constexpr int n_contacts = 8;
    of_force.push_back({1.0 / n, 0});
    of_power.push_back({1.0 / n, 0});
    const ContactForces contact(moving_planes(0.3, 0.4), ball.space(), n);
    for (int i = 0; i < n_contacts; ++i) {
      const Vector3d c(0.02 * i, -0.01 * i, 0.03), cdot(0.4 - 0.1 * i, 0.2, 0.1);
      loads::AffineForce exact;
      loads::ContactPower exact_power;
      for (const loads::Plane& plane : moving_planes(0.3, 0.4)) {
        const loads::EllipsoidContact closed_form(plane.at(t), S, Q, c);
        exact_power += closed_form.add_damping(Qdot, cdot, exact);
        exact_power.taken += loads::EllipsoidFriction(closed_form, Qdot, cdot).add_force(exact);
        exact_power.given += closed_form.given();
      }
      Vector f = ball.make_vector(), conservative = f;
      const double given = contact.add(t, ball.affine_field(Q, c), conservative);
      const loads::ContactPower power =
          contact.add_dissipation(t, ball.affine_field(Q, c), ball.affine_field(Qdot, cdot), f);
      of_force.back().error += (moment_of_force(ball, f) - exact.on_Q).norm() / exact.on_Q.norm() / n_contacts;
      of_power.back().error +=
          (std::abs(power.taken - exact_power.taken) + std::abs(given + power.given - exact_power.given)) /
          exact_power.taken / n_contacts;
    }
  }
  EXPECT_GT(fit_order(of_force).order, 1.5);
  EXPECT_GT(fit_order(of_power).order, 1.5);
  EXPECT_LT(of_force.back().error, 1e-3);
}

TEST(ContinuumContact, LinearisedFrictionIsADerivative) {
  std::mt19937 generator(4);
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const ContactForces contact(moving_planes(0.3, 0.4), ball.space(), 8);
  Vector x = ball.affine_field(sample_map());
  x.add(0.02, random_field(x, generator));
  const Vector v = random_field(x, generator), u = random_field(x, generator);
  constexpr double t = 0.4, h = 1e-4;
  const auto force_at = [&](double k) {
    Vector there = v, f = ball.make_vector();
    there.add(h * k, u);
    contact.add_dissipation(t, x, there, f);
    return f;
  };
  Vector slope = force_at(1), tangent = ball.make_vector();
  slope -= force_at(-1);
  slope /= 2 * h;
  contact.add_damping(t, x, v, u, mechanics::Linearization::tangent, tangent);
  slope -= tangent;
  EXPECT_LT(slope.l2_norm(), 1e-6 * tangent.l2_norm());
  Vector f = ball.make_vector();
  const loads::ContactPower power = contact.add_dissipation(t, x, v, f);
  EXPECT_NEAR(f * v, power.given - power.taken, 1e-12 * power.taken);
  EXPECT_GT(power.taken, 0);
}

TEST(ContinuumContact, ForceIsTheDerivativeAndDampingTakesItsPower) {
  std::mt19937 generator(2);
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const ContactForces contact(oblique_planes(0.3), ball.space(), 8);
  Vector x = ball.affine_field(sample_map());
  x.add(0.02, random_field(x, generator));
  const Vector u = random_field(x, generator);
  Vector f = ball.make_vector(), damping = f;
  contact.add(0, x, f);
  constexpr double h = 1e-6;  // so near that no point passes through a plane
  const double slope = first_difference(
      [&](int k) {
        Vector there = x;
        there.add(h * k, u);
        return contact.contact(0, there).energy;
      },
      h);
  EXPECT_NEAR(f * u, -slope, 1e-7 * std::abs(slope));
  const double power = contact.add_dissipation(0, x, u, damping).taken;
  EXPECT_NEAR(damping * u, -power, 1e-12 * power);
  EXPECT_GT(power, 0);
}

TEST(ContinuumContact, OfASectorIsThatOfTheWholeBall) {
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const Matrix3d Q = diagonal(1.1, 0.95, 1.02);
  const loads::Contact expected = ContactForces(press(), ball.space(), 8).contact(0, ball.affine_field(Q));
  for (const Sector& sector : {quarter, octant}) {
    const ElasticBall part(sector, 3, 0, neo_hookean);
    const loads::Contact found = ContactForces(press(), part.space(), 8).contact(0, part.affine_field(Q));
    EXPECT_NEAR(found.energy, expected.energy, 1e-14);
    EXPECT_NEAR(found.force, expected.force, 1e-13);
    EXPECT_NEAR(found.radius, expected.radius, 1e-13);
    EXPECT_NEAR(found.height, expected.height, 1e-14);
    EXPECT_NEAR(found.point.norm(), expected.point.norm(), 1e-13);
  }
}

TEST(ContinuumContact, FrictionOfASectorIsThatOfTheWholeBall) {
  const loads::Planes planes = rough_press();
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const Matrix3d Q = diagonal(1.1, 0.95, 1.02), Qdot = diagonal(0.3, 0.1, -0.4);
  Vector f = ball.make_vector();
  const loads::ContactPower expected =
      ContactForces(planes, ball.space(), 8).add_dissipation(0.3, ball.affine_field(Q), ball.affine_field(Qdot), f);
  const Matrix3d moment = moment_of_force(ball, f);
  for (const Sector& sector : {quarter, octant}) {
    const ElasticBall part(sector, 3, 0, neo_hookean);
    Vector of_part = part.make_vector();
    const loads::ContactPower found = ContactForces(planes, part.space(), 8)
                                          .add_dissipation(0.3, part.affine_field(Q), part.affine_field(Qdot), of_part);
    EXPECT_NEAR(sector.n_images() * found.taken, expected.taken, 1e-12 * expected.taken);
    EXPECT_NEAR(sector.n_images() * found.given, expected.given, 1e-12 * expected.taken);
    EXPECT_LT((moment_of_force(part, of_part) - moment).norm(), 1e-12 * moment.norm());
  }
  EXPECT_GT(expected.taken, 1e-2);
}

/// Of a face that is left out no point touches.
TEST(ContinuumContact, FacesThatAreLeftOutDoNotTouch) {
  std::mt19937 generator(3);
  const ElasticBall ball(octant, 4, 0, neo_hookean);
  for (int i = 0; i < 20; ++i) {
    Vector x = ball.affine_field(diagonal(1, 1, 1));
    x.add(0.05, random_field(x, generator));
    const loads::Planes ceiling{{.normal = -Vector3d::UnitZ(), .position = -0.9 - 0.01 * i, .stiffness = 30},
                                {.normal = Vector3d::UnitZ(), .position = -0.9 - 0.01 * i, .stiffness = 30}};
    const ContactForces contact(ceiling, ball.space(), 8);
    Vector f = ball.make_vector();
    contact.add(0, x, f);
    EXPECT_EQ(f.linfty_norm() > 0, contact.contact(0, x).force > 0) << i;
  }
}

}  // namespace
}  // namespace pseudorigid::testing
