#pragma once
/// Motion of a point of unit mass in a moving frame K. A point with the position Q in K has the position q = M_t Q +
/// r(t) in space. M_t ∈ SO(3) is the rotation of the frame (Oliva, Geometric Mechanics, 5.6.7). Under a force f, its
/// motion satisfies
///
///   Q̈ = M_t⁻¹f − M_t⁻¹r̈ − Ω̇ × Q − 2Ω × Q̇ − Ω × (Ω × Q)
///       force  translation  rotation  Coriolis  centrifugal
///
/// The frame has the rotation M_t = exp(t p×) M₀ exp(α(t) n×) with the spin angle α = ν t + ½ν̇t². At t = 0, the
/// rotation is M₀. The spin about the axis n, which is fixed in the frame, has the rate ν at t = 0 and the constant
/// angular acceleration ν̇. The axis n precesses in space with the angular velocity p. In the axes of K, the frame has
/// the angular velocity Ω and the angular acceleration Ω̇:
///
///   Ω = α̇n + u,   Ω̇ = α̈n − α̇ n × u,   u = exp(−α n×)M₀⁻¹p.
///
/// The origin of the frame has the position r = r₀ + ṙ₀t + ½at² + b sin(wt). The acceleration a is constant, and b
/// sin(wt) is a shaking with the amplitude b and the angular frequency w.
///
/// The forces at rest in space are uniform gravity g, a spring −k(q − c) and an attraction −μ(q − c)/|q − c|³, which
/// have the same centre c. The forces at rest in the frame are uniform gravity G, and springs −diag(K₁, K₂, K₃)(Q − C)
/// to the centre C.
///
/// In the inertial frame, the same motion satisfies q̈ = f.

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>

#include "mechanics/core/second_order_field.h"
#include "systems/central_force.h"
#include "systems/systems_in_lanes.h"

namespace pseudorigid::systems {

template <class T>
using Space = Eigen::Matrix<T, 3, 1>;

/// The pose M_t, r(t) of the frame and its derivatives at one time. The scalar type T is double or a vector of SIMD
/// lanes.
template <class T>
struct FramePoseOver {
  Eigen::Matrix<T, 3, 3> M;
  Space<T> Omega, Omega_rate;          // angular velocity Ω, and Ω̇, in the axes of K
  Space<T> r, r_rate, r_acceleration;  // position r of the origin, ṙ and r̈

  /// Visits all entries, in the order of the members. The entries of M are visited column by column.
  template <class Visit>
  void visit(Visit&& visit) {
    for (T& x : M.reshaped()) visit(x);
    for (Space<T>* vector : {&Omega, &Omega_rate, &r, &r_rate, &r_acceleration})
      for (T& x : *vector) visit(x);
  }
  static constexpr std::size_t n_entries = 24;
};
using FramePose = FramePoseOver<double>;

/// The motion of the frame: its pose as a function of time.
struct FrameMotion {
  Eigen::Matrix3d M0 = Eigen::Matrix3d::Identity();        // rotation M₀ of the frame at t = 0
  Eigen::Vector3d spin_axis = Eigen::Vector3d::UnitZ();    // spin axis n in the frame, of any length
  double spin_rate = 0, spin_acceleration = 0;             // spin rate ν at t = 0, and angular acceleration ν̇
  Eigen::Vector3d precession = Eigen::Vector3d::Zero();    // angular velocity p of the precession in space
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();        // position r₀ of the origin at t = 0
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      // velocity ṙ₀ of the origin at t = 0
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  // constant acceleration a of the origin
  Eigen::Vector3d shaking = Eigen::Vector3d::Zero();       // amplitude b of the shaking
  double shaking_frequency = 0;                            // angular frequency w of the shaking

  FramePose at(double t) const {
    const Eigen::Vector3d n = spin_axis.normalized();
    const double alpha = (spin_rate + 0.5 * spin_acceleration * t) * t, alpha_rate = spin_rate + spin_acceleration * t;
    const Eigen::Matrix3d spin = Eigen::AngleAxisd(alpha, n).toRotationMatrix();
    const Eigen::Vector3d u = spin.transpose() * (M0.transpose() * precession);
    const double s = std::sin(shaking_frequency * t), c = std::cos(shaking_frequency * t);
    return {.M = turn(t * precession) * M0 * spin,
            .Omega = alpha_rate * n + u,
            .Omega_rate = spin_acceleration * n - alpha_rate * n.cross(u),
            .r = origin + t * velocity + 0.5 * t * t * acceleration + s * shaking,
            .r_rate = velocity + t * acceleration + shaking_frequency * c * shaking,
            .r_acceleration = acceleration - shaking_frequency * shaking_frequency * s * shaking};
  }

