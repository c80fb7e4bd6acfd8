#include "mechanics/core/gauss_iteration.h"
#include "mechanics/core/lanes_trigonometry.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {
namespace {

/// A vector of space in every lane.
template <class T>
struct Vector3 {
  T x[3];
};
template <class T>
[[gnu::always_inline]] inline Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
template <class T>
[[gnu::always_inline]] inline Vector3<T> product(const std::array<double, 9>& M, const Vector3<T>& a) {
  Vector3<T> y;
  for (std::size_t i = 0; i < 3; ++i) y.x[i] = M[i] * a.x[0] + M[i + 3] * a.x[1] + M[i + 6] * a.x[2];
  return y;
}

/// AΩ̇ = AΩ × Ω + mG × R⁻¹g,   q̈ = ½(q̇Ω + qΩ̇),   Ω = 2 q⁻¹q̇; q = (x, y, z, w). In principal axes and without weight
/// (AΩ × Ω)₁ = (A₂ − A₃) Ω₂Ω₃.
template <bool principal_and_free>
struct TopField {
  static constexpr int n = 4;
  const TopOfStages& top;
  std::array<double, 3> ratios = ratios_of(top);  // (A₂ − A₃)/A₁, …

  template <class T>
  [[gnu::always_inline]] T operator()(int, const T* q, const T* v, T* a) const {
    const Vector3<T> axis{{q[0], q[1], q[2]}}, rate{{v[0], v[1], v[2]}}, turned = cross(axis, rate);
    const T square = q[0] * q[0] + q[1] * q[1] + (q[2] * q[2] + q[3] * q[3]), factor = 2.0 / square;
    Vector3<T> Omega;
    for (int i = 0; i < 3; ++i) Omega.x[i] = factor * (q[3] * rate.x[i] - v[3] * axis.x[i] - turned.x[i]);
    const Vector3<T> Omega_rate = rate_of(Omega, axis, q[3], factor), first = cross(rate, Omega),
                     second = cross(axis, Omega_rate);
    for (int i = 0; i < 3; ++i) a[i] = 0.5 * (v[3] * Omega.x[i] + first.x[i] + (q[3] * Omega_rate.x[i] + second.x[i]));
    const auto dot = [](const Vector3<T>& x, const Vector3<T>& y) {
      return x.x[0] * y.x[0] + x.x[1] * y.x[1] + x.x[2] * y.x[2];
    };
    a[3] = -0.5 * (dot(rate, Omega) + dot(axis, Omega_rate));
    return square;
  }

 private:
  template <class T>
  [[gnu::always_inline]] Vector3<T> rate_of(const Vector3<T>& Omega, const Vector3<T>& axis, T w, T factor) const {
    if constexpr (principal_and_free) {
      return {{ratios[0] * (Omega.x[1] * Omega.x[2]), ratios[1] * (Omega.x[2] * Omega.x[0]),
               ratios[2] * (Omega.x[0] * Omega.x[1])}};
    } else {
      Vector3<T> torque = cross(product(top.A, Omega), Omega);
      if (top.has_weight) {  // R⁻¹g = g + (2/|q|²)(a × (a × g) − w a × g)
        const Vector3<T> g{{T(top.gravity[0]), T(top.gravity[1]), T(top.gravity[2])}},
            once = cross(axis, g), twice = cross(axis, once),
            moment{{T(top.moment[0]), T(top.moment[1]), T(top.moment[2])}};
        Vector3<T> g_in_body;
        for (int i = 0; i < 3; ++i) g_in_body.x[i] = g.x[i] + factor * (twice.x[i] - w * once.x[i]);
        const Vector3<T> of_weight = cross(moment, g_in_body);
        for (int i = 0; i < 3; ++i) torque.x[i] = torque.x[i] + of_weight.x[i];
      }
      return product(top.A_inverse, torque);
    }
  }
  static std::array<double, 3> ratios_of(const TopOfStages& top) {
    const double A1 = top.A[0], A2 = top.A[4], A3 = top.A[8];
    return {(A2 - A3) / A1, (A3 - A1) / A2, (A1 - A2) / A3};
  }
};

bool is_diagonal(const std::array<double, 9>& M) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (i != j && M[3 * i + j] != 0) return false;
  return true;
}

