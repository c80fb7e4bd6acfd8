#pragma once
/// A chain of n heavy points on massless rods in a vertical plane, in the angles q from the downward vertical, y down:
/// a chart of any dimension of which all is known in closed form,
///
///   x_k = Σ_{i≤k} l_i (sin q_i, cos q_i),   M_i = Σ_{k≥i} m_k,
///   g_ij = M_max(i,j) l_i l_j cos(q_i − q_j),   U = −g Σ M_i l_i cos q_i,
///   Γ_l,ij = δ_ij M_max(l,i) l_l l_i sin(q_l − q_i).

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "mechanics/core/automatic_differentiation.h"

namespace pseudorigid::testing {

template <int n>
struct PendulumChain {
  static constexpr int dimension = n;
  double gravity = 1.1;

  static double mass(int i) { return 0.5 + 0.3 * ((i + 1) % 3); }
  static double length(int i) { return 0.8 + 0.25 * (i % 2); }
  /// M_i
  static double hanging_mass(int i) {
    double sum = 0;
    for (int k = i; k < n; ++k) sum += mass(k);
    return sum;
  }

  template <class T>
  Eigen::Matrix<T, n, n> metric(const mechanics::Coordinates<T, n>& q) const {
    using std::cos;
    Eigen::Matrix<T, n, n> g;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) g(i, j) = T(hanging_mass(std::max(i, j)) * length(i) * length(j) * cos(q[i] - q[j]));
    return g;
  }
  template <class T>
  T potential(const mechanics::Coordinates<T, n>& q) const {
    using std::cos;
    T U = T(0.0) * q[0];
    for (int i = 0; i < n; ++i) U -= gravity * hanging_mass(i) * length(i) * cos(q[i]);
    return U;
  }
  /// (√m_k x_k): the Euclidean metric of these is that of the kinetic energy.
  template <class T>
  Eigen::Matrix<T, 2 * n, 1> weighted_embedding(const mechanics::Coordinates<T, n>& q) const {
    using std::cos, std::sin;
    Eigen::Matrix<T, 2 * n, 1> x;
    T across = T(0.0) * q[0], down = across;
    for (int k = 0; k < n; ++k) {
      across += length(k) * sin(q[k]);
      down += length(k) * cos(q[k]);
      x[2 * k] = std::sqrt(mass(k)) * across;
      x[2 * k + 1] = std::sqrt(mass(k)) * down;
    }
    return x;
  }
  /// Γ_l,ij
  static double first_kind(const Eigen::Matrix<double, n, 1>& q, int l, int i, int j) {
    return i == j ? hanging_mass(std::max(l, i)) * length(l) * length(i) * std::sin(q[l] - q[i]) : 0;
  }
};

}  // namespace pseudorigid::testing
