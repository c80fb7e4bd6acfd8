#include "mechanics/core/chart_field.h"
#include "mechanics/core/gauss_iteration.h"
#include "mechanics/core/lanes_as_scalar.h"
#include "mechanics/core/lanes_trigonometry.h"
#include "systems/double_pendulum_chart.h"
#include "systems/fixed_axis.h"
#include "systems/lagrange_top.h"
#include "systems/mass_points.h"
#include "systems/moving_frame.h"
#include "systems/systems_in_lanes.h"
#include "systems/torus.h"

namespace pseudorigid::systems {
namespace {

// This file is compiled once for each instruction set. The solvers in this file are the entries of the table
// SystemKernels (systems_in_lanes.h). The fields below, except FieldOfPoints, are functions (first lane, q, v, a) over
// a scalar type T, which is a vector of SIMD lanes. These functions set the accelerations a, and return a number that
// is positive if the accelerations are defined.

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

/// Euler's equation on quaternions q = (x, y, z, w) (euler_top.h), with the inertia operator A, the angular velocity Ω
/// in the body and the torque N:
///   AΩ̇ = AΩ × Ω + N,   q̈ = ½(q̇Ω + qΩ̇),   Ω = 2 q⁻¹q̇.
/// If `principal_and_free` is true, A = diag(A₁, A₂, A₃) and N is zero. Then (AΩ × Ω)₁ = (A₂ − A₃) Ω₂Ω₃, and
/// cyclically.
template <bool principal_and_free>
struct TopField {
  static constexpr int n = 4;
  const TopOfStages& top;
  Eigen::Vector3d ratios = ratios_of(top.A);  // numbers (A₂ − A₃)/A₁, and cyclically

  template <class T>
  [[gnu::always_inline]] T operator()(int, const T* q, const T* v, T* a) const {
    const Vector3<T> axis(q[0], q[1], q[2]), rate(v[0], v[1], v[2]);
    // The terms of |q|² are added one after the other. As a sum of two halves, |q|² would have rounding errors that
    // rotate the angular momentum by 4e-18 in a unit of time.
    const T square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], factor = 2.0 / square;
    const Vector3<T> Omega = factor * (q[3] * rate - v[3] * axis - axis.cross(rate));
    T reserve = square;
    const Vector3<T> Omega_rate = rate_of(Omega, Turn<T>{axis, q[3], factor}, reserve);
    const Vector3<T> vector =
        T(0.5) * (v[3] * Omega + rate.cross(Omega) + (q[3] * Omega_rate + axis.cross(Omega_rate)));
    for (int i = 0; i < 3; ++i) a[i] = vector[i];
    a[3] = -0.5 * (rate.dot(Omega) + axis.dot(Omega_rate));
    return reserve;
  }

 private:
  /// The rotation R of the quaternion q with the vector part a and the scalar part w: R x = x + (2/|q|²)(a × (a × x) +
  /// w a × x). The inverse rotation has −w. `axis` is a, and `factor` is 2/|q|².
  template <class T>
  struct Turn {
    Vector3<T> axis;
    T w, factor;
    [[gnu::always_inline]] Vector3<T> to_space(const Vector3<T>& x) const { return turned(x, w); }
    [[gnu::always_inline]] Vector3<T> to_body(const Vector3<T>& x) const { return turned(x, -w); }

   private:
    [[gnu::always_inline]] Vector3<T> turned(const Vector3<T>& x, T along) const {
      const Vector3<T> once = axis.cross(x), twice = axis.cross(once);
      return x + factor * (twice + along * once);
    }
  };

