#pragma once
/// What holds of the energy, the stress and the tangent of every isotropic law, checked at random deformations.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <random>

#include "materials/eigen_tensor.h"
#include "mechanics/core/lanes.h"

namespace pseudorigid::testing {

class RandomDeformations {
 public:
  using Matrix3d = Eigen::Matrix3d;

  Matrix3d matrix(double size) {
    std::uniform_real_distribution<double> uniform(-size, size);
    return Matrix3d::NullaryExpr([&] { return uniform(generator_); });
  }
  Matrix3d rotation() {
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond{normal(generator_), normal(generator_), normal(generator_), normal(generator_)}
        .normalized()
        .toRotationMatrix();
  }
  /// det F > 0, principal stretches between 1/3 and 3.
  Matrix3d deformation() {
    std::uniform_real_distribution<double> uniform(-std::log(3.0), std::log(3.0));
    const Eigen::Vector3d stretches(std::exp(uniform(generator_)), std::exp(uniform(generator_)),
                                    std::exp(uniform(generator_)));
    return rotation() * stretches.asDiagonal() * rotation();
  }

 private:
  std::mt19937 generator_{579};
};

namespace detail {
/// F + iεK: Im f/ε is the derivative of f along K, without cancellation.
inline constexpr double increment = 1e-100;
inline materials::Tensor<std::complex<double>> complex_step(const Eigen::Matrix3d& F, const Eigen::Matrix3d& K) {
  materials::Tensor<std::complex<double>> z;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) z(i, j) = {F(i, j), increment * K(i, j)};
  return z;
}
inline Eigen::Matrix3d derivative(const materials::Tensor<std::complex<double>>& f) {
  return Eigen::Matrix3d::NullaryExpr(
      [&](Eigen::Index i, Eigen::Index j) { return f(static_cast<int>(i), static_cast<int>(j)).imag() / increment; });
}
}  // namespace detail

template <class Law>
void expect_stress_is_the_derivative_of_the_energy(const Law& law) {
  RandomDeformations random;
  for (int n = 0; n < 100; ++n) {
    const Eigen::Matrix3d F = random.deformation(), P = materials::to_matrix(law.stress(materials::to_tensor(F)));
    for (int k = 0; k < 9; ++k) {
      Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
      K(k) = 1;
      EXPECT_NEAR(P(k), law.energy(detail::complex_step(F, K)).imag() / detail::increment, 1e-12 * P.norm());
    }
  }
}

/// And symmetric, as a second derivative is.
template <class Law>
void expect_tangent_is_the_derivative_of_the_stress(const Law& law) {
  RandomDeformations random;
  for (int n = 0; n < 100; ++n) {
    const Eigen::Matrix3d F = random.deformation(), H = random.matrix(1), K = random.matrix(1);
    const auto f = materials::to_tensor(F), h = materials::to_tensor(H), k = materials::to_tensor(K);
    const Eigen::Matrix3d tangent = materials::to_matrix(law.tangent(f, k));
    EXPECT_LE((tangent - detail::derivative(law.stress(detail::complex_step(F, K)))).norm(), 1e-12 * tangent.norm());
    EXPECT_NEAR(materials::dot(law.tangent(f, h), k), materials::dot(h, law.tangent(f, k)),
                1e-13 * tangent.norm() * H.norm());
  }
}

/// W(RF) = W(F) = W(FR). So PFᵀ and FᵀP are symmetric: d/dt of the spatial angular momentum is the skew part of −PFᵀ,
/// that of the circulation the skew part of FᵀP.
template <class Law>
void expect_objective_and_isotropic(const Law& law) {
  RandomDeformations random;
  for (int n = 0; n < 50; ++n) {
    const Eigen::Matrix3d F = random.deformation(), R = random.rotation();
    const double W = law.energy(materials::to_tensor(F));
    EXPECT_NEAR(law.energy(materials::to_tensor(R * F)), W, 2e-14 * (1 + std::abs(W)));
    EXPECT_NEAR(law.energy(materials::to_tensor(F * R)), W, 2e-14 * (1 + std::abs(W)));
    const Eigen::Matrix3d P = materials::to_matrix(law.stress(materials::to_tensor(F)));
    const Eigen::Matrix3d torque = P * F.transpose(), vorticity = F.transpose() * P;
    EXPECT_LE((torque - torque.transpose()).norm(), 1e-14 * P.norm() * F.norm());
    EXPECT_LE((vorticity - vorticity.transpose()).norm(), 1e-14 * P.norm() * F.norm());
  }
}

/// DP(Id)[H] = 2μ sym H + λ tr H Id, and neither energy nor stress at Id: exactly, for the round-off of a stress-free
/// body is no motion.
template <class Law>
void expect_free_of_stress_at_rest_with_moduli(const Law& law, double mu, double lambda) {
  RandomDeformations random;
  const auto Id = materials::to_tensor(Eigen::Matrix3d::Identity());
  EXPECT_EQ(law.energy(Id), 0);
  EXPECT_EQ(materials::to_matrix(law.stress(Id)), Eigen::Matrix3d::Zero());
  for (int n = 0; n < 20; ++n) {
    const Eigen::Matrix3d H = random.matrix(1);
    const Eigen::Matrix3d hooke = mu * (H + H.transpose()) + lambda * H.trace() * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d tangent = materials::to_matrix(law.tangent(Id, materials::to_tensor(H)));
    EXPECT_LE((tangent - hooke).norm(), 1e-14 * hooke.norm());
  }
}

/// The finite elements compute with SIMD vectors: each lane is the result of a number.
template <class Law>
void expect_lanes_are_numbers(const Law& law) {
  constexpr int n_lanes = mechanics::native_lanes;
  using L = mechanics::Lanes<n_lanes>;
  RandomDeformations random;
  materials::Tensor<double> F[n_lanes], H[n_lanes];
  materials::Tensor<L> wide_F, wide_H;
  for (int lane = 0; lane < n_lanes; ++lane) {
    F[lane] = materials::to_tensor(random.deformation());
    H[lane] = materials::to_tensor(random.matrix(1));
    for (int k = 0; k < 9; ++k) {
      wide_F(k / 3, k % 3).set(lane, F[lane](k / 3, k % 3));
      wide_H(k / 3, k % 3).set(lane, H[lane](k / 3, k % 3));
    }
  }
  const L W = law.energy(wide_F);
  const materials::Tensor<L> P = law.stress(wide_F), A = law.tangent(wide_F, wide_H);
  for (int lane = 0; lane < n_lanes; ++lane) {
    const double own_W = law.energy(F[lane]);
    EXPECT_NEAR(W[lane], own_W, 1e-13 * (1 + own_W));
    const auto own_P = law.stress(F[lane]), own_A = law.tangent(F[lane], H[lane]);
    for (int k = 0; k < 9; ++k) {
      const int i = k / 3, j = k % 3;
      EXPECT_NEAR(P(i, j)[lane], own_P(i, j), 1e-13 * std::sqrt(materials::dot(own_P, own_P)));
      EXPECT_NEAR(A(i, j)[lane], own_A(i, j), 1e-13 * std::sqrt(materials::dot(own_A, own_A)));
    }
  }
}

}  // namespace pseudorigid::testing