/// (5.43) with the explicit multiplier, q = (q₁, q₂), y downwards.
struct PointsField {
  static constexpr int n = 4;
  const PendulumOfStages& p;

  template <class T>
  [[gnu::always_inline]] T operator()(int, const T* q, const T* v, T* a) const {
    const double per_l1 = 1 / (p.l1 * p.l1), per_l2 = 1 / (p.l2 * p.l2), per_m1 = 1 / p.m1, per_m2 = 1 / p.m2;
    const T dx = q[2] - q[0], dy = q[3] - q[1], wx = v[2] - v[0], wy = v[3] - v[1];
    const T n1x = per_l1 * q[0], n1y = per_l1 * q[1], n2x = per_l2 * dx, n2y = per_l2 * dy;
    const T S11 = per_m1 * (n1x * n1x + n1y * n1y), S12 = -per_m1 * (n1x * n2x + n1y * n2y),
            S22 = (per_m1 + per_m2) * (n2x * n2x + n2y * n2y);
    const T r1 = -(per_l1 * (v[0] * v[0] + v[1] * v[1]) + p.g * n1y), r2 = -per_l2 * (wx * wx + wy * wy);
    const T determinant = S11 * S22 - S12 * S12, inverse = 1.0 / determinant;
    const T of_first = inverse * (S22 * r1 - S12 * r2), of_second = inverse * (S11 * r2 - S12 * r1);
    a[0] = per_m1 * (of_first * n1x - of_second * n2x);
    a[1] = p.g + per_m1 * (of_first * n1y - of_second * n2y);
    a[2] = per_m2 * (of_second * n2x);
    a[3] = p.g + per_m2 * (of_second * n2y);
    return determinant;
  }
};

/// (5.44), with the right sign, and (5.45), in the angles q = (θ, φ), each divided by its l:
///   (m₁+m₂) l₁ θ̈ + m₂ l₂ [φ̈ cos δ + φ̇² sin δ] + (m₁+m₂) g sin θ = 0
///   l₂ φ̈ + l₁ [θ̈ cos δ − θ̇² sin δ] + g sin φ = 0,   δ = θ − φ.
struct AnglesField {
  static constexpr int n = 2;
  const PendulumOfStages& p;

  template <class T>
  [[gnu::always_inline]] T operator()(int, const T* q, const T* v, T* a) const {
    const auto theta = mechanics::sine_cosine(q[0]), phi = mechanics::sine_cosine(q[1]);
    const T c = theta.cosine * phi.cosine + theta.sine * phi.sine,
            s = theta.sine * phi.cosine - theta.cosine * phi.sine;
    const double m = p.m1 + p.m2;
    const T r1 = -(p.m2 * p.l2 * (v[1] * v[1] * s) + m * p.g * theta.sine),
            r2 = p.l1 * (v[0] * v[0] * s) - p.g * phi.sine;
    // m − m₂c² = m₁ + m₂s²
    const T inverse = 1.0 / (p.m1 + p.m2 * (s * s));
    a[0] = (1 / p.l1) * (inverse * (r1 - p.m2 * (c * r2)));
    a[1] = (1 / p.l2) * (inverse * (m * r2 - c * r1));
    return T(1.0);
  }
};

void solve_top(const TopOfStages& top, mechanics::GaussStages& stages) {
  if (!top.has_weight && is_diagonal(top.A))
    mechanics::detail::iterate_in_lanes(TopField<true>{top}, stages);
  else
    mechanics::detail::iterate_in_lanes(TopField<false>{top}, stages);
}
void solve_points(const PendulumOfStages& pendulum, mechanics::GaussStages& stages) {
  mechanics::detail::iterate_in_lanes(PointsField{pendulum}, stages);
}
void solve_angles(const PendulumOfStages& pendulum, mechanics::GaussStages& stages) {
  mechanics::detail::iterate_in_lanes(AnglesField{pendulum}, stages);
}

}  // namespace
}  // namespace pseudorigid::systems

extern const pseudorigid::systems::SystemKernels PSEUDORIGID_KERNEL_TABLE{
    .top = pseudorigid::systems::solve_top,
    .pendulum_points = pseudorigid::systems::solve_points,
    .pendulum_angles = pseudorigid::systems::solve_angles};