  /// Returns Ω̇. Afterwards, `reserve` is positive only if it was positive before and if all forces are defined.
  template <class T>
  [[gnu::always_inline]] Vector3<T> rate_of(const Vector3<T>& Omega, const Turn<T>& turn, T& reserve) const {
    if constexpr (principal_and_free) {
      return {ratios[0] * (Omega[1] * Omega[2]), ratios[1] * (Omega[2] * Omega[0]), ratios[2] * (Omega[0] * Omega[1])};
    } else {
      const Vector3<T> momentum = top.A.cast<T>() * Omega;
      Vector3<T> torque = momentum.cross(Omega);
      if (top.loads) reserve = min(reserve, add_torque(*top.loads, turn, torque));
      return top.A_inverse.cast<T>() * torque;
    }
  }
  /// Adds the torque mG × R⁻¹g + Σ ξ × R⁻¹f in the axes of the body to N. The weight mg acts at the centre of mass G,
  /// and a spring acts on the body point ξ with the force f. Returns 1 if the forces of all springs are defined
  /// (central_force.h), otherwise NaN.
  template <class T>
  [[gnu::always_inline]] static T add_torque(const BodyLoads& loads, const Turn<T>& turn, Vector3<T>& N) {
    const Vector3<T> moment = (loads.mass * loads.center).cast<T>();
    N += moment.cross(turn.to_body(loads.gravity.cast<T>()));
    T reserve(1.0);
    for (const BodySpring& spring : loads.springs) {
      const Vector3<T> xi = spring.xi.cast<T>(), d = turn.to_space(xi) - spring.anchor.cast<T>();
      Vector3<T> f = Vector3<T>::Constant(T(0.0));
      reserve = reserve * add_central_force(spring.law, d, f);
      N += xi.cross(turn.to_body(f));
    }
    return reserve;
  }
  static Eigen::Vector3d ratios_of(const Eigen::Matrix3d& A) {
    const double A1 = A(0, 0), A2 = A(1, 1), A3 = A(2, 2);
    return {(A2 - A3) / A1, (A3 - A1) / A2, (A1 - A2) / A3};
  }
};

/// Returns true if the torque N is zero for every rotation.
bool is_free(const TopOfStages& top) {
  return !top.loads || (top.loads->gravity.isZero(0) && top.loads->springs.empty());
}

/// The double pendulum in multiplier form (double_pendulum.h): equation (5.43) for q = (q₁, q₂), with the multipliers
/// as explicit functions of q and q̇.
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

/// The double pendulum in Lagrange form (double_pendulum_chart.h) with the angles q = (θ, φ), the masses m_k, the
/// lengths l_k and the acceleration of gravity g. The corrected equation (5.44) is divided by l₁, and (5.45) by m₂l₂:
///   (m₁+m₂) l₁ θ̈ + m₂ l₂ [φ̈ cos δ + φ̇² sin δ] + (m₁+m₂) g sin θ = 0
///   l₂ φ̈ + l₁ [θ̈ cos δ − θ̇² sin δ] + g sin φ = 0,   δ = θ − φ.
struct AnglesField {
  static constexpr int n = 2;
  const DoublePendulumChart& p;

  template <class T>
  [[gnu::always_inline]] T operator()(int, const T* q, const T* v, T* a) const {
    const auto theta = mechanics::sine_cosine(q[0]), phi = mechanics::sine_cosine(q[1]);
    const T c = theta.cosine * phi.cosine + theta.sine * phi.sine,
            s = theta.sine * phi.cosine - theta.cosine * phi.sine;
    const double m = p.m1 + p.m2;
    const T r1 = -(p.m2 * p.l2 * (v[1] * v[1] * s) + m * p.gravity * theta.sine),
            r2 = p.l1 * (v[0] * v[0] * s) - p.gravity * phi.sine;
    // With c = cos δ, s = sin δ and m = m₁ + m₂, the determinant of the equations for l₁θ̈ and l₂φ̈ is m − m₂c² = m₁ +
    // m₂s².
    const T inverse = 1.0 / (p.m1 + p.m2 * (s * s));
    a[0] = (1 / p.l1) * (inverse * (r1 - p.m2 * (c * r2)));
    a[1] = (1 / p.l2) * (inverse * (m * r2 - c * r1));
    return T(1.0);
  }
};

/// The field of a chart, g_lk q̈ᵏ = F_l − Γ_l,ij q̇ⁱq̇ʲ (mechanics/core/chart_field.h). Here g is the metric, Γ_l,ij
/// are its Christoffel symbols of the first kind, and F is the force.
template <class Chart>
struct FieldOfChart {
  static constexpr int n = Chart::dimension;
  const Chart& chart;

