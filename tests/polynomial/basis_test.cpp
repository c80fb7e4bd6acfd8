/// Ball polynomials and the quadrature on the octant: orthonormal, with the right gradients and parities, exact as far
/// as they promise.

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "polynomial/octant_quadrature.h"
#include "polynomial/polynomial_space.h"
#include "polynomial/samples.h"
#include "support/differences.h"

namespace pseudorigid::testing {
namespace {

using polynomial::ball_polynomials;
using polynomial::evaluate_ball_polynomials;
using Point = std::array<double, 3>;

/// Calls visitor(ξ, weight) for a quadrature of the unit ball that has nothing to do with octants; exact for
/// polynomials of degree 27.
template <class Visitor>
void for_each_point_of_ball(Visitor&& visitor) {
  using Rule = boost::math::quadrature::gauss<double, 15>;
  constexpr int n_angles = 29;
  std::vector<std::pair<double, double>> rule;  // on [−1, 1]
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k)
    for (const double x : std::set{Rule::abscissa()[k], -Rule::abscissa()[k]}) rule.push_back({x, Rule::weights()[k]});
  for (const auto& [x, of_radius] : rule)
    for (const auto& [z, of_height] : rule)
      for (int k = 0; k < n_angles; ++k) {
        const double r = (1 + x) / 2, across = std::sqrt(1 - z * z),
                     angle = 2 * std::numbers::pi * (k + 0.3) / n_angles;
        visitor(Point{r * across * std::cos(angle), r * across * std::sin(angle), r * z},
                0.5 * of_radius * r * r * of_height * 2 * std::numbers::pi / n_angles);
      }
}

std::vector<Point> points_within() {
  return {{0, 0, 0}, {0, 0, 1}, {0, 0, -0.5}, {0.3, -0.2, 0.6}, {-0.7, 0.1, -0.2}, {0.6, 0.8, 0}};
}

TEST(BallPolynomials, AreThoseOfPNWithTheLowerDegreesFirst) {
  for (int N = 0; N <= 13; ++N) {
    const auto functions = ball_polynomials(N);
    EXPECT_EQ(functions.size(), static_cast<std::size_t>((N + 1) * (N + 2) * (N + 3) / 6));
    for (std::size_t a = 1; a < functions.size(); ++a) EXPECT_LE(functions[a - 1].n, functions[a].n);
    EXPECT_EQ(functions.size(), evaluate_ball_polynomials(N, {0.1, 0.2, 0.3}).size());
  }
}

TEST(BallPolynomials, AreOrthonormalUpToDegreeThirteen) {
  constexpr int N = 13;
  const auto n = static_cast<Eigen::Index>(ball_polynomials(N).size());
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n), values(n, 15 * 29);
  Eigen::Index column = 0;
  for_each_point_of_ball([&](const Point& xi, double weight) {
    const auto jets = evaluate_ball_polynomials(N, xi);
    for (Eigen::Index a = 0; a < n; ++a) values(a, column) = std::sqrt(weight) * jets[a].value;
    if (++column < values.cols()) return;
    mass.selfadjointView<Eigen::Lower>().rankUpdate(values);
    column = 0;
  });
  ASSERT_EQ(column, 0);
  const Eigen::MatrixXd full = mass.selfadjointView<Eigen::Lower>();
  EXPECT_LT((full - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 2e-13);
}

TEST(BallPolynomials, TheFirstAreThoseOfTheirDefinition) {
  const Point xi{0.3, -0.5, 0.4};
  const double volume = 4 * std::numbers::pi / 3, r2 = 0.09 + 0.25 + 0.16;
  const auto functions = ball_polynomials(2);
  const auto jets = evaluate_ball_polynomials(2, xi);
  const auto expected = [&](const polynomial::BallPolynomial& f) {
    if (f.n == 0) return 1 / std::sqrt(volume);
    if (f.n == 1) return xi[f.m == 1 ? 0 : f.m == -1 ? 1 : 2] / std::sqrt(volume / 5);
    // ∫(|ξ|² − 3/5)² = 4π (1/7 − 6/25 + 3/25) = 4π·4/175
    return (r2 - 0.6) / std::sqrt(16 * std::numbers::pi / 175);
  };
  for (std::size_t a = 0; a < functions.size(); ++a) {
    if (functions[a].n < 2 || functions[a].l == 0) {
      EXPECT_NEAR(jets[a].value, expected(functions[a]), 1e-15);
    }
  }
}

TEST(BallPolynomials, GradientsAreTheDerivatives) {
  constexpr int N = 13;
  constexpr double h = 1e-3;  // of differences of order 8
  for (const Point& xi : points_within()) {
    const auto jets = evaluate_ball_polynomials(N, xi);
    for (int k = 0; k < 3; ++k) {
      const Eigen::VectorXd difference = first_difference(
          [&](int step) {
            Point near = xi;
            near[k] += step * h;
            const auto there = evaluate_ball_polynomials(N, near);
            return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(there.size()),
                                                                [&](Eigen::Index a) { return there[a].value; }));
          },
          h);
      for (std::size_t a = 0; a < jets.size(); ++a)
        EXPECT_NEAR(jets[a].gradient[k], difference[static_cast<Eigen::Index>(a)], 1e-10) << a;
    }
  }
}

