/// Critical points of potentials, in charts and with constraints: where they are, their indices and spectra.

#include "mechanics/equilibria/critical_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "mechanics/equilibria/chart_landscape.h"
#include "mechanics/equilibria/constrained_landscape.h"
#include "mechanics/sphere_particle.h"
#include "systems/double_pendulum.h"
#include "systems/mass_points.h"
#include "systems/rigid_body.h"

namespace pseudorigid::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using mechanics::ChartLandscape;
using mechanics::ConstrainedLandscape;
using mechanics::CriticalPoints;
using mechanics::CriticalPointSearch;

/// Hessians by differences of the force.
constexpr double from_differences = 1e-11;

template <class L>
CriticalPoints find(const L& landscape, const CriticalPointSearch& search = {}) {
  CriticalPoints found;
  const auto status = mechanics::find_critical_points(landscape, search, found);
  EXPECT_TRUE(status) << status.reason();
  return found;
}

/// U of two coordinates on the plane with the metric diag(1, 4); drag D(v) = −(v₁, 3v₂).
template <class U>
struct Plane {
  static constexpr int dimension = 2;
  U u;
  template <class T>
  Eigen::Matrix<T, 2, 2> metric(const mechanics::Coordinates<T, 2>&) const {
    Eigen::Matrix<T, 2, 2> g;
    g << T(1.0), T(0.0), T(0.0), T(4.0);
    return g;
  }
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    return u(q[0], q[1]);
  }
  Vector2d dissipation(const Vector2d&, const Vector2d& v) const { return {-v[0], -3 * v[1]}; }
};

TEST(CriticalPoints, OfADoubleWell) {
  // U = (x² − 1)²/4 + 2y²: minima (±1, 0), H = diag(2, 4/4); a saddle at 0, H = diag(−1, 1).
  const auto u = [](const auto& x, const auto& y) -> std::decay_t<decltype(x)> {
    return (x * x - 1.0) * (x * x - 1.0) * 0.25 + 2.0 * y * y;
  };
  const auto found = find(ChartLandscape(Plane<decltype(u)>{u}), {.radius = 3});
  ASSERT_EQ(found.points.size(), 3u);
  EXPECT_GT(found.n_converged, 150);
  EXPECT_LT((found.points[0].q - Vector2d(-1, 0)).norm(), 1e-12);
  EXPECT_LT((found.points[1].q - Vector2d(1, 0)).norm(), 1e-12);
  EXPECT_LT((found.points[2].q - Vector2d(0, 0)).norm(), 1e-12);
  EXPECT_EQ(found.points[0].morse_index, 0);
  EXPECT_EQ(found.points[2].morse_index, 1);
  EXPECT_LT((found.points[1].hessian_eigenvalues - Vector2d(1, 2)).norm(), 1e-12);
  for (const auto& p : found.points) EXPECT_TRUE(p.obeys_5_8_3());

  // At the saddle: z² + z − 1 = 0 along x, z² + 3z + 1 = 0 along y.
  std::vector<double> rates;
  for (const auto& z : found.points[2].rates) {
    EXPECT_NEAR(z.imag(), 0, 1e-12);
    rates.push_back(z.real());
  }
  std::sort(rates.begin(), rates.end());
  const double r5 = std::sqrt(5.0);
  const std::vector<double> expected{(-3 - r5) / 2, (-1 - r5) / 2, (-3 + r5) / 2, (-1 + r5) / 2};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(rates[k], expected[k], 1e-12);
}

TEST(CriticalPoints, ADegenerateOneHasNullity) {
  const auto u = [](const auto& x, const auto& y) -> std::decay_t<decltype(x)> { return x * x * x * x + 0.5 * y * y; };
  const auto found = find(ChartLandscape(Plane<decltype(u)>{u}));
  ASSERT_EQ(found.points.size(), 1u);
  EXPECT_EQ(found.points[0].nullity, 1);
  EXPECT_EQ(found.points[0].morse_index, 0);
  EXPECT_FALSE(found.points[0].hyperbolic());
}

TEST(CriticalPoints, OfAPotentialWithoutAny) {
  const auto u = [](const auto& x, const auto& y) -> std::decay_t<decltype(x)> { return x + 0.1 * sin(y); };
  const auto found = find(ChartLandscape(Plane<decltype(u)>{u}));
  EXPECT_TRUE(found.points.empty());
  EXPECT_EQ(found.n_converged, 0);
  EXPECT_EQ(found.n_starts, 200);
}