  template <class T>
  [[gnu::always_inline]] T operator()(int, const T* q, const T* v, T* a) const {
    using Vector = mechanics::Coordinates<T, n>;
    const Vector at = Eigen::Map<const Vector>(q), rate = Eigen::Map<const Vector>(v);
    Eigen::Matrix<T, n, n> g;
    const Vector rhs = mechanics::covariant_force<T>(chart, at, rate, g);
    Vector solution;
    const T pivot = solve_positive(g, rhs, solution);
    for (int k = 0; k < n; ++k) a[k] = solution[k];
    if constexpr (requires { chart.reserve(at); })
      return min(pivot, chart.reserve(at));
    else
      return pivot;
  }

 private:
  /// Solves g x = b by the factorisation g = LDLᵀ and overwrites g. Returns a positive number if all pivots exceed ε tr
  /// g with the machine precision ε. Otherwise x is not reliable.
  template <class T>
  [[gnu::always_inline]] static T solve_positive(Eigen::Matrix<T, n, n>& g, const mechanics::Coordinates<T, n>& b,
                                                 mechanics::Coordinates<T, n>& x) {
    constexpr double epsilon = 0x1p-52;
    const T round_off = epsilon * g.trace();
    T least = g(0, 0) - round_off;
    T inverse[n];
    for (int j = 0; j < n; ++j) {
      inverse[j] = 1.0 / g(j, j);
      for (int i = j + 1; i < n; ++i)
        for (int k = j + 1; k <= i; ++k) g(i, k) -= inverse[j] * g(i, j) * g(k, j);
      for (int i = j + 1; i < n; ++i) g(i, j) = inverse[j] * g(i, j);
      if (j + 1 < n) least = min(least, g(j + 1, j + 1) - round_off);
    }
    for (int i = 0; i < n; ++i) {
      x[i] = b[i];
      for (int j = 0; j < i; ++j) x[i] -= g(i, j) * x[j];
    }
    for (int i = n - 1; i >= 0; --i) {
      x[i] *= inverse[i];
      for (int j = i + 1; j < n; ++j) x[i] -= g(j, i) * x[j];
    }
    return least;
  }
};

/// The field of a point in a moving frame or in space (moving_frame.h), for given poses of the frame at the stages.
struct FrameField {
  static constexpr int n = 3;
  const FrameOfStages& frame;

  template <class T>
  [[gnu::always_inline]] T operator()(int first_lane, const T* q, const T* v, T* a) const {
    FramePoseOver<T> pose;
    std::size_t k = 0;
    pose.visit([&](T& x) { x = mechanics::detail::load_lanes(frame.pose[k++].data() + first_lane); });
    const Vector3<T> at = Eigen::Map<const Vector3<T>>(q), rate = Eigen::Map<const Vector3<T>>(v);
    Vector3<T> sum;
    T reserve;
    if (frame.moving) {
      RelativeTermsOver<T> terms;
      reserve = MovingFrame::terms_over(frame.forces, pose, at, rate, terms);
      sum = terms.sum();
    } else {
      reserve = InertialFrame::acceleration_over(frame.forces, pose, at, sum);
    }
    for (int i = 0; i < 3; ++i) a[i] = sum[i];
    return reserve;
  }
};

/// The field of any number of mass points (mass_points.h). Because the number is known only at run time, the field is
/// called through the interface GaussField.
struct FieldOfPoints final : mechanics::GaussField {
  const MassPoints& points;
  explicit FieldOfPoints(const MassPoints& p) : points(p) {}

