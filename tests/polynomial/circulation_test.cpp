/// The circulation Z = ∫ρ X × (Fᵀẋ) dX. It is the momentum of the turns of the reference ball, x(X) ↦ x(RX), which map
/// P_N to itself, the mass to itself, and, were integrals exact, energy and constraint to themselves (isotropic laws,
/// balls). So Z changes by the error of the quadrature alone. With exactness to degree 4q − 3 ≥ 2N + 3 and displacement
/// gradients of size a and degree N − 1, of N = 3 the terms of W up to a⁴ (degree 8) and of ψ ln J up to a³ are
/// integrated exactly: forces turn Z at the rate a⁵, and N = 1 keeps it.

#include <gtest/gtest.h>

#include "mechanics/core/axial_vectors.h"
#include "polynomial/motions.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

/// F (e_axis × X), a field of P_N: its coefficients by the quadrature, which is exact here.
VectorXd turned_reference(const IncompressibleBody& body, const VectorXd& q, int axis) {
  const auto& space = body.space();
  VectorXd turn = VectorXd::Zero(q.size());
  for (int p = 0; p < space.n_points(); ++p) {
    const auto jets = space.functions_at(space.points()[p]);
    const Vector3d X(space.points()[p].data()), u = space.gradient(jets, q) * Vector3d::Unit(axis).cross(X);
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < space.n_functions(); ++a)
        turn[space.place(i, a)] += space.weights()[p] * jets[a].value * u[i];
  }
  return turn;
}
Vector3d circulation(const IncompressibleBody& body, const VectorXd& q, const VectorXd& v) {
  Vector3d Z;
  for (int i = 0; i < 3; ++i) Z[i] = v.dot(turned_reference(body, q, i));
  return Z;
}

TEST(Circulation, OfAffineMotionsIsThatOfThePseudoRigidBody) {  // Z_A = m̄ ε_ABC (QᵀQ̇)_CB (PHYSICS section 1)
  const auto body = elastic_body<IncompressibleBody>(no_planes);
  const auto s = pulsating(body);
  const Matrix3d A = body.space().affine_part(s.q).transpose() * body.space().affine_part(s.v);
  const Vector3d expected =
      body.space().inertia()[0] * Vector3d(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1));
  EXPECT_LT((circulation(body, s.q, s.v) - expected).norm(), 1e-14);
  EXPECT_GT(expected.norm(), 0.1);
}

/// The turn of a field is a field: nothing of it is lost in P_N.
TEST(Circulation, TurnsOfTheReferenceBallMapTheSpaceToItself) {
  std::mt19937 generator(1);
  const auto body = elastic_body<IncompressibleBody>(no_planes, 4);
  const auto& space = body.space();
  const VectorXd q = random_direction(body, generator), turn = turned_reference(body, q, 1);
  const std::array xi{0.3, -0.5, 0.7};
  const auto jets = space.functions_at(xi);
  const Vector3d expected = space.gradient(jets, q) * Vector3d::UnitY().cross(Vector3d(xi.data()));
  EXPECT_LT((space.value(jets, turn) - expected).norm(), 1e-13);
}

TEST(Circulation, ForcesOfDegreeThreeTurnItAtTheFifthPowerOfTheDisplacement) {
  std::mt19937 generator(2);
  const auto body = elastic_body<IncompressibleBody>(no_planes);
  const VectorXd rest = body.affine(Matrix3d::Identity()), direction = random_direction(body, generator);
  auto workspace = body.make_workspace();
  VectorXd f = body.make_vector();
  std::vector<ErrorPoint> points;
  for (const double a : {0.004, 0.006, 0.008, 0.012, 0.016}) {
    const VectorXd q = rest + a * direction;
    ASSERT_TRUE(body.force(0, q, f, workspace, f));
    points.push_back({a, std::abs(f.dot(turned_reference(body, q, 2)))});
  }
  EXPECT_GT(fit_order(points).order, 4.7);
}

/// Largest changes of J and Z on the way.
struct Drift {
  double J = 0, Z = 0;
};
Drift drift(int degree, double amplitude) {
  const auto body = elastic_body<IncompressibleBody>(no_planes, degree);
  auto start = pulsating(body);
  start.q = body.affine(Matrix3d::Identity());
  start.v = amplitude * body.affine((Matrix3d() << 0.2, -0.8, 0.1, 0.6, -0.3, 0.2, 0, -0.1, 0.1).finished());
  const auto r = run<mechanics::Rattle4>(body, start, 2, 8, degree == 1 ? 10 : 4 * degree);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  const auto J = [&](const State<IncompressibleBody>& s) {
    return mechanics::axial_vector(body.space().moment(s.q, s.v));
  };
  Drift d;
  for (const auto& s : r.states) {
    d.J = std::max(d.J, (J(s) - J(start)).norm());
    d.Z = std::max(d.Z, (circulation(body, s.q, s.v) - circulation(body, start.q, start.v)).norm());
  }
  return d;
}

TEST(Circulation, IsKeptByDegreeOneToRoundOffAndTheBetterTheHigherTheDegree) {
  double before = 1e-6;
  EXPECT_LT(drift(1, 0.5).Z, 1e-14);
  for (const int N : {3, 5, 7}) {
    const Drift d = drift(N, 0.5);
    EXPECT_LT(d.J, 1e-13) << "the turns of space are symmetries of the sums, too";
    EXPECT_LT(d.Z, before / 100) << N;
    before = d.Z;
  }
}

TEST(Circulation, OfSmallMotionsIsKept) {
  const double large = drift(3, 0.4).Z, small = drift(3, 0.2).Z;
  EXPECT_LT(small, large / 16);
}

}  // namespace
}  // namespace pseudorigid::testing
