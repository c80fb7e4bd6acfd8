#pragma once
/// Rigid body with a fixed point, or the rotation of a free body about its centre of mass, by Lagrange's equations
/// (Oliva, Geometric Mechanics, 5.110–5.115). The coordinates are the Euler angles h = (φ, θ, ψ) with R = R_z(φ) R_x(θ)
/// R_z(ψ). The angles are a chart of SO(3) with the metric g of the kinetic energy K and the potential U of the loads.
/// With the angular velocity Ω in the body, the inertia operator A and the forces df,
///
///   Ω = B(h) ḣ,   g = BᵀAB,   U = V(R(h)),   d/dt ∂K/∂ḣ_i − ∂K/∂h_i = −∂U/∂h_i = ⟨ω_i, ∫Rξ × df⟩
///
/// with the potential V of the loads as a function of R, and the axes ω_i, which satisfy ∂R/∂h_i R⁻¹ = ω_i×. The axes
/// of φ, θ and ψ are e_z, the nodal line, and the third axis e₃ of the body. The chart is singular at sin θ = 0, where
/// e_z and e₃ are parallel.

#include <Eigen/Dense>
#include <cmath>
#include <string>
#include <utility>

#include "mechanics/core/chart_field.h"
#include "systems/body_loads.h"
#include "systems/euler_angles.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

/// The matrix B(h), which maps the rates ḣ to the angular velocity Ω.
template <class T>
Eigen::Matrix<T, 3, 3> angular_velocity_of_rates(const mechanics::Coordinates<T, 3>& h) {
  using std::cos, std::sin;
  const T st = sin(h[1]), ct = cos(h[1]), sp = sin(h[2]), cp = cos(h[2]);
  Eigen::Matrix<T, 3, 3> B;
  B << T(st * sp), cp, T(0.0), T(st * cp), T(-sp), T(0.0), ct, T(0.0), T(1.0);
  return B;
}

/// The rotation R(h) for any scalar type.
template <class T>
Eigen::Matrix<T, 3, 3> rotation_of_angles(const mechanics::Coordinates<T, 3>& h) {
  using std::cos, std::sin;
  const T sf = sin(h[0]), cf = cos(h[0]), st = sin(h[1]), ct = cos(h[1]), sp = sin(h[2]), cp = cos(h[2]);
  Eigen::Matrix<T, 3, 3> R;
  R << T(cf * cp - sf * ct * sp), T(-cf * sp - sf * ct * cp), T(sf * st),  //
      T(sf * cp + cf * ct * sp), T(-sf * sp + cf * ct * cp), T(-cf * st),  //
      T(st * sp), T(st * cp), ct;
  return R;
}

/// The chart of SO(3) by the Euler angles h, with the metric g and the potential U for any scalar type.
struct EulerAngleChart {
  static constexpr int dimension = 3;
  Eigen::Matrix3d A = Eigen::Matrix3d::Identity();  ///< inertia operator about the fixed point or the centre of mass
  BodyLoads loads{};

  template <class T>
  Eigen::Matrix<T, 3, 3> metric(const mechanics::Coordinates<T, 3>& h) const {
    const Eigen::Matrix<T, 3, 3> B = angular_velocity_of_rates(h);
    Eigen::Matrix<T, 3, 3> g;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        g(i, j) = T(0.0);
        for (int k = 0; k < 3; ++k)
          for (int l = 0; l < 3; ++l) g(i, j) += A(k, l) * B(k, i) * B(l, j);
      }
    return g;
  }
  template <class T>
  T potential(const mechanics::Coordinates<T, 3>& h) const {
    using std::sqrt;
    const Eigen::Matrix<T, 3, 3> R = rotation_of_angles(h);
    const auto place = [&](const Eigen::Vector3d& xi, int i) {
      return T(R(i, 0) * xi[0] + R(i, 1) * xi[1] + R(i, 2) * xi[2]);
    };
    T U = T(0.0) * h[0];
    for (int i = 0; i < 3; ++i) U -= loads.mass * loads.gravity[i] * place(loads.center, i);
    for (const BodySpring& spring : loads.springs) {
      T r_squared = T(0.0) * h[0];
      for (int i = 0; i < 3; ++i) {
        const T d = place(spring.xi, i) - spring.anchor[i];
        r_squared += d * d;
      }
      const auto& [k, l] = spring.law;
      U += 0.5 * k * (r_squared + l * l);
      if (l != 0) U -= k * l * sqrt(r_squared);
    }
    return U;
  }
  /// Returns a positive number inside the chart, |sin θ| > `smallest_sine`, and otherwise a number that is not
  /// positive. Near sin θ = 0, the rates of φ and ψ and their errors increase as 1/sin θ.
  template <class T>
  T reserve(const mechanics::Coordinates<T, 3>& h) const {
    using std::sin;
    const T sine = sin(h[1]);
    return sine * sine - smallest_sine * smallest_sine;
  }
  static constexpr double smallest_sine = 1e-4;
};

/// The second-order field of the chart. The acceleration fails with a message if |sin θ| is not above `smallest_sine`.
class LagrangeTop {
 public:
  using Vector = Eigen::Vector3d;
  using Workspace = mechanics::ChartField<EulerAngleChart>::Workspace;

  LagrangeTop(const Eigen::Matrix3d& A, BodyLoads loads) : field_(EulerAngleChart{A, std::move(loads)}) {}

  mechanics::Status acceleration(double t, const Vector& h, const Vector& rates, Workspace& w, Vector& a) const {
    if (!(field_.chart().reserve(h) > 0)) return singular();
    return field_.acceleration(t, h, rates, w, a);
  }
  /// Members that the templates of mechanics/core/stage_by_stage.h call for the stages of a Gauss step in SIMD lanes.
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const { return field_.solve_stages_in_lanes(stages); }
  double cost_of_iteration() const { return field_.cost_of_iteration(); }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
  bool velocity_dependent() const { return true; }

  static Eigen::Matrix3d rotation(const Vector& h) { return rotation_of_angles<double>(h); }
  static Eigen::Vector3d body_angular_velocity(const Vector& h, const Vector& rates) {
    return angular_velocity_of_rates<double>(h) * rates;
  }
  /// Returns true if the chart contains this rotation, that is, if |sin θ| is above `smallest_sine`.
  static bool has(const Eigen::Matrix3d& R) { return std::hypot(R(2, 0), R(2, 1)) > EulerAngleChart::smallest_sine; }
  /// The state at time 0 with the rotation R and the angular velocity Ω in the body. The chart must contain R.
  static mechanics::VectorState<Vector> turning(const Eigen::Matrix3d& R, const Eigen::Vector3d& Omega) {
    const EulerAngles h = euler_angles_of(R), rates = rates_of(h, Omega);
    return {0, {h.phi, h.theta, h.psi}, {rates.phi, rates.theta, rates.psi}};
  }
  const mechanics::ChartField<EulerAngleChart>& field() const { return field_; }
  const BodyLoads& loads() const { return field_.chart().loads; }

 private:
  [[gnu::cold]] static mechanics::Status singular() {
    return mechanics::Status::failure(
        "the third axis of the body is vertical, where the Euler angles are singular; the forms euler and constrained "
        "go on there");
  }

  mechanics::ChartField<EulerAngleChart> field_;
};

}  // namespace pseudorigid::systems
