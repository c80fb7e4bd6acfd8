#pragma once
/// A point in a moving frame (moving_frame.h; Oliva, Geometric Mechanics, 5.6.7) in parameter files. The program
/// integrates either the equation for the position Q in the frame, with inertial forces, or the equation for the
/// position q in space. Both forms write the same columns. Let U be the potential of all forces per unit mass,
/// including the forces at rest in the frame. With the angular velocity Ω and the origin r of the frame, the two
/// energies per unit mass are
///
///   E = ½|q̇|² + U                      constant if all forces are at rest in space,
///   J = ½|Q̇|² + U − ½|Ω × Q|²          (Jacobi) constant if Ω is constant, r̈ = 0, and all forces rest in the frame.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "entries/entry_kinds.h"
#include "systems/moving_frame.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

struct MovingFrameScene {
  static constexpr std::string_view name = "moving frame", file = "moving_frame", section = "Moving frame";
  static constexpr std::string_view documentation =
      "A point of unit mass under forces at rest in space or in a frame that turns and moves, with the inertial forces "
      "that appear in this frame.";
  static constexpr bool has_equilibria = false;

  enum class Form { moving, inertial };
  static constexpr auto form_kind = scene::choice<Form>({{"moving", Form::moving}, {"inertial", Form::inertial}});
  using Vector3 = std::vector<double>;

