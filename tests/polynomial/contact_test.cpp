/// Contact of polynomial bodies with rigid planes: of degree 1 it is that of the pseudo-rigid body to round-off, of
/// higher degrees the sum over the points tends to it on affine motions; forces are derivatives; sectors are parts of
/// the whole.

#include <gtest/gtest.h>

#include <random>

#include "polynomial/samples.h"
#include "reduced/body_on_planes.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"
#include "support/differences.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using polynomial::BodyContact;
using polynomial::PolynomialSpace;

/// Oblique planes that the unit ball about the origin is 0.2 and 0.1 behind.
loads::Planes oblique_planes(double damping = 0) {
  const Vector3d n = Vector3d(0.3, -0.4, 0.8).normalized(), m = Vector3d(-1, 0.2, 0).normalized();
  return {{.normal = n, .position = -0.8, .stiffness = 30, .damping = damping},
          {.normal = m, .position = -0.9, .stiffness = 50, .damping = damping}};
}
/// Two that press the ball along z, and a mirror image of each.
loads::Planes press() {
  return {{.normal = Vector3d::UnitZ(), .position = -0.9, .stiffness = 30},
          {.normal = -Vector3d::UnitZ(), .position = -0.9, .stiffness = 30}};
}
loads::RigidPlanes as_load(const loads::Planes& planes) {
  loads::RigidPlanes load;
  load.stiffness = planes.front().stiffness;
  load.damping = planes.front().damping;
  for (const loads::Plane& plane : planes)
    for (int i = 0; i < 3; ++i) {
      load.normals.push_back(plane.normal[i]);
      load.points.push_back(plane.position * plane.normal[i]);
    }
  return load;
}

TEST(PolynomialContact, OfDegreeOneIsThePseudoRigidBody) {
  std::mt19937 generator(1);
  const loads::Loads loads(as_load(oblique_planes(0.3)), loads::Acceleration{{0.1, 0.2, -0.4}}, loads::Drag{0.2});
  for (const Vector3d& axes : {Vector3d(1, 1, 1), Vector3d(1.2, 0.9, 1.1)}) {
    const IncompressibleBody body(BodySetup{.degree = 1, .semi_axes = axes, .loads = loads});
    const auto reference = reduced::ReferenceBody::ellipsoid(axes);
    const loads::Forcing forcing = loads::constant_forcing(loads);
    using Reduced = reduced::BodyOnPlanes<reduced::PseudoRigidBody<reduced::Potential, true>>;
    const Reduced reduced({reduced::Potential(materials::CiarletGeymonat{1, 0}, reference, forcing), reference}, loads);
    const Matrix3d Q = Matrix3d::Identity() + 0.2 * random_matrix(generator), Qdot = random_matrix(generator);
    const Vector3d c = 0.1 * random_matrix(generator).col(0), cdot = random_matrix(generator).col(1);
    const auto state = Reduced::state_of({0, Q, Qdot}, c, cdot);
    Reduced::Workspace workspace;
    auto expected = reduced.make_vector();
    ASSERT_TRUE(reduced.force(0, state.q, state.v, workspace, expected));
    auto of_body = body.make_workspace();
    VectorXd f = body.make_vector();
    const VectorXd q = body.affine(Q, c), v = body.affine(Qdot, cdot);
    ASSERT_TRUE(body.force(0, q, v, of_body, f));
    const Matrix3d on_Q =
        body.space().affine_part(f.head(body.space().n_unknowns())) * body.space().inertia().asDiagonal();
    const Vector3d on_center = body.space().mean(f.head(body.space().n_unknowns())) * body.space().volume();
    EXPECT_LT((on_Q - expected.leftCols<3>()).norm(), 1e-13 * expected.norm());
    EXPECT_LT((on_center - expected.col(3)).norm(), 1e-13 * expected.norm());
    EXPECT_NEAR(body.contact(q).energy, reduced.contact(state.q).energy, 1e-14);
    EXPECT_NEAR(f[body.space().n_unknowns()], expected(0, 4), 1e-13 * expected.norm()) << "power of dissipation";
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
      const double exact = BodyContact(planes, affine_space).energy(affine);
      errors.back().error += std::abs(BodyContact(planes, space, q).energy(x) / exact - 1) / 12;
    }
  }
  EXPECT_GT(fit_order(errors).order, 2);
  EXPECT_LT(errors[2].error, 5e-3) << "with the usual points";
}

TEST(PolynomialContact, ForceAndRateAreDerivatives) {
  std::mt19937 generator(3);
  const auto space = space_of(3);
  const BodyContact contact(oblique_planes(), space, 8);
  const VectorXd q = bent(*space, generator, 0.05), u = random_vector(space->n_unknowns(), generator).normalized();
  VectorXd f = VectorXd::Zero(q.size()), rate = f;
  contact.add_force(q, f);
  contact.add_force_rate(q, u, rate);
  // So near that no point passes through a plane.
  constexpr double h = 1e-6;
  const auto force_at = [&](int k) {
    VectorXd there = VectorXd::Zero(q.size());
    contact.add_force(q + h * k * u, there);
    return there;
  };
  const double slope = first_difference([&](int k) { return contact.energy(q + h * k * u); }, h);
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
    const loads::Contact a = BodyContact(press(), sector, 8).contact(q),
                         b = BodyContact(press(), whole, 8).contact(of_whole);
    EXPECT_NEAR(a.energy, b.energy, 1e-14);
    EXPECT_NEAR(a.force, b.force, 1e-13);
    EXPECT_NEAR(a.radius, b.radius, 1e-13);
    EXPECT_NEAR(a.height, b.height, 1e-14);
    EXPECT_LT((a.point - b.point).norm(), 1e-13);
    VectorXd f = VectorXd::Zero(sector->n_unknowns()), f_whole = VectorXd::Zero(whole->n_unknowns());
    BodyContact(press(), sector, 8).add_force(q, f);
    BodyContact(press(), whole, 8).add_force(of_whole, f_whole);
    for_each_coefficient(*sector, *whole, [&](int at, int there) { EXPECT_NEAR(f[at], f_whole[there], 1e-13); });
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
    contact.add_force(q, f);
    const loads::Contact now = contact.contact(q);
    EXPECT_EQ(f.norm() > 0, now.force > 0);
    n_touching += now.force > 0;
  }
  EXPECT_GT(n_touching, 5);
  EXPECT_LT(n_touching, 40);
}

}  // namespace
}  // namespace pseudorigid::testing
