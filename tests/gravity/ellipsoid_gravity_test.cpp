/// Self-gravity against stored values of 50 digits (make_ellipsoid_gravity_reference.cpp) on 1000 triples of semi-axes:
/// flat bodies, needles, nearly and exactly coinciding axes, sizes whose squares almost overflow; and its structure.

#include "gravity/ellipsoid_gravity.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "reduced/samples.h"

namespace pseudorigid::testing {
namespace {

using gravity::EllipsoidGravity;
using Wide = Eigen::Matrix<long double, 3, 1>;  // its range holds d_i ~ a⁻³ of every size
constexpr double epsilon = std::numeric_limits<double>::epsilon();
const EllipsoidGravity ellipsoid{3};  // k/3 = 1

struct Reference {
  Vector3d a;
  Wide d, t;
  Vector3d force() const { return d.cwiseProduct(a.cast<long double>()).cast<double>(); }  ///< ∂V/∂F of F = diag(a)
  double condition() const { return a.maxCoeff() / a.minCoeff(); }
};

const std::vector<Reference>& references() {
  static const auto list = [] {
    std::vector<Reference> rows;
    std::ifstream file(ELLIPSOID_GRAVITY_REFERENCE);
    std::string line, cell;
    for (std::getline(file, line); std::getline(file, line);) {
      std::istringstream cells(line);
      std::array<long double, 9> value{};
      for (auto& v : value) v = std::getline(cells, cell, ',') ? std::strtold(cell.c_str(), nullptr) : NAN;
      const auto triple = [&](int from) { return Wide(value[from], value[from + 1], value[from + 2]); };
      rows.push_back({triple(0).cast<double>(), triple(3), triple(6)});
    }
    return rows;
  }();
  return list;
}

Matrix3d rotated(const Matrix3d& U, const Vector3d& values, const Matrix3d& V) {
  return U * values.asDiagonal() * V.transpose();
}
/// Two rotations that are none of the coordinate axes'
std::pair<Matrix3d, Matrix3d> rotations() {
  std::mt19937 generator(1);
  const Matrix3d U = random_rotation(generator), V = random_rotation(generator);
  return {U, V};
}

/// A few shapes, rotated: sphere, spheroids, triaxial, nearly coinciding axes
std::vector<Matrix3d> rotated_shapes() {
  const auto [U, V] = rotations();
  std::vector<Matrix3d> list;
  for (const Vector3d& a : {Vector3d(1, 1, 1), Vector3d(1, 1, 0.5), Vector3d(2, 1, 1), Vector3d(1.5, 1.1, 0.6),
                            Vector3d(1, 1 + 1e-9, 0.7), Vector3d(1, 1 + 1e-5, 1 - 1e-5)})
    list.push_back(rotated(U, a, V));
  return list;
}

TEST(EllipsoidGravity, HasAThousandReferences) { EXPECT_EQ(references().size(), 1000u); }

// 1e-14 is what is promised; about 1e-15 is reached.
TEST(EllipsoidGravity, ForceOfTheAxesHas14Digits) {
  double worst = 0;
  for (const auto& reference : references()) {
    const Matrix3d force = ellipsoid.gradient(reference.a.asDiagonal());
    ASSERT_TRUE(force.isDiagonal(0));
    worst = std::max(worst, (force.diagonal().cwiseQuotient(reference.force()).array() - 1).abs().maxCoeff());
  }
  RecordProperty("worst", std::to_string(worst * 1e15) + "e-15");
  EXPECT_LE(worst, 1e-14);
}

TEST(EllipsoidGravity, EnergyHas14Digits) {
  for (const auto& reference : references()) {
    const Wide a = reference.a.cast<long double>();
    const double energy = -double(a.cwiseProduct(a).dot(reference.d));  // −k R_F = −Σ x_i d_i
    EXPECT_NEAR(ellipsoid.energy(reference.a.asDiagonal()) / energy, 1, 1e-14);
  }
}

// Rounding the entries of F alone moves its smallest axis by cond(F)·ε.
TEST(EllipsoidGravity, ForceOfARotatedBodyIsRightToItsConditionNumber) {
  std::mt19937 generator(7);
  double worst = 0;
  for (const auto& reference : references())
    for (int i = 0; i < 100; ++i) {  // many: some make products of rows exactly zero
      const Matrix3d U = random_rotation(generator), V = random_rotation(generator);
      const Matrix3d expected = rotated(U, reference.force(), V);
      const Matrix3d error = ellipsoid.gradient(rotated(U, reference.a, V)) - expected;
      const double size = expected.cwiseAbs().maxCoeff();  // squares of 1e-300 would vanish in a norm
      const double units = (error / size).norm() / (epsilon * reference.condition());
      ASSERT_TRUE(std::isfinite(units)) << reference.a.transpose();
      worst = std::max(worst, units);
    }
  RecordProperty("worst", std::to_string(worst) + " cond eps");
  EXPECT_LE(worst, 50);  // F is rounded nine times, the rotations are orthogonal to a few ε
}

// α₁ + α₂ + α₃ = 2/(a₁a₂a₃) with α_i = ⅔ d_i
TEST(EllipsoidGravity, CoefficientsHaveTheirSum) {
  for (const auto& reference : references()) {
    const Vector3d a = reference.a / reference.a.maxCoeff();
    EXPECT_NEAR(2.0 / 3 * gravity::ellipsoid_integrals(a).d.sum() * a.prod() / 2, 1, 1e-14);
  }
}

/// D(∂V/∂F)[e_l e_mᵀ] at F = diag(a), from the stored integrals, in units of a_max⁻³
Matrix3d second_derivative_of_axes(const Reference& reference, int l, int m) {
  const long double size = reference.a.maxCoeff();
  const Wide a = reference.a.cast<long double>() / size, d = reference.d * (size * size * size),
             t = reference.t * (size * size * size * size * size), x = a.cwiseProduct(a);
  Wide own;  // x_i t_ii
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    own[i] = d[i] - (x[j] * t[k] + x[k] * t[j]) / 3;
  }
  Eigen::Matrix<long double, 3, 3> D = Eigen::Matrix<long double, 3, 3>::Zero();
  if (l == m) {
    for (int i = 0; i < 3; ++i) D(i, i) = i == l ? d[i] - 3 * own[i] : -t[3 - i - l] * a[i] * a[l];
  } else {
    const int k = 3 - l - m;
    D(l, m) = d[l] - t[k] * x[m];
    D(m, l) = -t[k] * a[l] * a[m];
  }
  return D.cast<double>();
}

// The entry (l, m) is a difference of terms of the size of d_l; the others are products.
TEST(EllipsoidGravity, SecondDerivativeOfTheAxesHas14Digits) {
  for (const auto& reference : references()) {
    const double size = reference.a.maxCoeff();
    const Wide d = reference.d * (static_cast<long double>(size) * size * size);
    for (int l = 0; l < 3; ++l)
      for (int m = 0; m < 3; ++m) {
        Matrix3d H = Matrix3d::Zero();
        H(l, m) = size;
        const Matrix3d D = ellipsoid.second_derivative(reference.a.asDiagonal(), H) * size * size;
        const Matrix3d expected = second_derivative_of_axes(reference, l, m);
        Matrix3d terms = expected.cwiseAbs();
        terms(l, m) += double(d[l]);
        EXPECT_LE(((D - expected).cwiseAbs() - 1e-14 * terms).maxCoeff(), 0) << reference.a.transpose();
      }
  }
}

TEST(EllipsoidGravity, GradientIsTheDerivativeOfTheEnergy) {
  std::mt19937 generator(2);
  for (const Matrix3d& F : rotated_shapes()) {
    const Matrix3d H = random_matrix(generator);
    const auto slope = [&](double h) { return (ellipsoid.energy(F + h * H) - ellipsoid.energy(F - h * H)) / (2 * h); };
    const double h = 1e-3;  // Richardson: h⁴ and ε/h are both 1e-12
    EXPECT_NEAR((4 * slope(h) - slope(2 * h)) / 3, ellipsoid.gradient(F).cwiseProduct(H).sum(), 1e-10);
  }
}

TEST(EllipsoidGravity, SecondDerivativeIsTheDerivativeOfTheGradient) {
  std::mt19937 generator(3);
  for (const Matrix3d& F : rotated_shapes()) {
    const Matrix3d H = random_matrix(generator);
    const auto slope = [&](double h) -> Matrix3d {
      return (ellipsoid.gradient(F + h * H) - ellipsoid.gradient(F - h * H)) / (2 * h);
    };
    const double h = 1e-3;  // as above
    const Matrix3d D = ellipsoid.second_derivative(F, H);
    EXPECT_LE(((4 * slope(h) - slope(2 * h)) / 3 - D).norm(), 1e-10 * D.norm());
  }
}

TEST(EllipsoidGravity, SecondDerivativeIsSymmetric) {
  std::mt19937 generator(4);
  for (const Matrix3d& F : rotated_shapes()) {
    const Matrix3d G = random_matrix(generator), H = random_matrix(generator);
    EXPECT_NEAR(ellipsoid.second_derivative(F, G).cwiseProduct(H).sum(),
                ellipsoid.second_derivative(F, H).cwiseProduct(G).sum(), 1e-13);
  }
}

// V is homogeneous of degree −1; powers of two are exact, so the promise is bit for bit.
TEST(EllipsoidGravity, IsHomogeneousBitForBit) {
  std::mt19937 generator(5);
  for (const Matrix3d& F : rotated_shapes())
    for (const double s : {0x1p+500, 0x1p-500, 0x1p+21, 0x1p+3}) {
      const Matrix3d H = random_matrix(generator);
      EXPECT_EQ(ellipsoid.energy(s * F) * s, ellipsoid.energy(F));
      EXPECT_EQ(ellipsoid.gradient(s * F) * s * s, ellipsoid.gradient(F));
      EXPECT_EQ(ellipsoid.second_derivative(s * F, s * H) * s * s, ellipsoid.second_derivative(F, H));
    }
}

// J is conserved if (∂V/∂F)Fᵀ is symmetric, Z if Fᵀ ∂V/∂F is; forming these products costs a round-off of |∂V/∂F||F|.
TEST(EllipsoidGravity, ExertsNoTorqueAndNoCirculation) {
  std::mt19937 generator(6);
  double worst = 0;
  for (const auto& reference : references()) {
    const Vector3d a = reference.a / reference.a.maxCoeff();
    const Matrix3d F = rotated(random_rotation(generator), a, random_rotation(generator));
    const Matrix3d force = ellipsoid.gradient(F), torque = force * F.transpose(), circulation = F.transpose() * force;
    const double skew = std::max((torque - torque.transpose()).norm(), (circulation - circulation.transpose()).norm());
    worst = std::max(worst, skew / (force.norm() * F.norm()));
  }
  RecordProperty("worst", std::to_string(worst / epsilon) + " eps");
  EXPECT_LE(worst, 10 * epsilon);
}

TEST(EllipsoidGravity, InputThatIsNotFiniteOrHasNoVolumeComesOutAsNotFinite) {
  for (const double bad : {double(NAN), double(INFINITY)})
    for (int i = 0; i < 9; ++i) {
      Matrix3d F = rotated_shapes()[3];
      F(i) = bad;
      EXPECT_FALSE(std::isfinite(ellipsoid.energy(F)));
      EXPECT_FALSE(ellipsoid.gradient(F).allFinite());
      EXPECT_FALSE(ellipsoid.second_derivative(F, Matrix3d::Identity()).allFinite());
    }
  EXPECT_FALSE(ellipsoid.gradient(Matrix3d::Zero()).allFinite());
  EXPECT_FALSE(ellipsoid.gradient(Vector3d(1, 0, 0).asDiagonal()).allFinite());
}

}  // namespace
}  // namespace pseudorigid::testing
