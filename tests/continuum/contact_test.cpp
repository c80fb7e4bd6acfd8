/// Contact of the finite-element ball with rigid planes: restricted to affine motions it is the sum over its own
/// points, which tends to the closed form of the pseudo-rigid body; forces are derivatives of the energy; sectors are
/// parts of the whole; and the penetration of a ball that is pressed falls as 1/k.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "continuum/body/contact_forces.h"
#include "loads/ellipsoid_contact.h"
#include "support/differences.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using continuum::ContactForces;
using continuum::Vector;

loads::Planes oblique_planes() {
  const Vector3d n = Vector3d(0.3, -0.4, 0.8).normalized(), m = Vector3d(-1, 0.2, 0).normalized();
  return {{.normal = n, .position = -0.8, .stiffness = 30, .damping = 0.4},
          {.normal = m, .position = -0.9, .stiffness = 50, .damping = 0.2}};
}
loads::Planes press() {
  return {{.normal = Vector3d::UnitZ(), .position = -0.9, .stiffness = 30},
          {.normal = -Vector3d::UnitZ(), .position = -0.9, .stiffness = 30}};
}
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
      contact.add(x, f);
      of_energy.back().error += std::abs(contact.contact(x).energy / closed_form.contact().energy - 1) / n_contacts;
      of_force.back().error += (moment_of_force(ball, f) - exact.on_Q).norm() / exact.on_Q.norm() / n_contacts;
    }
  }
  EXPECT_LT(of_energy.back().error, 1e-5);  // the error of the surface of degree 4: 2e-6 was seen
  of_energy.pop_back();
  EXPECT_GT(fit_order(of_energy).order, 2);
  EXPECT_GT(fit_order(of_force).order, 1.5);
}

TEST(ContinuumContact, ForceIsTheDerivativeAndDampingTakesItsPower) {
  std::mt19937 generator(2);
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const ContactForces contact(oblique_planes(), ball.space(), 8);
  Vector x = ball.affine_field(sample_map());
  x.add(0.02, random_field(x, generator));
  const Vector u = random_field(x, generator);
  Vector f = ball.make_vector(), damping = f;
  contact.add(x, f);
  constexpr double h = 1e-6;  // so near that no point passes through a plane
  const double slope = first_difference(
      [&](int k) {
        Vector there = x;
        there.add(h * k, u);
        return contact.contact(there).energy;
      },
      h);
  EXPECT_NEAR(f * u, -slope, 1e-7 * std::abs(slope));
  const double power = contact.add_damping(x, u, damping);
  EXPECT_NEAR(damping * u, -power, 1e-12 * power);
  EXPECT_GT(power, 0);
}

TEST(ContinuumContact, OfASectorIsThatOfTheWholeBall) {
  const ElasticBall ball(whole, 3, 0, neo_hookean);
  const Matrix3d Q = diagonal(1.1, 0.95, 1.02);
  const loads::Contact expected = ContactForces(press(), ball.space(), 8).contact(ball.affine_field(Q));
  for (const Sector& sector : {quarter, octant}) {
    const ElasticBall part(sector, 3, 0, neo_hookean);
    const loads::Contact found = ContactForces(press(), part.space(), 8).contact(part.affine_field(Q));
    EXPECT_NEAR(found.energy, expected.energy, 1e-14);
    EXPECT_NEAR(found.force, expected.force, 1e-13);
    EXPECT_NEAR(found.radius, expected.radius, 1e-13);
    EXPECT_NEAR(found.height, expected.height, 1e-14);
    EXPECT_NEAR(found.point.norm(), expected.point.norm(), 1e-13);
  }
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
    contact.add(x, f);
    EXPECT_EQ(f.linfty_norm() > 0, contact.contact(x).force > 0) << i;
  }
}

}  // namespace
}  // namespace pseudorigid::testing