TEST(BallPolynomials, AreEvenOrOddAsTheirParitySays) {
  constexpr int N = 9;
  const auto functions = ball_polynomials(N);
  const Point xi{0.3, -0.2, 0.6};
  const auto jets = evaluate_ball_polynomials(N, xi);
  for (int k = 0; k < 3; ++k) {
    Point reflected = xi;
    reflected[k] = -reflected[k];
    const auto image = evaluate_ball_polynomials(N, reflected);
    for (std::size_t a = 0; a < functions.size(); ++a) {
      const double sign = functions[a].parity() >> k & 1 ? -1 : 1;
      EXPECT_NEAR(image[a].value, sign * jets[a].value, 1e-13);
    }
  }
}

/// ∫x^2a y^2b z^2c over the unit sphere: 2Γ(a+½)Γ(b+½)Γ(c+½)/Γ(a+b+c+3/2).
double integral_over_sphere(int a, int b, int c) {
  return 2 * std::tgamma(a + 0.5) * std::tgamma(b + 0.5) * std::tgamma(c + 0.5) / std::tgamma(a + b + c + 1.5);
}
double monomial(const Point& xi, int a, int b, int c) {
  return std::pow(xi[0], 2 * a) * std::pow(xi[1], 2 * b) * std::pow(xi[2], 2 * c);
}

/// Largest relative error of 8 octants among the even monomials of that degree.
template <class Points>
double largest_error(const Points& points, int degree, bool of_surface) {
  double largest = 0;
  for (int a = 0; 2 * a <= degree; ++a)
    for (int b = 0; 2 * (a + b) <= degree; ++b) {
      const int c = degree / 2 - a - b;
      const double exact = integral_over_sphere(a, b, c) / (of_surface ? 1 : degree + 3);
      double sum = 0;
      for (const auto& point : points) sum += 8 * point.weight * monomial(point.xi, a, b, c);
      largest = std::max(largest, std::abs(sum / exact - 1));
    }
  return largest;
}

TEST(OctantQuadrature, IsExactUpToItsDegreeAndNoFurther) {
  for (const int q : {1, 2, 3, 4, 5, 8}) {
    const auto of_ball = polynomial::octant_points(q);
    const auto of_sphere = polynomial::octant_surface_points(q);
    ASSERT_EQ(of_ball.size(), static_cast<std::size_t>(q * q * q));
    ASSERT_EQ(of_sphere.size(), static_cast<std::size_t>(q * q));
    for (int degree = 0; degree <= 4 * q - 3; degree += 2) EXPECT_LT(largest_error(of_ball, degree, false), 2e-14);
    for (int degree = 0; degree <= 4 * q - 1; degree += 2) EXPECT_LT(largest_error(of_sphere, degree, true), 2e-14);
    EXPECT_GT(largest_error(of_ball, 4 * q - 2, false), 1e-12);
    EXPECT_GT(largest_error(of_sphere, 4 * q, true), 1e-12);
  }
}

TEST(OctantQuadrature, SurfacePointsHaveAnOrthonormalFrameWithTheOutwardNormal) {
  for (const auto& point : polynomial::octant_surface_points(5)) {
    const Vector3d xi(point.xi.data()), e_theta(point.e_theta.data()), e_phi(point.e_phi.data());
    EXPECT_NEAR(xi.norm(), 1, 1e-15);
    EXPECT_NEAR(e_theta.norm(), 1, 1e-15);
    EXPECT_LT((e_theta.cross(e_phi) - xi).norm(), 1e-15);
    EXPECT_GT(xi.minCoeff(), 0);
  }
}

/// ∫ρφ_aφ_b = δ_ab by the space's own points, on the ball and on an ellipsoid, at every degree.
TEST(PolynomialSpace, MassIsTheIdentityByItsOwnQuadrature) {
  for (int N = 1; N <= 7; ++N)
    for (const Vector3d& semi_axes : {Vector3d(1, 1, 1), Vector3d(1.3, 0.7, 0.9)}) {
      const polynomial::PolynomialSpace space(N, no_planes, semi_axes);
      Eigen::MatrixXd values(space.n_functions(), space.n_points());
      for (int p = 0; p < space.n_points(); ++p) {
        const auto jets = space.functions_at(space.points()[p]);
        for (int a = 0; a < space.n_functions(); ++a) values(a, p) = std::sqrt(space.weights()[p]) * jets[a].value;
      }
      const Eigen::MatrixXd mass = values * values.transpose();
      EXPECT_LT((mass - Eigen::MatrixXd::Identity(mass.rows(), mass.rows())).cwiseAbs().maxCoeff(), 1e-13) << N;
    }
}