  bool evaluate(const mechanics::GaussStages& s, const mechanics::OfStages* q, const mechanics::OfStages* v,
                mechanics::OfStages* a) const override {
    using T = mechanics::detail::StageLanes;
    T reserve(1.0);
    for (int k = 0; k < s.n; ++k) a[k].fill(0);
    for (int lane = 0; lane < mechanics::gauss::n_stages; lane += mechanics::native_lanes) {
      const auto load = [lane](const mechanics::OfStages* x, Eigen::Index i) -> Vector3<T> {
        const auto entry = [&](int c) { return mechanics::detail::load_lanes(x[3 * i + c].data() + lane); };
        return {entry(0), entry(1), entry(2)};
      };
      const auto add = [&](Eigen::Index i, const Vector3<T>& f) {
        for (int c = 0; c < 3; ++c) {
          double* const sum = a[3 * i + c].data() + lane;
          mechanics::detail::store_lanes(mechanics::detail::load_lanes(sum) + f[c], sum);
        }
      };
      reserve = reserve * points.act<T>([&](Eigen::Index i) { return load(q, i); },
                                        [&](Eigen::Index i) { return load(v, i); }, add);
    }
    for (int k = 0; k < s.n; ++k)
      for (double& x : a[k]) x *= 1 / points.parameters().masses[k / 3];
    return reserve.least(mechanics::native_lanes) > 0;
  }
};

// The solvers return true, except the template for charts. This template returns false if a coordinate is too large or
// NaN. DoublePendulumChart has its own overload, which returns true.
bool solve(const TopOfStages& top, mechanics::GaussStages& stages) {
  if (is_free(top) && top.A.isDiagonal(0))
    mechanics::detail::iterate_in_lanes(TopField<true>{top}, stages);
  else
    mechanics::detail::iterate_in_lanes(TopField<false>{top}, stages);
  return true;
}
bool solve(const SphericalPendulumOfStages& pendulum, mechanics::GaussStages& stages) {
  mechanics::detail::iterate_in_lanes(pendulum, stages);
  return true;
}
bool solve(const FrameOfStages& frame, mechanics::GaussStages& stages) {
  mechanics::detail::iterate_in_lanes(FrameField{frame}, stages);
  return true;
}
bool solve(const MassPoints& points, mechanics::GaussStages& stages) {
  mechanics::detail::iterate_by_calls(FieldOfPoints(points), stages);
  return true;
}
bool solve(const PendulumOfStages& pendulum, mechanics::GaussStages& stages) {
  mechanics::detail::iterate_in_lanes(PointsField{pendulum}, stages);
  return true;
}
bool solve(const DoublePendulumChart& pendulum, mechanics::GaussStages& stages) {
  mechanics::detail::iterate_in_lanes(AnglesField{pendulum}, stages);
  return true;
}
template <mechanics::Chart Chart>
bool solve(const Chart& chart, mechanics::GaussStages& stages) {
  // The fast sines and cosines require moderate angles. For larger coordinates the result is false, and the caller
  // evaluates the stages one by one.
  for (int k = 0; k < stages.n; ++k)
    if (!(std::abs(stages.q[k]) < 0.5 * mechanics::most_of_moderate)) return false;
  mechanics::detail::iterate_in_lanes(FieldOfChart<Chart>{chart}, stages);
  return true;
}

template <class... S>
constexpr StageSolvers<S...> solvers_of(StageSolvers<S...>) {
  return {{static_cast<StageSolver<S>>(solve)...}};
}

}  // namespace
}  // namespace pseudorigid::systems

extern const pseudorigid::systems::SystemKernels PSEUDORIGID_KERNEL_TABLE =
    pseudorigid::systems::solvers_of(pseudorigid::systems::SystemKernels{});