 private:
  /// The rotation exp(w×).
  static Eigen::Matrix3d turn(const Eigen::Vector3d& w) {
    return Eigen::AngleAxisd(w.norm(), w.stableNormalized()).toRotationMatrix();
  }
};

/// The forces per unit mass on the point.
struct FrameForces {
  Eigen::Vector3d field = Eigen::Vector3d::Zero();            // gravity g in space
  Eigen::Vector3d center = Eigen::Vector3d::Zero();           // centre c of the spring and the attraction in space
  double stiffness = 0;                                       // stiffness k of the spring to c
  double attraction = 0;                                      // strength μ of the attraction
  Eigen::Vector3d frame_field = Eigen::Vector3d::Zero();      // gravity G in the frame
  Eigen::Vector3d frame_center = Eigen::Vector3d::Zero();     // centre C of the springs in the frame
  Eigen::Vector3d frame_stiffness = Eigen::Vector3d::Zero();  // stiffnesses K₁, K₂, K₃ of these springs

  /// Sets f to the force in space per unit mass on the point q, whose position in the frame is Q. The rotation of the
  /// frame is M. Returns 1 if μ = 0 or if μ/|q − c|³ is finite, otherwise NaN.
  template <class T>
  T in_space(const Space<T>& q, const Space<T>& Q, const Eigen::Matrix<T, 3, 3>& M, Space<T>& f) const {
    const Space<T> in_frame =
                       frame_field.cast<T>() - frame_stiffness.cast<T>().cwiseProduct(Q - frame_center.cast<T>()),
                   d = q - center.cast<T>();
    f = field.cast<T>() - T(stiffness) * d + M * in_frame;
    if (attraction == 0) return T(1.0);
    return add_central_force(AttractionLaw{attraction}, d, f);
  }
};

struct FrameParameters {
  FrameMotion frame;
  FrameForces forces;
};

/// The forces, and the pose of the frame at each stage of a Gauss step. `forces` must exist as long as this object.
struct FrameOfStages {
  const FrameForces& forces;
  bool moving;  ///< true if the stages have positions in the moving frame, false if in space
  std::array<mechanics::OfStages, FramePose::n_entries> pose;  ///< the entries of FramePose, each at all stages
};
/// Computes the poses at the times of the stages. The poses do not depend on the state, so this function is called once
/// for a step. The result refers to p.forces.
inline FrameOfStages stages_in_frame(const FrameParameters& p, const mechanics::GaussStages& stages, bool moving) {
  FrameOfStages frame{p.forces, moving, {}};
  for (std::size_t i = 0; i < mechanics::gauss::n_stages; ++i) {
    FramePose pose = p.frame.at(stages.t + stages.tables->c[i]);
    std::size_t k = 0;
    pose.visit([&](double x) { frame.pose[k++][i] = x; });
  }
  return frame;
}

/// The terms on the right-hand side of the equation of motion (5.6.7), in the axes of the moving frame and per unit
/// mass.
template <class T>
struct RelativeTermsOver {
  Space<T> force, translation, rotation, coriolis, centrifugal;
  Space<T> sum() const { return force + translation + rotation + coriolis + centrifugal; }
};
using RelativeTerms = RelativeTermsOver<double>;

/// The second-order field of the point in the moving frame, with the state (Q, Q̇).
class MovingFrame {
 public:
  using Vector = Eigen::Vector3d;
  struct Workspace {};
  using Parameters = FrameParameters;

  explicit MovingFrame(Parameters parameters) : p_(std::move(parameters)) {}

