/// Self-gravity from the surface: against closed forms, with the order of the quadrature, and the exactness of its
/// derivative.

#include "gravity/surface_gravity.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "gravity/ellipsoid_gravity.h"
#include "support/order_fit.h"

namespace pseudorigid::gravity {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;

/// Nodes and weights of the Gauss rule on [−1, 1].
template <int m>
std::vector<std::pair<double, double>> gauss_rule() {
  std::vector<std::pair<double, double>> rule;
  const auto& nodes = boost::math::quadrature::gauss<double, m>::abscissa();
  const auto& weights = boost::math::quadrature::gauss<double, m>::weights();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    rule.push_back({nodes[i], weights[i]});
    if (nodes[i] != 0) rule.push_back({-nodes[i], weights[i]});
  }
  return rule;
}

/// F times the unit sphere: a cube's six faces with equiangular coordinates, each in n × n patches of m × m points.
/// `octant`: those with X > 0 alone, for even n.
template <int m>
SurfacePoints ellipsoid(const Matrix3d& F, int n, bool octant = false) {
  const Matrix3d cofactor = F.determinant() * F.inverse().transpose();
  SurfacePoints points;
  for (int face = 0; face < 3; ++face)
    for (const double side : {1.0, -1.0})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          for (const auto& [u, w_u] : gauss_rule<m>())
            for (const auto& [v, w_v] : gauss_rule<m>()) {
              const double a = pi / 4 * (2 * (i + 0.5 * (1 + u)) / n - 1),
                           b = pi / 4 * (2 * (j + 0.5 * (1 + v)) / n - 1);
              const double tan_a = std::tan(a), tan_b = std::tan(b), square = 1 + tan_a * tan_a + tan_b * tan_b;
              Vector3d X;
              X[face] = side;
              X[(face + 1) % 3] = tan_a;
              X[(face + 2) % 3] = tan_b;
              X /= std::sqrt(square);
              if (octant && X.minCoeff() < 0) continue;
              const double area = (1 + tan_a * tan_a) * (1 + tan_b * tan_b) / std::pow(square, 1.5);
              const double weight = area * w_u * w_v * std::pow(pi / 4 / n, 2);
              points.add(F * X, cofactor * X * weight);
            }
  return points;
}

struct Gravity {
  double energy, volume;
  SurfaceDerivative derivative;
};

Gravity gravity_of(const SurfacePoints& targets, const SurfacePoints& sources, double strength, double rest_volume) {
  const PairSums sums = sum_pairs(targets, sources);
  const SurfaceTotals of_targets = totals(targets, sums);
  return {surface_energy(of_targets, strength, rest_volume), of_targets.volume,
          surface_derivative(targets, sums, of_targets, strength, rest_volume)};
}

const Matrix3d axes = Vector3d(1.3, 1.1, 0.7).asDiagonal();

Vector3d at(const std::array<std::vector<double>, 3>& field, std::size_t i) {
  return {field[0][i], field[1][i], field[2][i]};
}

/// ∂Ê/∂F for x = FX and N = cof F N₀, without the dilation: ∂x = δA x, ∂N = (tr δA − δAᵀ)N.
Matrix3d affine_derivative(const SurfacePoints& points, const SurfaceDerivative& derivative) {
  Matrix3d sum = Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d by_N = at(derivative.by_area, i), N = points.area(i);
    sum += at(derivative.by_point, i) * points.point(i).transpose() + by_N.dot(N) * Matrix3d::Identity() -
           N * by_N.transpose();
  }
  return sum;
}

Matrix3d traceless(const Matrix3d& A) { return A - A.trace() / 3 * Matrix3d::Identity(); }

TEST(SurfaceGravity, EnergyOfTheSphereIsKnown) {
  const SurfacePoints points = ellipsoid<6>(Matrix3d::Identity(), 2);
  const Gravity gravity = gravity_of(points, points, 1, 4 * pi / 3);
  EXPECT_NEAR(gravity.volume, 4 * pi / 3, 1e-9);
  EXPECT_NEAR(gravity.energy, -16 * pi * pi / 15, 1e-6);
}

