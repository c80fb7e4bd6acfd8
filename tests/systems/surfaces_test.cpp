/// Surfaces: their metrics are those of their embeddings, and their geodesics the known ones.

#include "systems/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mechanics/core/chart_field.h"
#include "support/integrate.h"
#include "support/round_off.h"
#include "support/surface_curves.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mechanics::ChartField;
using mechanics::State;

/// Image of a curve's 2-jet: position, velocity and acceleration in space.
struct SpaceJet {
  Vector3d x, v, a;
};

template <class Surface>
SpaceJet image(const Surface& surface, const CurveJet& jet) {
  const auto x = surface.embedding(taylor(jet));
  SpaceJet space;
  for (int i = 0; i < 3; ++i) {
    space.x[i] = x[i].value().value();
    space.v[i] = x[i].value().derivatives()[0];
    space.a[i] = x[i].derivatives()[0].derivatives()[0];
  }
  return space;
}

/// Dx: a column a coordinate.
template <class Surface>
Eigen::Matrix<double, 3, 2> tangent_map(const Surface& surface, const Vector2d& q) {
  Eigen::Matrix<double, 3, 2> Dx;
  for (int k = 0; k < 2; ++k) Dx.col(k) = image(surface, {q, Vector2d::Unit(k), Vector2d::Zero()}).v;
  return Dx;
}

template <class Test>
void for_each_embedded_surface(const Test& test) {
  test(systems::Sphere{1.7});
  test(systems::TorusSurface{2.5, 0.8});
  test(systems::Ellipsoid{1.5, 1, 0.7});
  test(systems::Paraboloid{0.8});
}

std::vector<CurveJet> surface_jets() { return random_jets({0.2, -3}, {2.9, 3}, 50); }

TEST(Surfaces, MetricIsInducedByTheEmbedding) {
  for_each_embedded_surface([](const auto& surface) {
    for (const auto& [q, v, a] : surface_jets()) {
      const auto Dx = tangent_map(surface, q);
      const Matrix2d g = surface.metric(q);
      EXPECT_LT((g - Dx.transpose() * Dx).norm(), round_off * g.norm());
    }
  });
}

/// Exercise 5.4.1: D = (∇)^T is the Levi-Civita connection of the induced metric: Dx (Dq̇/dt) is the tangential part of
/// the acceleration in space, for any curve.
TEST(Statement_Ex5_4_1, TangentialPartOfTheAccelerationIsTheConnectionOfTheInducedMetric) {
  for_each_embedded_surface([](const auto& surface) {
    const ChartField field(surface);
    for (const CurveJet& jet : surface_jets()) {
      Vector2d D;
      ASSERT_TRUE(field.covariant_acceleration(jet.q, jet.v, jet.a, D));
      const auto Dx = tangent_map(surface, jet.q);
      const Vector3d a = image(surface, jet).a;
      const Vector3d tangential = Dx * (Dx.transpose() * Dx).inverse() * (Dx.transpose() * a);
      EXPECT_LT((Dx * D - tangential).norm(), 10 * round_off * (1 + a.norm()));  // times the condition of g
    }
  });
}

TEST(Surfaces, GeodesicsOfTheSphereAreGreatCircles) {
  const systems::Sphere sphere{1.7};
  const ChartField field(sphere);
  using State = State<ChartField<systems::Sphere>>;
  const State start{0, {1.2, 0.3}, {0.4, 0.5}};
  const SpaceJet s0 = image(sphere, {start.q, start.v, Vector2d::Zero()});
  const double speed = s0.v.norm(), period = 2 * std::numbers::pi * sphere.R / speed;
  const Vector3d normal = s0.x.cross(s0.v).normalized();
  for (const State& s : integrate_samples(field, start, period, 16))
    EXPECT_NEAR(image(sphere, {s.q, s.v, Vector2d::Zero()}).x.dot(normal), 0, 1e-11);
  const State end = integrate(field, start, period);
  const SpaceJet back = image(sphere, {end.q, end.v, Vector2d::Zero()});
  EXPECT_LT((back.x - s0.x).norm() + (back.v - s0.v).norm(), 1e-11);
}