  Form form = Form::moving;
  Vector3 position{1, 0, 0}, velocity{0, 0, 0};
  Vector3 orientation{0, 0, 0}, spin_axis{0, 0, 1}, precession{0, 0, 0};
  double spin_rate = 1, spin_acceleration = 0;
  Vector3 origin{0, 0, 0}, origin_velocity{0, 0, 0}, origin_acceleration{0, 0, 0}, shaking{0, 0, 0};
  double shaking_frequency = 0;
  Vector3 field{0, 0, 0}, center{0, 0, 0}, frame_field{0, 0, 0}, frame_center{0, 0, 0}, frame_stiffness{0, 0, 0};
  double stiffness = 0, attraction = 0;

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    constexpr scene::Numbers vector{3};
    visit(s.form, form_kind,
          About{"Moving frame/Form", "",
                "Which equation of motion is integrated. moving: that in the frame, with inertial forces. inertial: "
                "that in space."});
    visit(s.position, vector, About{"Moving frame/Position", "length", "Initial position in the frame."});
    visit(s.velocity, vector, About{"Moving frame/Velocity", "length/time", "Initial velocity relative to the frame."});
    visit_motion(s, visit);
    visit(s.field, vector, About{"Moving frame/Field", "length/time^2", "Uniform gravity in space."});
    visit(s.stiffness, scene::Number{},
          About{"Moving frame/Stiffness", "1/time^2", "Stiffness of an isotropic spring to Centre, per unit mass."});
    visit(s.attraction, scene::Number{},
          About{"Moving frame/Attraction", "length^3/time^2",
                "Kepler's constant: Centre attracts with Attraction/distance^2."});
    visit(s.center, vector,
          About{"Moving frame/Centre", "length", "Centre of the spring and of the attraction, at rest in space."});
    visit(s.frame_field, vector, About{"Moving frame/Frame field", "length/time^2", "Uniform gravity in the frame."});
    visit(s.frame_stiffness, vector,
          About{"Moving frame/Frame stiffness", "1/time^2",
                "Stiffnesses of springs along the axes of the frame, per unit mass."});
    visit(s.frame_center, vector,
          About{"Moving frame/Frame centre", "length", "Point of the frame at which its springs have no force."});
  }

  /// The unit of mass is 1, and the unit of length is typical_length. The unit of time is the reciprocal of the largest
  /// rate of forces, frame and initial motion, or 1 if all rates are zero.
  Scales scales() const {
    const double force_rate =
        std::sqrt(std::max({std::abs(spin_acceleration), std::abs(stiffness),
                            Eigen::Vector3d(frame_stiffness.data()).cwiseAbs().maxCoeff(),
                            attraction == 0 ? 0 : std::abs(attraction) / std::pow(distance_from_center(), 3)}));
    const double frame_rate = std::max({std::abs(spin_rate), norm(precession), std::abs(shaking_frequency)});
    const double given_rate = std::max(force_rate, frame_rate);
    const double acceleration = std::max({norm(field), norm(frame_field), norm(origin_acceleration)});
    const double speed = norm(velocity), length = typical_length(given_rate, speed, acceleration);
    const double rate = std::max({given_rate, speed / length, std::sqrt(acceleration / length)});
    return {length, 1, rate > 0 ? 1 / rate : 1};
  }

  std::optional<Refusal> refuses() const {
    if (norm(spin_axis) == 0) return Refusal{"Moving frame/Spin axis", "expected a direction, got zero"};
    if (attraction != 0 && distance_from_center() == 0)
      return Refusal{"Moving frame/Position", "the point starts in Moving frame/Centre, where Attraction is infinite"};
    return {};
  }

  std::vector<Column> columns() const {
    std::vector<Column> columns;
    const auto vector = [&](const std::string& prefix, Unit unit, std::string_view documentation) {
      for (const char* axis : {"x", "y", "z"}) columns.push_back({prefix + axis, unit, documentation});
    };
    vector("relative_", "length", "position in the frame");
    vector("relative_v", "length/time", "velocity relative to the frame, along its axes");
    vector("inertial_", "length", "position in space");
    vector("inertial_v", "length/time", "velocity in space");
    vector("force_", "length/time^2", "given force per unit mass, along the axes of the frame");
    vector("translation_", "length/time^2", "inertial force of the origin's acceleration, -M^-1 r''");
    vector("euler_", "length/time^2", "inertial force of the rotation's change, -Omega' x Q");
    vector("coriolis_", "length/time^2", "Coriolis force, -2 Omega x Q'");
    vector("centrifugal_", "length/time^2", "centrifugal force, -Omega x (Omega x Q)");
    columns.push_back({"potential", "length^2/time^2", "potential energy of the given forces, per unit mass"});
    columns.push_back({"energy", "length^2/time^2",
                       "kinetic energy in space and potential, constant if no force is at rest in the moving frame"});
    columns.push_back({"jacobi", "length^2/time^2",
                       "kinetic energy in the frame, potential and centrifugal potential: Jacobi's integral, constant "
                       "if the frame turns uniformly without acceleration of its origin and the forces rest in it"});
    return columns;
  }

  /// Appends the values of all columns. `relative` and `inertial` are the same state in the frame and in space. Fails
  /// if MovingFrame::terms fails.
  static mechanics::Status append(const FrameParameters& p, const mechanics::State<MovingFrame>& relative,
                                  const mechanics::State<InertialFrame>& inertial, std::vector<double>& row) {
    RelativeTerms terms;
    if (auto status = MovingFrame(p).terms(relative.t, relative.q, relative.v, terms); !status) return status;
    const std::initializer_list<const Eigen::Vector3d*> vectors{&relative.q,     &relative.v,     &inertial.q,
                                                                &inertial.v,     &terms.force,    &terms.translation,
                                                                &terms.rotation, &terms.coriolis, &terms.centrifugal};
    for (const Eigen::Vector3d* x : vectors) row.insert(row.end(), x->begin(), x->end());
    const double U = potential(p.forces, inertial.q, relative.q);
    const Eigen::Vector3d dragged = p.frame.at(relative.t).Omega.cross(relative.q);
    row.insert(row.end(), {U, 0.5 * inertial.v.squaredNorm() + U,
                           0.5 * relative.v.squaredNorm() + U - 0.5 * dragged.squaredNorm()});
    return {};
  }

  template <class Frame>
  struct Model {
    using System = Frame;
    System system;
    mechanics::State<System> initial;

    mechanics::Status row(const mechanics::State<System>& state, typename System::Workspace&,
                          std::vector<double>& row) const {
      const FrameParameters& p = system.parameters();
      if constexpr (std::is_same_v<Frame, MovingFrame>)
        return append(p, state, to_inertial(p.frame, state), row);
      else
        return append(p, to_moving(p.frame, state), state, row);
    }
  };

  template <class Run>
  auto with_model(Run&& run) const {
    const FrameParameters p{motion(), forces()};
    const mechanics::State<MovingFrame> start{0, Eigen::Vector3d(position.data()), Eigen::Vector3d(velocity.data())};
    if (form == Form::inertial) return run(Model<InertialFrame>{InertialFrame(p), to_inertial(p.frame, start)});
    return run(Model<MovingFrame>{MovingFrame(p), start});
  }

 private:
  /// The unit of length. Let |v| be the initial speed and |a| the largest given acceleration. Let T be the reciprocal
  /// of the largest given rate. Without such a rate, T is |v|/|a|, or 1 if |v| or |a| is zero. The unit is the first
  /// positive number of a list. The list begins with the initial distance from the origin of the frame and the
  /// amplitude of shaking. If the frame has springs to the point C, |C| follows. The list continues with T|v|, T²|a|,
  /// the distance from a centre of force in space, and T|ṙ₀| with the velocity ṙ₀ of the origin. The list ends with 1.
  double typical_length(double given_rate, double speed, double acceleration) const {
    const double time = given_rate > 0 ? 1 / given_rate : speed > 0 && acceleration > 0 ? speed / acceleration : 1;
    return first_positive({norm(position), norm(shaking), norm(frame_stiffness) > 0 ? norm(frame_center) : 0,
                           time * speed, time * time * acceleration,
                           stiffness != 0 || attraction != 0 ? distance_from_center() : 0, time * norm(origin_velocity),
                           1});
  }

  template <class Self, class Visit>
  static void visit_motion(Self& s, Visit&& visit) {
    constexpr scene::Numbers vector{3};
    visit(s.orientation, vector,
          About{"Moving frame/Orientation", "",
                "Orientation of the frame at time 0: axis of the rotation that takes the axes of space to those of "
                "the frame, times its angle in radians."});
    visit(s.spin_axis, vector,
          About{"Moving frame/Spin axis", "", "Direction, in the frame, of the axis about which it spins."});
    visit(s.spin_rate, scene::Number{}, About{"Moving frame/Spin rate", "1/time", "Rate of the spin at time 0."});
    visit(s.spin_acceleration, scene::Number{},
          About{"Moving frame/Spin acceleration", "1/time^2", "Constant rate of change of the spin rate."});
    visit(s.precession, vector,
          About{"Moving frame/Precession", "1/time", "Angular velocity, in space, of the spin axis."});
    visit(s.origin, vector, About{"Moving frame/Origin", "length", "Position of the frame's origin at time 0."});
    visit(s.origin_velocity, vector,
          About{"Moving frame/Origin velocity", "length/time", "Velocity of the origin at time 0."});
    visit(s.origin_acceleration, vector,
          About{"Moving frame/Origin acceleration", "length/time^2", "Constant acceleration of the origin."});
    visit(s.shaking, vector,
          About{"Moving frame/Shaking", "length", "Amplitude b of an additional motion b sin(w t) of the origin."});
    visit(s.shaking_frequency, scene::Number{},
          About{"Moving frame/Shaking frequency", "1/time", "Frequency w of Shaking."});
  }

  static double norm(const Vector3& x) { return Eigen::Vector3d(x.data()).stableNorm(); }
  static double first_positive(std::initializer_list<double> candidates) {
    return *std::find_if(candidates.begin(), candidates.end(), [](double x) { return x > 0; });
  }
  /// The potential U of all forces per unit mass.
  static double potential(const FrameForces& forces, const Eigen::Vector3d& q, const Eigen::Vector3d& Q) {
    const Eigen::Vector3d d = q - forces.center, D = Q - forces.frame_center;
    const double U = -forces.field.dot(q) + 0.5 * forces.stiffness * d.squaredNorm() - forces.frame_field.dot(Q) +
                     0.5 * D.dot(forces.frame_stiffness.cwiseProduct(D));
    return forces.attraction == 0 ? U : U + AttractionLaw{forces.attraction}.energy(d.norm());
  }
  /// The initial distance in space of the point from the centre of the spring and the attraction.
  double distance_from_center() const {
    const FrameParameters p{motion(), forces()};
    const mechanics::State<MovingFrame> start{0, Eigen::Vector3d(position.data()), Eigen::Vector3d::Zero()};
    return (to_inertial(p.frame, start).q - p.forces.center).stableNorm();
  }
  FrameMotion motion() const {
    const Eigen::Vector3d turn(orientation.data());
    return {.M0 = Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()).toRotationMatrix(),
            .spin_axis = Eigen::Vector3d(spin_axis.data()),
            .spin_rate = spin_rate,
            .spin_acceleration = spin_acceleration,
            .precession = Eigen::Vector3d(precession.data()),
            .origin = Eigen::Vector3d(origin.data()),
            .velocity = Eigen::Vector3d(origin_velocity.data()),
            .acceleration = Eigen::Vector3d(origin_acceleration.data()),
            .shaking = Eigen::Vector3d(shaking.data()),
            .shaking_frequency = shaking_frequency};
  }
  FrameForces forces() const {
    return {.field = Eigen::Vector3d(field.data()),
            .center = Eigen::Vector3d(center.data()),
            .stiffness = stiffness,
            .attraction = attraction,
            .frame_field = Eigen::Vector3d(frame_field.data()),
            .frame_center = Eigen::Vector3d(frame_center.data()),
            .frame_stiffness = Eigen::Vector3d(frame_stiffness.data())};
  }
};

}  // namespace pseudorigid::systems