  /// Computes the terms at the time t, for the position Q and the velocity V = Q̇ in the frame. Without an attraction
  /// (μ = 0), the function never fails. With an attraction, it fails if μ/|q − c|³ is infinite or NaN. Examples are a
  /// point at the centre c, and coordinates that are NaN.
  mechanics::Status terms(double t, const Vector& Q, const Vector& V, RelativeTerms& terms) const {
    return status_of_force(terms_over(p_.forces, p_.frame.at(t), Q, V, terms));
  }
  /// Computes the terms for any scalar type, for the position Q and the velocity V = Q̇ in the frame. Returns the
  /// result of FrameForces::in_space.
  template <class T>
  static T terms_over(const FrameForces& forces, const FramePoseOver<T>& pose, const Space<T>& Q, const Space<T>& V,
                      RelativeTermsOver<T>& terms) {
    Space<T> f;
    const T reserve = forces.in_space<T>(pose.M * Q + pose.r, Q, pose.M, f);
    terms = {.force = pose.M.transpose() * f,
             .translation = -(pose.M.transpose() * pose.r_acceleration),
             .rotation = -pose.Omega_rate.cross(Q),
             .coriolis = T(-2.0) * pose.Omega.cross(V),
             .centrifugal = -pose.Omega.cross(pose.Omega.cross(Q))};
    return reserve;
  }
  mechanics::Status acceleration(double t, const Vector& Q, const Vector& V, Workspace&, Vector& a) const {
    RelativeTerms sum;
    if (mechanics::Status status = terms(t, Q, V, sum); !status) return status;
    a = sum.sum();
    return {};
  }
  /// Members that the templates of mechanics/core/stage_by_stage.h call for the stages of a Gauss step in SIMD lanes.
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const {
    return solve_stages_in_lanes_of(stages_in_frame(p_, stages, true), stages);
  }
  double cost_of_iteration() const { return cost_of_iteration_in_lanes<FrameOfStages>; }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
  bool velocity_dependent() const { return true; }
  bool time_dependent() const { return true; }

  const Parameters& parameters() const { return p_; }

 private:
  Parameters p_;
};

/// The second-order field of the same point in the inertial frame, with the state (q, q̇).
class InertialFrame {
 public:
  using Vector = Eigen::Vector3d;
  struct Workspace {};
  using Parameters = FrameParameters;

  explicit InertialFrame(Parameters parameters) : p_(std::move(parameters)) {}

  mechanics::Status acceleration(double t, const Vector& q, const Vector&, Workspace&, Vector& a) const {
    return status_of_force(acceleration_over(p_.forces, p_.frame.at(t), q, a));
  }
  /// Computes the acceleration for any scalar type. Returns the result of FrameForces::in_space.
  template <class T>
  static T acceleration_over(const FrameForces& forces, const FramePoseOver<T>& pose, const Space<T>& q, Space<T>& a) {
    return forces.in_space<T>(q, pose.M.transpose() * (q - pose.r), pose.M, a);
  }
  /// Members that the templates of mechanics/core/stage_by_stage.h call for the stages of a Gauss step in SIMD lanes.
  bool solve_stages_in_lanes(mechanics::GaussStages& stages) const {
    return solve_stages_in_lanes_of(stages_in_frame(p_, stages, false), stages);
  }
  double cost_of_iteration() const { return cost_of_iteration_in_lanes<FrameOfStages>; }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
  bool time_dependent() const { return true; }

  const Parameters& parameters() const { return p_; }

 private:
  Parameters p_;
};

/// Conversion of states between the two frames, q = M_t Q + r and q̇ = M_t(Q̇ + Ω × Q) + ṙ (5.49, 5.50).
inline mechanics::State<InertialFrame> to_inertial(const FrameMotion& frame, const mechanics::State<MovingFrame>& s) {
  const FramePose pose = frame.at(s.t);
  return {s.t, pose.M * s.q + pose.r, pose.M * (s.v + pose.Omega.cross(s.q)) + pose.r_rate};
}
inline mechanics::State<MovingFrame> to_moving(const FrameMotion& frame, const mechanics::State<InertialFrame>& s) {
  const FramePose pose = frame.at(s.t);
  const Eigen::Vector3d Q = pose.M.transpose() * (s.q - pose.r);
  return {s.t, Q, pose.M.transpose() * (s.v - pose.r_rate) - pose.Omega.cross(Q)};
}

}  // namespace pseudorigid::systems
