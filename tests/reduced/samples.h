#pragma once
/// Samples for the statements of 5.7: matrices, states and reference bodies, the same for the same generator; integrals
/// over the reference ball; derivatives of functions of Q; the invariants.

#include <Eigen/Dense>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "reduced/bodies.h"

namespace pseudorigid::testing {

/// Entries in [−1, 1].
inline Matrix3d random_matrix(std::mt19937& generator) {
  std::uniform_real_distribution<double> entry(-1, 1);
  return Matrix3d::NullaryExpr([&] { return entry(generator); });
}
inline Matrix3d random_rotation(std::mt19937& generator) {
  std::normal_distribution<double> entry;
  const auto number = [&] { return entry(generator); };
  return Eigen::Quaterniond(Eigen::Vector4d::NullaryExpr(number)).normalized().toRotationMatrix();
}
/// Semi-axes in [½, 2].
inline Matrix3d random_deformation(std::mt19937& generator) {
  std::uniform_real_distribution<double> exponent(-1, 1);
  const auto axis = [&] { return std::exp2(exponent(generator)); };
  return random_rotation(generator) * Matrix3d(Vector3d::NullaryExpr(axis).asDiagonal()) * random_rotation(generator);
}
/// det Q = 1, tr(Q⁻¹Q̇) = 0.
inline State<Sl3> random_unimodular_state(std::mt19937& generator) {
  Matrix3d Q = random_deformation(generator), L = 2 * random_matrix(generator);
  Q /= std::cbrt(Q.determinant());
  L -= L.trace() / 3 * Matrix3d::Identity();
  return moving<Sl3>(Q, Q * L);
}

/// A ball whose mass is not uniform: E₀ is not ∝ Id.
inline reduced::ReferenceBody triaxial_inertia() {
  auto reference = reduced::ReferenceBody::unit_ball();
  const Matrix3d turn = rotation_z(0.7) * Eigen::AngleAxisd(0.4, Vector3d::UnitX()).toRotationMatrix();
  reference.E0 = turn * (reference.E0 * diagonal(1.5, 1, 0.7)) * turn.transpose();
  return reference;
}

/// ∫ f dA over the unit sphere: Gauss points in cos θ, equidistant angles; exact for polynomials of degree ≤ 9.
template <class Integrand>
auto integral_over_sphere(const Integrand& f) {
  using Rule = boost::math::quadrature::gauss<double, 6>;
  constexpr int n_angles = 10;
  std::decay_t<decltype(f(Vector3d()))> sum = 0.0 * f(Vector3d(Vector3d::UnitZ()));
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k)
    for (const double z : {Rule::abscissa()[k], -Rule::abscissa()[k]})
      for (int i = 0; i < n_angles; ++i) {
        const double angle = 2 * std::numbers::pi * i / n_angles, s = std::sqrt(1 - z * z);
        const double weight = Rule::weights()[k] * 2 * std::numbers::pi / n_angles;
        sum += weight * f(Vector3d(s * std::cos(angle), s * std::sin(angle), z));
      }
  return sum;
}

/// ∫ f dV over the ball of radius r, exact for polynomials of degree ≤ 9.
template <class Integrand>
auto integral_over_ball(double r, const Integrand& f) {
  using Rule = boost::math::quadrature::gauss<double, 6>;
  std::decay_t<decltype(f(Vector3d()))> sum = 0.0 * f(Vector3d(Vector3d::Zero()));
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k)
    for (const double x : {Rule::abscissa()[k], -Rule::abscissa()[k]}) {
      const double s = 0.5 * r * (1 + x);
      sum += 0.5 * r * Rule::weights()[k] * s * s *
             integral_over_sphere([&](const Vector3d& n) { return f(Vector3d(s * n)); });
    }
  return sum;
}

/// dφ_Q(B) by complex step, to round-off: φ takes a complex matrix.
template <class Function>
double differential(const Function& phi, const Matrix3d& Q, const Matrix3d& B) {
  constexpr double step = 1e-100;
  return phi(Eigen::Matrix3cd(Q.cast<std::complex<double>>() + std::complex<double>(0, step) * B)).imag() / step;
}

/// ∂φ/∂Q = [dφ_Q(B_ij)] (5.7.8 II)
template <class Function>
Matrix3d derivative(const Function& phi, const Matrix3d& Q) {
  Matrix3d D;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) D(i, j) = differential(phi, Q, Vector3d::Unit(i) * Vector3d::Unit(j).transpose());
  return D;
}

/// I, II, III of a symmetric matrix C, complex or not.
template <class Matrix>
auto invariants(const Matrix& C) {
  using T = typename Matrix::Scalar;
  const T trace = C.trace();
  return std::array<T, 3>{trace, 0.5 * (trace * trace - (C * C).trace()), C.determinant()};
}

/// V(Q) per m̄ of the program's law, Vol W(Q)/m̄, of a complex matrix.
template <class Body>
auto potential_per_m_bar(const Body& body) {
  const double factor = reduced::ReferenceBody::unit_ball().volume / body.m_bar();
  return [law = body.energy_density(), factor](const Eigen::Matrix3cd& Q) {
    materials::Tensor<std::complex<double>> F;
    for (int k = 0; k < 9; ++k) F(k / 3, k % 3) = Q(k / 3, k % 3);
    return factor * law.energy(F);
  };
}

}  // namespace pseudorigid::testing