/// Clairaut: on the torus ρ² u̇ is constant along geodesics, and so is the speed.
TEST(Surfaces, GeodesicsOfTheTorusObeyClairaut) {
  const systems::TorusSurface torus;
  const ChartField field(torus);
  using State = State<ChartField<systems::TorusSurface>>;
  const State start{0, {0.4, 0}, {0.9, 0.1}};  // passes through the hole
  const auto clairaut = [](const State& s) { return std::pow(3 + std::cos(s.q[0]), 2) * s.v[1]; };
  for (const State& s : integrate_samples(field, start, 50, 50)) {
    EXPECT_NEAR(clairaut(s), clairaut(start), 1e-11);
    EXPECT_NEAR(field.energy(s.q, s.v), field.energy(start.q, start.v), 1e-11);
  }
}

/// The section y = 0 of the triaxial ellipsoid, an ellipse, is a closed geodesic; its length by the integral
/// ∮√(a²cos²θ + c²sin²θ)dθ = 4a E(k), k² = 1 − c²/a².
TEST(Surfaces, PrincipalSectionOfTheEllipsoidIsAGeodesic) {
  const systems::Ellipsoid ellipsoid{1.5, 1, 0.7};
  const ChartField field(ellipsoid);
  using State = State<ChartField<systems::Ellipsoid>>;
  // The quarter from θ = π/2 to the pole, where the chart ends, less a little: compared with the ellipse at the end.
  const State start{0, {std::numbers::pi / 2, 0}, {-1 / 0.7, 0}};  // unit speed
  const double k = std::sqrt(1 - 0.7 * 0.7 / (1.5 * 1.5));
  for (const State& s : integrate_samples(field, start, 1.5, 15)) {
    const double angle = s.q[0], length = 1.5 * (std::comp_ellint_2(k) - std::ellint_2(k, angle));
    EXPECT_NEAR(length, s.t, 1e-11);
    EXPECT_EQ(s.q[1], 0);
  }
}

/// A meridian of the paraboloid: length ∫√(1 + k²r²)dr = ½[r√(1 + k²r²) + asinh(kr)/k], through the vertex.
TEST(Surfaces, MeridianOfTheParaboloidIsAGeodesic) {
  const systems::Paraboloid paraboloid{0.8};
  const ChartField field(paraboloid);
  const auto length = [](double r) { return 0.5 * (r * std::sqrt(1 + 0.64 * r * r) + std::asinh(0.8 * r) / 0.8); };
  using State = State<ChartField<systems::Paraboloid>>;
  const double r0 = -1.1;
  const Vector2d direction(0.6, 0.8);
  const State start{0, r0 * direction, direction / std::sqrt(1 + 0.64 * r0 * r0)};
  for (const State& s : integrate_samples(field, start, 4, 10)) {
    EXPECT_NEAR(length(s.q.dot(direction)) - length(r0), s.t, 1e-11);
    EXPECT_NEAR(s.q[0] * direction[1] - s.q[1] * direction[0], 0, 1e-12);
  }
}

/// In the half-plane geodesics are half circles (x − x₀)² + y² = r², run through as x = x₀ + r tanh s, y = r/cosh s.
TEST(Surfaces, GeodesicsOfTheHyperbolicPlaneAreHalfCircles) {
  const ChartField field(systems::HyperbolicHalfPlane{});
  using State = State<ChartField<systems::HyperbolicHalfPlane>>;
  const State start{0, {0.5, 2}, {2, 0}};  // unit speed at the top of the circle with r = 2
  for (const State& s : integrate_samples(field, start, 6, 12)) {
    EXPECT_NEAR(s.q[0], 0.5 + 2 * std::tanh(s.t), 1e-11);
    EXPECT_NEAR(s.q[1], 2 / std::cosh(s.t), 1e-11);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
