#pragma once
/// Rigid body with a fixed point, or the rotation of a free body about its centre of mass, by Euler's equation (Oliva,
/// Geometric Mechanics, 5.6.16–5.6.17). The configuration is a unit quaternion q with the rotation R(q)ξ = q ξ q̄. The
/// angular velocity Ω in the body, the inertia operator A and the torque N satisfy
///
///   q̇ = ½qΩ,   AΩ̇ = AΩ × Ω + N,   N = ∫ξ × R⁻¹df,
///   q̈ = ½(q̇Ω + qΩ̇)
///
/// The last equation is a second-order field on R⁴. The manifold |q| = 1, ⟨q, q̇⟩ = 0 is invariant. Flat and linear
/// bodies are permitted if A is invertible. The order of the entries of q is (x, y, z, w), as in Eigen.

#include <Eigen/Geometry>
#include <cmath>
#include <concepts>
#include <string>
#include <type_traits>
#include <utility>

#include "mechanics/core/second_order_field.h"
#include "systems/body_loads.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

/// A function torque(t, R, Ω, N) that sets N to the torque in the axes of the body. The arguments are the time t, the
/// rotation R and the angular velocity Ω in the body.
template <class T>
concept BodyTorque = requires(const T torque, double t, const Eigen::Matrix3d R, const Eigen::Vector3d Omega,
                              Eigen::Vector3d N) {
  { torque(t, R, Omega, N) } -> std::same_as<mechanics::Status>;
};

struct NoTorque {
  mechanics::Status operator()(double, const Eigen::Matrix3d&, const Eigen::Vector3d&, Eigen::Vector3d& N) const {
    N.setZero();
    return {};
  }
};

/// The torque N of weight and springs about the origin of the body. Fails in the cases of BodyLoads::apply.
struct LoadTorque {
  BodyLoads loads;
  mechanics::Status operator()(double, const Eigen::Matrix3d& R, const Eigen::Vector3d&, Eigen::Vector3d& N) const {
    N.setZero();
    return loads.apply(
        [&](const Eigen::Vector3d& xi) -> Eigen::Vector3d { return R * xi; },
        [&](const Eigen::Vector3d& xi, const Eigen::Vector3d& df) { N += xi.cross(R.transpose() * df); });
  }
};

template <BodyTorque Torque = NoTorque>
class EulerTop {
 public:
  using Vector = Eigen::Vector4d;
  struct Workspace {};

  struct Parameters {
    Eigen::Matrix3d A = Eigen::Matrix3d::Identity();  // inertia operator about the fixed point or the centre of mass
    Torque torque{};
  };

  explicit EulerTop(Parameters parameters) : p_(std::move(parameters)), A_inverse_(p_.A.inverse()) {}

  mechanics::Status acceleration(double t, const Vector& q, const Vector& v, Workspace&, Vector& a) const {
    const Eigen::Vector3d Omega = body_angular_velocity(q, v);
    Eigen::Vector3d N;
    if (mechanics::Status status = p_.torque(t, rotation(q), Omega, N); !status) return status;
    const Eigen::Vector3d Omega_rate = A_inverse_ * ((p_.A * Omega).cross(Omega) + N);
    a = 0.5 * (product(v, Omega) + product(q, Omega_rate));
    return {};
  }
  /// Members that the templates of mechanics/core/stage_by_stage.h call for the stages of a Gauss step in SIMD lanes.
  /// Only the two torques of this header have kernels.
  bool has_stages_in_lanes() const { return std::is_same_v<Torque, LoadTorque> || std::is_same_v<Torque, NoTorque>; }
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const {
    if (!has_stages_in_lanes()) return false;
    TopOfStages top{p_.A, A_inverse_};
    if constexpr (std::is_same_v<Torque, LoadTorque>) top.loads = &p_.torque.loads;
    return solve_stages_in_lanes_of(top, stages);
  }
  double cost_of_iteration() const { return cost_of_iteration_in_lanes<TopOfStages>; }
  /// Projects a state onto |q| = 1, ⟨q, q̇⟩ = 0. Fails if |q| is not between ½ and 2.
  mechanics::Status project(Vector& q, Vector& v, Workspace&) const {
    const double norm = q.norm();
    if (!(norm > 0.5 && norm < 2))
      return mechanics::Status::failure("the quaternion of the rotation has lost its unit length: |q| = " +
                                        mechanics::six_digits(norm));
    q /= norm;
    v -= q.dot(v) * q;
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
  bool velocity_dependent() const { return true; }

  static Eigen::Matrix3d rotation(const Vector& q) {
    return Eigen::Quaterniond(Vector(q.normalized())).toRotationMatrix();
  }
  /// The angular velocity Ω = 2 q⁻¹q̇ in the body.
  static Eigen::Vector3d body_angular_velocity(const Vector& q, const Vector& v) {
    const Eigen::Vector3d a = q.head<3>(), b = v.head<3>();
    return 2 / q.squaredNorm() * (q(3) * b - v(3) * a - a.cross(b));
  }
  /// The state at time 0 with the rotation R and the angular velocity Ω in the body.
  static mechanics::State<EulerTop> turning(const Eigen::Matrix3d& R, const Eigen::Vector3d& Omega) {
    const Vector q = Eigen::Quaterniond(R).normalized().coeffs();
    return {0, q, 0.5 * product(q, Omega)};
  }
  double kinetic_energy(const Vector& q, const Vector& v) const {
    const Eigen::Vector3d Omega = body_angular_velocity(q, v);
    return 0.5 * Omega.dot(p_.A * Omega);
  }
  /// The angular momentum R AΩ in space, about the fixed point or the centre of mass.
  Eigen::Vector3d angular_momentum(const Vector& q, const Vector& v) const {
    return rotation(q) * (p_.A * body_angular_velocity(q, v));
  }
  const Parameters& parameters() const { return p_; }

 private:
  /// The product of the quaternion q and the quaternion with the vector part w and the scalar part 0.
  static Vector product(const Vector& q, const Eigen::Vector3d& w) {
    Vector r;
    r << q(3) * w + Eigen::Vector3d(q.head<3>()).cross(w), -q.head<3>().dot(w);
    return r;
  }

  Parameters p_;
  Eigen::Matrix3d A_inverse_;
};

}  // namespace pseudorigid::systems
