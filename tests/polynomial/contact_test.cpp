/// Contact of polynomial bodies with rigid planes: of degree 1 it is that of the pseudo-rigid body to round-off, of
/// higher degrees the sum over the points tends to it on affine motions; forces are derivatives; sectors are parts of
/// the whole. Friction and planes in motion as well.

#include <gtest/gtest.h>

#include <random>
#include <tuple>

#include "polynomial/samples.h"
#include "reduced/loaded_body.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"
#include "support/differences.h"
#include "support/order_fit.h"
#include "support/planes.h"

namespace pseudorigid::testing {
namespace {

using polynomial::BodyContact;
using polynomial::PolynomialSpace;

loads::RigidPlanes as_load(const loads::Planes& planes) {
  loads::RigidPlanes load;
  load.stiffness = planes.front().stiffness;
  load.damping = planes.front().damping;
  load.friction = planes.front().friction;
  load.slip_speed = planes.front().slip_speed;
  load.frequency = planes.back().frequency;
  for (const loads::Plane& plane : planes) {
    load.speeds.push_back(plane.speed);
    load.amplitudes.push_back(plane.amplitude);
    for (int i = 0; i < 3; ++i) {
      load.normals.push_back(plane.normal[i]);
      load.points.push_back(plane.position * plane.normal[i]);
    }
  }
  return load;
}

/// With damping, friction and planes in motion.
TEST(PolynomialContact, OfDegreeOneIsThePseudoRigidBody) {
  std::mt19937 generator(1);
  constexpr double t = 1.3;
  const loads::Loads loads(as_load(moving_planes(0.3, 0.4)), loads::Acceleration{{0.1, 0.2, -0.4}}, loads::Drag{0.2});
  for (const Vector3d& axes : {Vector3d(1, 1, 1), Vector3d(1.2, 0.9, 1.1)}) {
    const IncompressibleBody body(BodySetup{.degree = 1, .semi_axes = axes, .loads = loads});
    const auto reference = reduced::ReferenceBody::ellipsoid(axes);
    const loads::Forcing forcing = loads::constant_forcing(loads);
    using Reduced = reduced::LoadedBody<reduced::PseudoRigidBody<reduced::Potential, true>>;
    const Reduced reduced({reduced::Potential(materials::CiarletGeymonat{1, 0}, reference, forcing), reference}, loads);
    const Matrix3d Q = Matrix3d::Identity() + 0.2 * random_matrix(generator), Qdot = random_matrix(generator);
    const Vector3d c = 0.1 * random_matrix(generator).col(0), cdot = random_matrix(generator).col(1);
    const Matrix3d sample = random_matrix(generator);
    const auto state = Reduced::state_of({t, Q, Qdot}, c, cdot);
    Reduced::Workspace workspace;
    auto expected = reduced.make_vector();
    ASSERT_TRUE(reduced.force(t, state.q, state.v, workspace, expected));
    auto of_body = body.make_workspace();
    VectorXd f = body.make_vector();
    const VectorXd q = body.affine(Q, c), v = body.affine(Qdot, cdot);
    ASSERT_TRUE(body.force(t, q, v, of_body, f));
    const Matrix3d on_Q =
        body.space().affine_part(f.head(body.space().n_unknowns())) * body.space().inertia().asDiagonal();
    const Vector3d on_center = body.space().mean(f.head(body.space().n_unknowns())) * body.space().volume();
    EXPECT_LT((on_Q - expected.leftCols<3>()).norm(), 1e-13 * expected.norm());
    EXPECT_LT((on_center - expected.col(3)).norm(), 1e-13 * expected.norm());
    EXPECT_NEAR(body.contact(t, q).energy, reduced.contact(t, state.q).energy, 1e-14);
    EXPECT_NEAR(f[body.space().n_unknowns()], expected(0, 4), 1e-13 * expected.norm()) << "power of dissipation";
    EXPECT_NEAR(f[body.space().n_unknowns() + 1], expected(1, 4), 1e-13 * expected.norm()) << "power of the planes";
    EXPECT_GT(std::abs(expected(1, 4)), 1e-3);
    for (const auto kind : {mechanics::Linearization::tangent, mechanics::Linearization::secant}) {
      auto expected_change = reduced.make_vector();
      VectorXd change = body.make_vector();
      reduced.add_damping(state, Reduced::state_of({t, Q, sample}, cdot, c).v, kind, expected_change);
      body.add_damping({t, q, v}, body.affine(sample, c), kind, change);
      const Vector3d on_c = body.space().mean(change.head(body.space().n_unknowns())) * body.space().volume();
      EXPECT_LT((on_c - expected_change.col(3)).norm(), 1e-13 * expected_change.norm());
    }
  }
}

std::shared_ptr<const PolynomialSpace> space_of(int degree, const Planes& planes = no_planes) {
  return std::make_shared<PolynomialSpace>(degree, planes);
}
VectorXd bent(const PolynomialSpace& space, std::mt19937& generator, double size) {
  VectorXd x = VectorXd::Zero(space.n_unknowns());
  space.set_affine(Matrix3d(Vector3d(1.1, 0.95, 1).asDiagonal()), Vector3d::Zero(), x);
  return x + size * random_vector(space.n_unknowns(), generator).normalized();
}

/// The integrand has a kink at the edge of the contact, whose place on the grid decides the error: the mean over many
/// contacts has order 2 at least.
TEST(PolynomialContact, SumsTendToTheClosedFormOfAffineMotions) {
  const auto space = space_of(3), affine_space = space_of(1);
  VectorXd x = VectorXd::Zero(space->n_unknowns()), affine = VectorXd::Zero(affine_space->n_unknowns());
  const Matrix3d A = Vector3d(1.1, 0.95, 1).asDiagonal();
  space->set_affine(A, Vector3d::Zero(), x);
  affine_space->set_affine(A, Vector3d::Zero(), affine);
  std::vector<ErrorPoint> errors;
  for (const int q : {6, 12, 24, 48}) {
    errors.push_back({1.0 / q, 0});
    for (int i = 0; i < 12; ++i) {
      const Vector3d n = Vector3d(0.3 + 0.05 * i, -0.4, 0.8).normalized();
      const loads::Planes planes{{.normal = n, .position = -0.8 - 0.003 * i, .stiffness = 30}};
      const double exact = BodyContact(planes, affine_space).energy(0, affine);
      errors.back().error += std::abs(BodyContact(planes, space, q).energy(0, x) / exact - 1) / 12;
    }
  }
  EXPECT_GT(fit_order(errors).order, 2);
  EXPECT_LT(errors[2].error, 5e-3) << "with the usual points";
}

/// Friction and the power of planes in motion tend to those of the pseudo-rigid body.
TEST(PolynomialContact, SumsOfFrictionTendToThoseOfAffineMotions) {
  const auto space = space_of(3), affine_space = space_of(1);
  const Matrix3d A = Vector3d(1.1, 0.95, 1).asDiagonal(),
                 rate = (Matrix3d() << 0.3, -0.1, 0.2, 0.4, 0.1, -0.3, 0.2, 0.5, -0.4).finished();
  const auto affine_in = [](const PolynomialSpace& in, const Matrix3d& map, const Vector3d& shift) {
    VectorXd x = VectorXd::Zero(in.n_unknowns());
    in.set_affine(map, shift, x);
    return x;
  };
  constexpr double t = 0.7;
  std::vector<ErrorPoint> of_friction, of_power;
  for (const int n : {6, 12, 24, 48}) {
    of_friction.push_back({1.0 / n, 0});
    of_power.push_back({1.0 / n, 0});
    for (int i = 0; i < 8; ++i) {
      const Vector3d shift(0.02 * i, -0.01 * i, 0.03), velocity(0.4 - 0.1 * i, 0.2, 0.1);
      const auto at = [&](const PolynomialSpace& in, const BodyContact& contact) {
        VectorXd f = VectorXd::Zero(in.n_unknowns());
        const VectorXd x = affine_in(in, A, shift);
        const double given = contact.add_force(t, x, f);
        f.setZero();
        const loads::ContactPower power = contact.add_dissipation(t, x, affine_in(in, rate, velocity), f);
        return std::tuple(Vector3d(in.mean(f)), power.taken, given + power.given);
      };
      const loads::Planes planes = moving_planes(0.2, 0.4);
      const auto [force, taken, given] = at(*space, BodyContact(planes, space, n));
      const auto [exact, exact_taken, exact_given] = at(*affine_space, BodyContact(planes, affine_space));
      of_friction.back().error += (force - exact).norm() / exact.norm() / 8;
      of_power.back().error += (std::abs(taken / exact_taken - 1) + std::abs(given - exact_given) / exact_taken) / 8;
    }
  }
  EXPECT_GT(fit_order(of_friction).order, 1.8);
  EXPECT_GT(fit_order(of_power).order, 1.8);
  EXPECT_LT(of_friction[2].error, 1e-2) << "with the usual points";
}

TEST(PolynomialContact, LinearisedFrictionIsADerivative) {
  std::mt19937 generator(7);
  const auto space = space_of(3);
  const BodyContact contact(moving_planes(0.3, 0.4), space, 8);
  const VectorXd q = bent(*space, generator, 0.05), v = random_vector(space->n_unknowns(), generator),
                 u = random_vector(space->n_unknowns(), generator);
  const auto force_at = [&](int k) {
    VectorXd there = VectorXd::Zero(q.size());
    contact.add_dissipation(0.4, q, v + 1e-3 * k * u, there);
    return there;
  };
  VectorXd tangent = VectorXd::Zero(q.size()), secant = tangent, at_rest = tangent;
  contact.add_damping(0.4, q, v, u, mechanics::Linearization::tangent, tangent);
  contact.add_damping(0.4, q, v, v, mechanics::Linearization::secant, secant);
  EXPECT_LT((first_difference(force_at, 1e-3) - tangent).norm(), 1e-8 * tangent.norm());
  contact.add_dissipation(0.4, q, VectorXd::Zero(q.size()), at_rest);  // the damping of planes in motion
  EXPECT_LT((force_at(0) - at_rest - secant).norm(), 1e-12 * secant.norm());
  VectorXd f = VectorXd::Zero(q.size());
  const loads::ContactPower power = contact.add_dissipation(0.4, q, v, f);
  EXPECT_NEAR(power.taken - power.given, -f.dot(v), 1e-12 * power.taken);
  EXPECT_GT(power.taken, 0);
}

TEST(PolynomialContact, ForceAndRateAreDerivatives) {
  std::mt19937 generator(3);
  const auto space = space_of(3);
  const BodyContact contact(oblique_planes(), space, 8);
  const VectorXd q = bent(*space, generator, 0.05), u = random_vector(space->n_unknowns(), generator).normalized();
  VectorXd f = VectorXd::Zero(q.size()), rate = f;
  contact.add_force(0, q, f);
  contact.add_force_rate(0, q, u, rate);
  // So near that no point passes through a plane.
  constexpr double h = 1e-6;
  const auto force_at = [&](int k) {
    VectorXd there = VectorXd::Zero(q.size());
    contact.add_force(0, q + h * k * u, there);
    return there;
  };
  const double slope = first_difference([&](int k) { return contact.energy(0, q + h * k * u); }, h);
  EXPECT_NEAR(f.dot(u), -slope, 1e-7 * f.norm());
  EXPECT_LT((rate - first_difference(force_at, h)).norm(), 1e-7 * rate.norm());
}

TEST(PolynomialContact, OfASectorIsThatOfTheWholeBody) {
  std::mt19937 generator(4);
  const auto whole = space_of(3);
  for (const Planes& planes : {Planes{true, true, false}, all_planes, Planes{false, false, true}}) {
    const auto sector = space_of(3, planes);
    const VectorXd q = bent(*sector, generator, 0.05);
    VectorXd of_whole = VectorXd::Zero(whole->n_unknowns());
    for_each_coefficient(*sector, *whole, [&](int at, int there) { of_whole[there] = q[at]; });
    const loads::Contact a = BodyContact(press(), sector, 8).contact(0, q),
                         b = BodyContact(press(), whole, 8).contact(0, of_whole);
    EXPECT_NEAR(a.energy, b.energy, 1e-14);
    EXPECT_NEAR(a.force, b.force, 1e-13);
    EXPECT_NEAR(a.radius, b.radius, 1e-13);
    EXPECT_NEAR(a.height, b.height, 1e-14);
    EXPECT_LT((a.point - b.point).norm(), 1e-13);
    VectorXd f = VectorXd::Zero(sector->n_unknowns()), f_whole = VectorXd::Zero(whole->n_unknowns());
    BodyContact(press(), sector, 8).add_force(0, q, f);
    BodyContact(press(), whole, 8).add_force(0, of_whole, f_whole);
    for_each_coefficient(*sector, *whole, [&](int at, int there) { EXPECT_NEAR(f[at], f_whole[there], 1e-13); });
    const loads::Planes rough = rough_press();
    const VectorXd v = random_vector(sector->n_unknowns(), generator);
    VectorXd v_whole = VectorXd::Zero(whole->n_unknowns());
    for_each_coefficient(*sector, *whole, [&](int at, int there) { v_whole[there] = v[at]; });
    const auto of_sector = BodyContact(rough, sector, 8).add_dissipation(0.3, q, v, f),
               of_all = BodyContact(rough, whole, 8).add_dissipation(0.3, of_whole, v_whole, f_whole);
    EXPECT_NEAR(of_sector.taken, of_all.taken, 1e-12 * of_all.taken);
    EXPECT_NEAR(of_sector.given, of_all.given, 1e-12 * of_all.taken);
    EXPECT_GT(of_all.taken, 1e-2);
    for_each_coefficient(*sector, *whole, [&](int at, int there) { EXPECT_NEAR(f[at], f_whole[there], 1e-12); });
  }
}

/// A body that is far from the planes has no force, and the bound that says so does not hide a touching point.
TEST(PolynomialContact, TheBoundHidesNoContact) {
  std::mt19937 generator(5);
  const auto space = space_of(5);
  int n_touching = 0;
  for (int i = 0; i < 40; ++i) {
    VectorXd q = bent(*space, generator, 0.3);
    VectorXd shift = VectorXd::Zero(q.size());
    space->set_affine(Matrix3d::Zero(), Vector3d(0, 0, 0.02 * i), shift);
    q += shift;
    loads::Planes floor{{.normal = Vector3d::UnitZ(), .position = -0.7, .stiffness = 30}};
    const BodyContact contact(floor, space, 8);
    VectorXd f = VectorXd::Zero(q.size());
    contact.add_force(0, q, f);
    const loads::Contact now = contact.contact(0, q);
    EXPECT_EQ(f.norm() > 0, now.force > 0);
    n_touching += now.force > 0;
  }
  EXPECT_GT(n_touching, 5);
  EXPECT_LT(n_touching, 40);
}

}  // namespace
}  // namespace pseudorigid::testing