TEST(SurfaceGravity, NoBodyHasLessEnergyThanTheBall) {
  const double volume = 4 * pi / 3;
  const auto judged = [&](const SurfacePoints& points) {
    return judge_energy(gravity_of(points, points, 2, volume).energy, 2, volume);
  };
  EXPECT_TRUE(judged(ellipsoid<2>(Matrix3d::Identity(), 1)));
  EXPECT_TRUE(judged(ellipsoid<4>(axes / std::cbrt(axes.determinant()), 2)));
  // Two balls of half of the volume at one place: the overlap counts twice.
  SurfacePoints twice;
  const SurfacePoints half = ellipsoid<4>(std::cbrt(0.5) * Matrix3d::Identity(), 2);
  for (int copy = 0; copy < 2; ++copy)
    for (std::size_t i = 0; i < half.size(); ++i) twice.add(half.point(i), half.area(i));
  EXPECT_NEAR(enclosed_volume(twice), volume, 1e-6);
  EXPECT_FALSE(judged(twice));
}

/// Of the surface alone everything is known but to the error of the quadrature, which falls with the distance of the
/// points to the fourth power and faster.
TEST(SurfaceGravity, ForceOnAffineFieldsConvergesToThatOfTheEllipsoid) {
  const double volume = 4 * pi / 3 * axes.determinant(), mass = volume;
  const gravity::EllipsoidGravity exact{0.6 * mass * mass};
  // The energy does not know how the ellipsoid turned into what it is; ∂V/∂F Fᵀ is the same for all F with one FFᵀ.
  const Matrix3d expected = traceless(exact.gradient(axes) * axes.transpose());
  std::vector<testing::ErrorPoint> errors;
  for (const int n : {2, 3, 4, 6}) {
    const SurfacePoints points = ellipsoid<4>(axes, n);
    const Gravity gravity = gravity_of(points, points, 1, volume);
    EXPECT_NEAR(affine_derivative(points, gravity.derivative).trace(), 0, 1e-12);  // a dilation does no work
    errors.push_back(
        {1.0 / n, (traceless(affine_derivative(points, gravity.derivative)) - expected).norm() / expected.norm()});
  }
  EXPECT_GE(testing::fit_order(errors).order, 4) << errors.front().error << " … " << errors.back().error;
  EXPECT_LT(errors.back().error, 1e-6);
}

TEST(SurfaceGravity, DerivativeIsThatOfTheSums) {
  SurfacePoints points = ellipsoid<4>(axes, 1);
  const Gravity gravity = gravity_of(points, points, 2, 3);
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  SurfacePoints direction;
  double expected = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d dx(normal(generator), normal(generator), normal(generator)),
        dN = 0.1 * Vector3d(normal(generator), normal(generator), normal(generator));
    direction.add(dx, dN);
    expected += at(gravity.derivative.by_point, i).dot(dx) + at(gravity.derivative.by_area, i).dot(dN);
  }
  const auto energy = [&](double s) {
    SurfacePoints moved;
    for (std::size_t i = 0; i < points.size(); ++i)
      moved.add(points.point(i) + s * direction.point(i), points.area(i) + s * direction.area(i));
    return gravity_of(moved, moved, 2, 3).energy;
  };
  const double h = 1e-4;  // differences of order 4: error h⁴ and round-off 1e-16/h
  const double difference = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
  EXPECT_NEAR(difference, expected, 1e-9 * std::abs(expected));
}

TEST(SurfaceGravity, SecondDerivativeIsThatOfTheFirst) {
  const SurfacePoints points = ellipsoid<4>(axes, 1);
  std::mt19937 generator(8);
  std::normal_distribution<double> normal;
  SurfacePoints rate;
  for (std::size_t i = 0; i < points.size(); ++i)
    rate.add({normal(generator), normal(generator), normal(generator)},
             {0.1 * normal(generator), 0.1 * normal(generator), 0.1 * normal(generator)});
  const Moving surface{points, rate};
  const auto sums = sum_pairs(surface, surface);
  const SurfaceDerivative found = surface_derivative_rate(surface, sums, totals(surface, sums), 2, 3);
  const auto derivative = [&](double s) {
    SurfacePoints moved;
    for (std::size_t i = 0; i < points.size(); ++i)
      moved.add(points.point(i) + s * rate.point(i), points.area(i) + s * rate.area(i));
    return gravity_of(moved, moved, 2, 3).derivative;
  };
  const double h = 1e-4;  // as above
  const SurfaceDerivative near[] = {derivative(h), derivative(-h), derivative(2 * h), derivative(-2 * h)};
  const auto difference = [&](auto field, int c, std::size_t i) {
    const auto value = [&](int k) { return (near[k].*field)[c][i]; };
    return (8 * (value(0) - value(1)) - (value(2) - value(3))) / (12 * h);
  };
  for (const auto field : {&SurfaceDerivative::by_point, &SurfaceDerivative::by_area}) {
    double size = 0;
    for (int c = 0; c < 3; ++c)
      for (const double value : (found.*field)[c]) size = std::max(size, std::abs(value));
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR((found.*field)[c][i], difference(field, c, i), 1e-9 * size);
  }
}