/// A critical circle is counted once, with the nullity of the symmetry.
TEST(CriticalPoints, AnOrbitOfSymmetriesIsOnePoint) {
  const auto u = [](const auto& x,
                    const auto& y) -> std::decay_t<decltype(x)> {  // symmetric under the turns of (x, 2y), isometries
    return (x * x + 4.0 * y * y - 1.0) * (x * x + 4.0 * y * y - 1.0);
  };
  const auto found = find(ChartLandscape(Plane<decltype(u)>{u}), {.radius = 2});
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_EQ(found.points[0].nullity, 1);
  EXPECT_NEAR(std::hypot(found.points[0].q[0], 2 * found.points[0].q[1]), 1, 1e-9);
  EXPECT_EQ(found.points[1].morse_index, 2);
}

/// The poles of the sphere: a minimum and a maximum of the height, H = ±(g/R) Id in the metric, λ = ±m g R.
TEST(CriticalPoints, OfAHeavyParticleOnTheSphere) {
  SphereParticle particle;
  particle.C = Eigen::Vector3d(0.3, 0.5, 0.9).asDiagonal();
  const ConstrainedLandscape landscape(particle);
  const auto found = find(landscape, {.radius = 3});
  ASSERT_EQ(found.points.size(), 2u);
  for (const int k : {0, 1}) {
    const auto& p = found.points[k];
    const double sign = k == 0 ? 1 : -1;
    EXPECT_LT((p.q - Eigen::Vector3d(0, 0, -sign * particle.R)).norm(), 1e-10);
    EXPECT_NEAR(p.lambda[0], -sign * particle.m * particle.gravity * particle.R, 1e-10);
    EXPECT_EQ(p.morse_index, k == 0 ? 0 : 2);
    EXPECT_EQ(p.nullity, 0);
    const double curvature = sign * particle.gravity / particle.R;
    EXPECT_LT((p.hessian_eigenvalues - Vector2d::Constant(curvature)).norm(), from_differences);
    EXPECT_TRUE(p.obeys_5_8_3());
    // z² + (c/m) z + sign g/R = 0 for the two horizontal directions.
    for (const auto& z : p.rates) {
      const double residual = std::min(std::abs(z * z + 0.3 / particle.m * z + curvature),
                                       std::abs(z * z + 0.5 / particle.m * z + curvature));
      EXPECT_LT(residual, 1e-10);
    }
  }
}

/// Damping beside the system's own may be any operator, also one with a part that does no work.
TEST(CriticalPoints, DampingMayBeAnyOperator) {
  const SphereParticle particle;
  const auto C = [](const VectorXd&) -> MatrixXd {
    return Eigen::Matrix3d{{0.4, 2, 0}, {-2, 0.4, 0}, {0, 0, 0.4}};  // drag, and a magnetic force
  };
  const auto found = find(ConstrainedLandscape(particle), {.radius = 3, .added_damping = C});
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_TRUE(found.points[0].obeys_5_8_3());
  EXPECT_TRUE(found.points[1].obeys_5_8_3());  // the magnetic force would hold the top, but not against drag
  EXPECT_EQ(found.points[1].n_unstable, 2);
  // z² + ((0.4 ± 2i)/m) z − g/R = 0 for x ± iy at the top.
  for (const auto& z : found.points[1].rates) {
    const std::complex<double> turn(0.4 / particle.m, 2 / particle.m);
    const double curvature = -particle.gravity / particle.R;
    EXPECT_LT(std::min(std::abs(z * z + turn * z + curvature), std::abs(z * z + std::conj(turn) * z + curvature)),
              1e-10);
  }
}

/// Without dissipation nothing is asymptotically stable, and the index alone is told.
TEST(CriticalPoints, WithoutDampingMinimaAreCentres) {
  const auto found = find(ConstrainedLandscape(SphereParticle{}), {.radius = 3});
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_EQ(found.points[0].n_unstable + found.points[0].n_stable, 0);
  EXPECT_FALSE(found.points[0].hyperbolic());
  EXPECT_EQ(found.points[1].n_unstable, 2);
  EXPECT_EQ(found.points[1].n_stable, 2);
  // z² = −g/R at the bottom and g/R at the top, each with both roots for both directions.
  const SphereParticle particle;
  const double rate = std::sqrt(particle.gravity / particle.R);
  for (const std::size_t k : {0u, 1u}) {
    const auto& rates = found.points[k].rates;
    ASSERT_EQ(rates.size(), 4);
    EXPECT_LT(std::abs(rates.sum()), 1e-10);
    for (const auto& z : rates) {
      EXPECT_NEAR(std::abs(k == 0 ? z.imag() : z.real()), rate, 1e-10);
      EXPECT_EQ(k == 0 ? z.real() : z.imag(), 0);
    }
  }
}