TEST(PolynomialSpace, HasAsManyUnknownsAsItsParitiesAdmit) {  // PHYSICS section 10
  const int octant[][2]{{1, 3}, {3, 12}, {5, 30}, {7, 60}, {9, 105}, {11, 168}};
  for (const auto& [N, n] : octant) EXPECT_EQ(polynomial::PolynomialSpace(N, all_planes).n_unknowns(), n);
  for (int N = 1; N <= 5; ++N) {
    const polynomial::PolynomialSpace ball(N, no_planes);
    EXPECT_EQ(ball.n_unknowns(), (N + 1) * (N + 2) * (N + 3) / 2);
    EXPECT_EQ(ball.n_pressures(), N * (N + 1) * (N + 2) / 6);
  }
}

TEST(PolynomialSpace, AffineMotionsComeBack) {
  std::mt19937 generator(1);
  for (const Planes& planes : all_sectors()) {
    const polynomial::PolynomialSpace space(4, planes, {1.3, 0.7, 0.9});
    const Matrix3d A = admitted(planes, random_matrix(generator));
    Vector3d c = random_matrix(generator).col(0);
    for (int i = 0; i < 3; ++i)
      if (planes[i]) c[i] = 0;
    VectorXd x = random_vector(space.n_unknowns(), generator);
    const VectorXd before = x;
    space.set_affine(A, c, x);
    EXPECT_LT((space.affine_part(x) - A).norm(), 1e-15);
    EXPECT_LT((space.mean(x) - c).norm(), 1e-15);
    space.set_affine(space.affine_part(before), space.mean(before), x);
    EXPECT_LT((x - before).norm(), 1e-15) << "the affine part is orthogonal to the rest";

    x.setZero();
    space.set_affine(A, c, x);
    const auto jets = space.functions_at({0.3, -0.2, 0.5});
    EXPECT_LT((space.value(jets, x) - A * Vector3d(0.39, -0.14, 0.45) - c).norm(), 1e-15);
    EXPECT_LT((space.gradient(jets, x) - A).norm(), 1e-14);
    EXPECT_LT(
        (space.moment(x, x) - A * space.inertia().asDiagonal() * A.transpose() - space.volume() * c * c.transpose())
            .norm(),
        1e-14 * space.volume());
  }
}

/// Gradients at the points from the tables, by transforms of parities, beside the sum over functions as it stands.
TEST(PolynomialSpace, TablesAgreeWithTheSumOverFunctions) {
  std::mt19937 generator(2);
  for (const Planes& planes : all_sectors()) {
    const polynomial::PolynomialSpace space(4, planes, {1.3, 0.7, 0.9});
    const VectorXd x = random_vector(space.n_unknowns(), generator),
                   lambda = random_vector(space.n_pressures(), generator);
    std::vector<double> F(space.gradients().size(3)), p(space.pressures().size(1));
    space.gradients().evaluate(space.blocks(), 3, x.data(), F.data());
    space.pressures().evaluate(space.pressure_blocks(), 1, lambda.data(), p.data());
    for (int at = 0; at < space.n_points(); at += 7) {
      const auto jets = space.functions_at(space.points()[at]);
      const Matrix3d expected = space.gradient(jets, x);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(F[static_cast<std::size_t>(3 * i + k) * space.n_points() + at], expected(i, k), 1e-12);
      double pressure = 0;
      for (int b = 0; b < space.n_functions(); ++b)
        if (const int place = space.pressure_place(b); place >= 0) pressure += lambda[place] * jets[b].value;
      EXPECT_NEAR(p[at], pressure, 1e-13);
    }
    // ⟨y, Ex⟩ = ⟨Eᵀy, x⟩
    std::vector<double> y(F.size());
    const VectorXd random = random_vector(static_cast<Eigen::Index>(y.size()), generator);
    std::copy(random.data(), random.data() + random.size(), y.begin());
    VectorXd back = VectorXd::Zero(space.n_unknowns());
    space.gradients().add_transposed(space.blocks(), 3, y.data(), back.data());
    EXPECT_NEAR(back.dot(x), random.dot(Eigen::Map<VectorXd>(F.data(), random.size())), 1e-11 * random.norm());
  }
}

}  // namespace
}  // namespace pseudorigid::testing