TEST(SurfaceGravity, NeitherPushesNorTurnsTheBody) {
  Matrix3d F = axes;
  F(0, 1) = 0.4;
  F(2, 0) = -0.2;
  const SurfacePoints points = ellipsoid<5>(F, 1);
  const Gravity gravity = gravity_of(points, points, 1, 4);
  Vector3d force = Vector3d::Zero(), torque = Vector3d::Zero();
  double size = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d f = at(gravity.derivative.by_point, i);
    force += f;
    torque += points.point(i).cross(f) + points.area(i).cross(at(gravity.derivative.by_area, i));
    size += f.norm();
  }
  EXPECT_LT(force.norm(), 1e-14 * size);
  EXPECT_LT(torque.norm(), 1e-14 * size);
}

/// A part of the body with its images is the body.
TEST(SurfaceGravity, OctantsAreAnEighth) {
  const SurfacePoints octant = ellipsoid<4>(axes, 2, true), whole = ellipsoid<4>(axes, 2);
  SurfacePoints images;
  for (int signs = 0; signs < 8; ++signs) {
    const Vector3d s(signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1);
    for (std::size_t i = 0; i < octant.size(); ++i)
      images.add(s.cwiseProduct(octant.point(i)), s.cwiseProduct(octant.area(i)));
  }
  const double volume = 4 * pi / 3;
  const Gravity part = gravity_of(octant, images, 1, volume / 8), all = gravity_of(whole, whole, 1, volume);
  EXPECT_NEAR(8 * part.energy, all.energy, 1e-12 * std::abs(all.energy));
  // What is odd under a reflection cancels between the octants.
  const Matrix3d sum = 8 * affine_derivative(octant, part.derivative).diagonal().asDiagonal().toDenseMatrix();
  EXPECT_LT((sum - affine_derivative(whole, all.derivative)).norm(), 1e-12);
}

/// Points and areas in general position: their images are near for no reflection and for none far.
SurfacePoints random_points(std::size_t n) {
  std::mt19937 generator(static_cast<unsigned>(n));
  std::normal_distribution<double> normal;
  SurfacePoints points;
  for (std::size_t i = 0; i < n; ++i)
    points.add({normal(generator), normal(generator), normal(generator)},
               {normal(generator), normal(generator), normal(generator)});
  return points;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// For every set of mirrors and for numbers of points that fill the lanes of a vector or do not.
TEST(SurfaceGravity, PairsServeBothPoints) {
  for (int set = 0; set < 8; ++set)
    for (const std::size_t n : {1, 2, 7, 8, 9, 31, 64}) {
      const SurfacePoints points = random_points(n);
      SurfacePoints images;
      for (int k = 0; k < 8; ++k) {
        if ((k & ~set) != 0) continue;
        const Vector3d s(k & 1 ? -1 : 1, k & 2 ? -1 : 1, k & 4 ? -1 : 1);
        for (std::size_t i = 0; i < n; ++i) images.add(s.cwiseProduct(points.point(i)), s.cwiseProduct(points.area(i)));
      }
      const PairSums expected = sum_pairs(points, images),
                     found = sum_own_pairs(points, {(set & 1) != 0, (set & 2) != 0, (set & 4) != 0});
      double size = 0;  // of the largest sum, to which the others' round-off belongs
      for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < n; ++i)
          size = std::max({size, std::abs(expected.g[c][i]), std::abs(expected.h[c][i])});
      const double round_off = 1e-13 * size;
      EXPECT_LE(largest_difference(found.e, expected.e), round_off) << set << ' ' << n;
      for (int c = 0; c < 3; ++c) {
        EXPECT_LE(largest_difference(found.g[c], expected.g[c]), round_off) << set << ' ' << n << ' ' << c;
        EXPECT_LE(largest_difference(found.h[c], expected.h[c]), round_off) << set << ' ' << n << ' ' << c;
      }
    }
}

TEST(SurfaceGravity, PotentialOfTheSphereIsKnown) {
  const std::vector<double> potential =
      potential_at({Vector3d::Zero(), {0.3, -0.2, 0.4}}, ellipsoid<8>(Matrix3d::Identity(), 2), 1);
  EXPECT_NEAR(potential[0], -2 * pi, 1e-9);
  EXPECT_NEAR(potential[1], -2 * pi * (1 - 0.29 / 3), 1e-9);
}

}  // namespace
}  // namespace pseudorigid::gravity