/// A heavy rigid body with a fixed point: hanging and standing, each an orbit of the turns about the vertical.
TEST(CriticalPoints, OfAHeavyRigidBody) {
  systems::FixedPointBody::Parameters p;
  p.E0 = Eigen::Vector3d(1, 2, 3).asDiagonal();
  p.loads.center = {0, 0, 0.5};
  p.loads.gravity = {0, 0, -2};
  const systems::FixedPointBody body(p);
  CriticalPointSearch search;
  search.center = Eigen::Matrix3d(Eigen::Matrix3d::Identity()).reshaped();
  const auto found = find(ConstrainedLandscape(body), search);
  ASSERT_EQ(found.points.size(), 2u);
  EXPECT_NEAR(found.points[0].V, -1, 1e-10);
  EXPECT_EQ(found.points[0].morse_index, 0);
  EXPECT_EQ(found.points[0].nullity, 1);
  EXPECT_EQ(found.points[1].morse_index, 2);
  EXPECT_EQ(found.points[1].nullity, 1);
  // Pendulum frequencies m g l/I with I = (2 + 3, 1 + 3) about the horizontal axes.
  EXPECT_LT((found.points[0].hessian_eigenvalues - Eigen::Vector3d(0, 1.0 / 5, 1.0 / 4)).norm(), from_differences);
}

/// Without constraints: two points on a spring in a confinement; turns of space leave a sphere of minima.
/// The step of the differences follows the size of the position: the Hessian of a harmonic trap is exact however far
/// away.
TEST(ConstrainedLandscape, HessianFarFromTheOriginKeepsItsDigits) {
  systems::MassPoints::Parameters p;
  p.masses = VectorXd::Ones(1);
  p.confinement = 1.7;
  const systems::MassPoints points(p);
  MatrixXd H;
  ASSERT_TRUE(ConstrainedLandscape(points).hessian(Eigen::Vector3d(1e5, -3e5, 2e5), VectorXd(), H));
  EXPECT_LT((H - 1.7 * MatrixXd::Identity(3, 3)).norm(), 1e-13);
}

TEST(CriticalPoints, OfMassPoints) {
  systems::MassPoints::Parameters p;
  p.masses = Eigen::Vector2d(1, 1);
  p.springs.push_back({0, 1, {1, 2}});  // stiffness 1, length 2
  p.confinement = 0.5;
  const systems::MassPoints points(p);
  CriticalPointSearch search;
  search.center = (VectorXd(6) << 1, 0, 0, -1, 0.1, 0.2).finished();
  const auto found = find(ConstrainedLandscape(points), search);
  ASSERT_GE(found.points.size(), 1u);
  // At distance r from the centre, on both sides: k(2r − l) + ½r = 0, r = k l/(2k + ½).
  const auto& minimum = found.points[0];
  EXPECT_NEAR((minimum.q.head<3>() - minimum.q.tail<3>()).norm(), 2 * 2 / 2.5, 1e-10);
  EXPECT_EQ(minimum.morse_index, 0);
  EXPECT_EQ(minimum.nullity, 2);
}

TEST(CriticalPoints, TheSameSearchGivesTheSameResult) {
  const systems::DoublePendulum pendulum({1.3, 0.7, 0.9, 1.2, 2.1});
  const ConstrainedLandscape landscape(pendulum);
  const auto a = find(landscape, {.radius = 2}), b = find(landscape, {.radius = 2});
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_EQ(a.n_converged, b.n_converged);
  for (std::size_t k = 0; k < a.points.size(); ++k) EXPECT_EQ(a.points[k].q, b.points[k].q);
}

TEST(CriticalPoints, ACentreOfTheWrongSizeIsAReport) {
  CriticalPoints found;
  const SphereParticle particle;
  const auto status =
      mechanics::find_critical_points(ConstrainedLandscape(particle), {.center = VectorXd::Zero(2)}, found);
  EXPECT_NE(status.reason().find("2 coordinates in place of 3"), std::string::npos) << status.reason();
}

}  // namespace
}  // namespace pseudorigid::testing
