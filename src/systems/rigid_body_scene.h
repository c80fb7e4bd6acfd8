#pragma once
/// The rigid body in parameter files. Three forms give the same motion: matrices of GL⁺(3) with six constraints
/// (rigid_body.h), Euler's equation on quaternions (euler_top.h), and Lagrange's equations in Euler angles
/// (lagrange_top.h). A fixed point is the origin of the body and of space. Without a fixed point, the origin of the
/// body is the centre of mass. The forms of Euler and Lagrange then use the exact motion x = x₀ + v₀t + ½gt² of the
/// centre of mass. Here g is the acceleration of gravity, and x₀ and v₀ are the initial position and velocity.
///
/// The scales are the mass m, the length L = √(tr E₀/m) and the time 1/ω, with the second moment E₀. With the initial
/// angular velocity Ω, the stiffness k of the springs, the centre of mass G and its initial velocity v,
///
///   ω² = the largest of |Ω|², |g||G|/L², k/m.  If all are zero, it is the larger of |g|/L and |v|²/L², or 1.
///
/// Mass points may replace mass, centre of mass and inertia (mass_distribution.h). For a body without a fixed point,
/// Steiner's theorem (5.6.11) then moves the origin to the centre of mass.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "entries/entry_kinds.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/equilibria/constrained_landscape.h"
#include "systems/euler_top.h"
#include "systems/lagrange_top.h"
#include "systems/mass_distribution.h"
#include "systems/rigid_body.h"
#include "systems/rigid_body_columns.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

/// The potential landscape of a body on SO(3). The mass matrix of a flat body is singular in the space of the matrices
/// q. This class adds GᵀG with the derivative G of the constraints, which makes the mass matrix regular. The added term
/// does not change the kinetic energy of motions on SO(3), because these motions satisfy G q̇ = 0.
struct RotationLandscape : mechanics::ConstrainedLandscape<FixedPointBody> {
  using mechanics::ConstrainedLandscape<FixedPointBody>::ConstrainedLandscape;
  void mass(const Eigen::VectorXd& q, Eigen::MatrixXd& M) const {
    ConstrainedLandscape::mass(q, M);
    Eigen::MatrixXd G;
    constraint_gradient(q, G);
    M += G.transpose() * G;
  }
};

struct RigidBodyScene {
  static constexpr std::string_view name = "rigid body", file = "rigid_body", section = "Rigid body";
  static constexpr std::string_view documentation =
      "Rigid body with a fixed point or free, with weight and springs to points of space.";
  static constexpr bool has_equilibria = true;

  enum class Form { constrained, euler, lagrange };
  static constexpr auto form_kind =
      scene::choice<Form>({{"constrained", Form::constrained}, {"euler", Form::euler}, {"lagrange", Form::lagrange}});

  Form form = Form::constrained;
  bool fixed_point = true;
  double mass = 1;
  std::vector<double> center{0, 0, 0};
  scene::Matrix3 inertia{{{0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}}};  // a homogeneous ball of mass 1 and radius 1
  std::vector<double> points, gravity{0, 0, 0}, springs;
  scene::Matrix3 rotation = scene::identity3;
  std::vector<double> angular_velocity{0, 0, 1}, position{0, 0, 0}, velocity{0, 0, 0};

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    visit(s.form, form_kind,
          About{"Rigid body/Form", "",
                "The equations of motion. With constrained, they are those of 3x3 matrices with the six constraints of "
                "a rotation. With euler, they "
                "are Euler's equation with quaternions. With lagrange, they are Lagrange's equations in Euler angles, "
                "which are singular if the third axis of the body is vertical. The last two also take flat bodies, but "
                "springs only with a fixed point."});
    visit(s.fixed_point, scene::Boolean{},
          About{"Rigid body/Fixed point", "",
                "true: the origin of the body stays at the origin of space. false: free; the origin of the body is its "
                "centre of mass."});
    visit(s.mass, scene::positive, About{"Rigid body/Mass", "mass", "Mass of the body."});
    visit(s.center, scene::Numbers{3},
          About{"Rigid body/Center", "length", "Centre of mass in the body, from the fixed point."});
    visit(s.inertia, scene::Matrix{},
          About{"Rigid body/Inertia", "mass*length^2",
                "Inertia operator in the body about its origin; its diagonal holds the moments of inertia."});
    visit(
        s.points, scene::Rows{4, true},
        About{"Rigid body/Points", "",
              "The body as mass points: a row for each, its place in the body (3 numbers, length) and its mass. The "
              "fixed "
              "point is the origin of the places; of a free body it may be anywhere. Mass, Center and Inertia are then "
              "ignored."});
    visit(s.gravity, scene::Numbers{3},
          About{"Rigid body/Gravity", "length/time^2", "Acceleration of gravity in space."});
    visit(s.springs, scene::Rows{8, true},
          About{"Rigid body/Springs", "",
                "One row per spring: point of the body (3 numbers, length), point of space (3), stiffness "
                "(mass/time^2), rest length."});
    visit(s.rotation, scene::Matrix{},
          About{"Rigid body/Rotation", "",
                "Initial rotation R, orthogonal to 1e-8; columns are the axes of the body in space."});
    visit(s.angular_velocity, scene::Numbers{3},
          About{"Rigid body/Angular velocity", "1/time", "Initial angular velocity in the body."});
    visit(s.position, scene::Numbers{3},
          About{"Rigid body/Position", "length", "Initial position of the centre of mass of a free body."});
    visit(s.velocity, scene::Numbers{3},
          About{"Rigid body/Velocity", "length/time", "Initial velocity of the centre of mass of a free body."});
  }
  /// Converts the rows of points and springs to the given scales. The columns of a row have several units. Therefore
  /// in_scales does not convert the rows.
  void rescale(const Scales& scales) {
    for (std::size_t k = 0; k < points.size(); k += n_point_columns) {
      for (std::size_t j : {0, 1, 2}) points[k + j] /= scales("length");
      points[k + 3] /= scales("mass");
    }
    for (std::size_t k = 0; k < springs.size(); k += n_spring_columns) {
      for (std::size_t j : {0, 1, 2, 3, 4, 5, 7}) springs[k + j] /= scales("length");
      springs[k + 6] /= scales("mass/time^2");
    }
  }

  Scales scales() const {
    const MassDistribution body = distribution();
    const double L = std::sqrt(body.E0.trace() / body.mass), g = vector(gravity).norm();
    double omega_2 = std::max(vector(angular_velocity).squaredNorm(), g * body.center.norm() / (L * L));
    for (const BodySpring& spring : loads().springs) omega_2 = std::max(omega_2, spring.law.stiffness / body.mass);
    if (omega_2 == 0) omega_2 = std::max(g / L, vector(velocity).squaredNorm() / (L * L));
    return {L, body.mass, omega_2 > 0 ? 1 / std::sqrt(omega_2) : 1};
  }

  std::optional<Refusal> refuses() const {
    if (auto refusal = points.empty() ? std::nullopt : refuses_points()) return refusal;
    if (auto refusal = refuses_inertia()) return refusal;
    const Eigen::Matrix3d R = matrix(rotation);
    if (const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(); !(off <= 1e-8))
      return refuses_rotation(R, off);
    if (R.determinant() < 0)
      return Refusal{"Rigid body/Rotation", "expected a rotation, det R = 1, got a reflection, det R = -1"};
    if (form == Form::lagrange && !LagrangeTop::has(R))
      return Refusal{"Rigid body/Rotation",
                     "expected a rotation whose third column is not vertical if Form = lagrange: Euler angles are "
                     "singular there",
                     {{{"Rigid body/Form", "euler"}}, {{"Rigid body/Form", "constrained"}}}};
    return fixed_point ? refuses_place() : refuses_free();
  }

  std::vector<Column> columns() const { return BodyObserver::columns(); }

  /// The model in the constrained form, whose configuration is q = [R | x], or q = R with a fixed point.
  template <bool has_fixed_point>
  struct ConstrainedModel {
    using System = RigidBody<has_fixed_point>;
    System system;
    mechanics::State<System> initial;
    BodyObserver observer;

    mechanics::Status row(const mechanics::State<System>& state, typename System::Workspace&,
                          std::vector<double>& row) const {
      const Eigen::Vector3d& G = system.parameters().loads.center;  // zero without a fixed point
      observer.append({System::rotation(state.q), System::body_angular_velocity(state.q, state.v),
                       System::place(state.q, G), System::place(state.v, G)},
                      row);
      return {};
    }
    /// The rate of change of the rotation per unit of time (any_model.h). It is |Ṙ|/(1 + |R|) with the maximum norm.
    /// The motion of the centre of mass has no effect on the rate.
    double rate(const mechanics::State<System>& state) const {
      return mechanics::max_norm(System::rotation(state.v)) / (1 + mechanics::max_norm(System::rotation(state.q)));
    }
    auto landscape() const { return mechanics::ConstrainedLandscape<System>(system); }
    std::vector<Column> coordinates() const { return body_coordinates(has_fixed_point); }
  };

  /// The model for the forms whose configurations are rotations only. The system `Turns` is EulerTop or LagrangeTop.
  template <class Turns>
  struct TurnsModel {
    using System = Turns;
    System system;
    mechanics::State<System> initial;
    BodyObserver observer;
    /// The same body in the form with constraints. The columns use the loads of this form, and the landscape is that of
    /// this form.
    FixedPointBody body;
    bool fixed_point;
    Eigen::Vector3d x, velocity;  ///< initial position and velocity of the centre of mass of a free body

    mechanics::Status row(const mechanics::State<System>& state, typename System::Workspace&,
                          std::vector<double>& row) const {
      const BodyLoads& loads = body.parameters().loads;
      const Eigen::Matrix3d R = System::rotation(state.q);
      const Eigen::Vector3d Omega = System::body_angular_velocity(state.q, state.v);
      BodyMotion motion{R, Omega, R * loads.center, R * Omega.cross(loads.center)};
      if (!fixed_point) {
        motion.x = x + state.t * (velocity + 0.5 * state.t * loads.gravity);
        motion.velocity = velocity + state.t * loads.gravity;
      }
      observer.append(motion, row);
      return {};
    }
    auto landscape() const { return RotationLandscape(body); }
    std::vector<Column> coordinates() const { return body_coordinates(true); }
  };

  template <class Run>
  auto with_model(Run&& run) const {
    const Eigen::Matrix3d A = inertia_about_origin(), R = nearest_rotation();
    const Eigen::Vector3d Omega = vector(angular_velocity), x = vector(position), v = vector(velocity);
    const BodyObserver observer(A, loads(), fixed_point);
    const FixedPointBody body({second_moment(A), loads()});
    using Top = EulerTop<LoadTorque>;
    if (form == Form::euler)
      return run(TurnsModel<Top>{Top({A, {loads()}}), Top::turning(R, Omega), observer, body, fixed_point, x, v});
    if (form == Form::lagrange)
      return run(TurnsModel<LagrangeTop>{LagrangeTop(A, loads()), LagrangeTop::turning(R, Omega), observer, body,
                                         fixed_point, x, v});
    if (fixed_point) return run(ConstrainedModel<true>{body, turning(R, Omega), observer});
    return run(ConstrainedModel<false>{FreeBody({second_moment(A), loads()}), turning(R, Omega, x, v), observer});
  }

 private:
  static constexpr std::size_t n_spring_columns = 8, n_point_columns = 4;

  static Eigen::Vector3d vector(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }
  static Eigen::Matrix3d matrix(const scene::Matrix3& rows) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows[0].data());
  }
  /// The matrix of the entry Rotation after one step of Newton's iteration for RᵀR = Id. The step reduces an error of
  /// 1e-8 to round-off.
  Eigen::Matrix3d nearest_rotation() const {
    const Eigen::Matrix3d R = matrix(rotation);
    return R + 0.5 * R * (Eigen::Matrix3d::Identity() - R.transpose() * R);
  }
  MassDistribution distribution_of_points() const {
    std::vector<WeightedPoint> list;
    for (std::size_t k = 0; k < points.size(); k += n_point_columns)
      list.push_back({{points[k], points[k + 1], points[k + 2]}, points[k + 3]});
    return MassDistribution::of_points(list);
  }
  /// Mass, centre of mass and second moment about the origin of the body, from the entries of the scene.
  MassDistribution distribution() const {
    if (points.empty()) return {mass, vector(center), second_moment(matrix(inertia))};
    const MassDistribution given = distribution_of_points();
    return fixed_point ? given : given.about(given.center);
  }
  Eigen::Matrix3d inertia_about_origin() const {
    return points.empty() ? matrix(inertia) : inertia_operator(distribution().E0);
  }
  BodyLoads loads() const {
    const MassDistribution body = distribution();
    BodyLoads loads{.mass = body.mass, .center = body.center, .gravity = vector(gravity)};
    if (!fixed_point) loads.center.setZero();  // for mass points, the centre is zero only up to round-off
    const Eigen::Vector3d origin =
        points.empty() || fixed_point ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : distribution_of_points().center;
    for (std::size_t k = 0; k < springs.size(); k += n_spring_columns) {
      const double* s = &springs[k];
      loads.springs.push_back({Eigen::Vector3d(s[0], s[1], s[2]) - origin, {s[3], s[4], s[5]}, {s[6], s[7]}});
    }
    return loads;
  }
  /// The coordinates of the landscape: the entries of q column by column.
  static std::vector<Column> body_coordinates(bool has_fixed_point) {
    std::vector<Column> columns;
    for (int j = 1; j <= 3; ++j)
      for (int i = 1; i <= 3; ++i) columns.push_back({fmt::format("R{}{}", i, j), "", ""});
    for (int i = 1; i <= 3 && !has_fixed_point; ++i) columns.push_back({fmt::format("x{}", i), "length", ""});
    return columns;
  }

  /// The rotation nearest to R, which is the polar factor of R, as the text of a matrix. R must be close to a rotation,
  /// because Newton's iteration then converges to this factor.
  static std::string nearest_rotation_to(Eigen::Matrix3d R) {
    for (int i = 0; i < 10; ++i) R = (0.5 * (R + R.inverse().transpose())).eval();
    scene::Matrix3 rows;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) rows[i][j] = R(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    return scene::print_matrix(rows);
  }
  /// Returns the refusal of a matrix that is not orthogonal; `off` is the largest entry of |RᵀR − Id|. The message
  /// recommends the nearest rotation if `off` is less than 0.1 and det R > 0.
  static Refusal refuses_rotation(const Eigen::Matrix3d& R, double off) {
    constexpr double near = 0.1;
    return {"Rigid body/Rotation", fmt::format("expected a rotation, R^T R = identity to 1e-8, got R^T R off by {}",
                                               scene::print_lower_bound(off)) +
                                       (off < near && R.determinant() > 0
                                            ? fmt::format("; the nearest rotation is \"{}\"", nearest_rotation_to(R))
                                            : "")};
  }

  std::optional<Refusal> refuses_points() const {
    constexpr const char* path = "Rigid body/Points";
    for (std::size_t k = 0; k < points.size(); k += n_point_columns)
      if (!(points[k + 3] > 0))
        return Refusal{path, fmt::format("expected masses > 0, got {} in row {}", scene::print_number(points[k + 3]),
                                         k / n_point_columns + 1)};
    return {};
  }

  /// Refuses an inertia that is not symmetric, and an inertia that no body with this mass and centre of mass has. Also
  /// refuses a singular inertia operator. In the constrained form, the function also refuses the inertia of a flat
  /// body, because its second moment is singular.
  std::optional<Refusal> refuses_inertia() const {
    constexpr double round_off = 1e-12;
    const char* const inertia_path = points.empty() ? "Rigid body/Inertia" : "Rigid body/Points";
    const Eigen::Matrix3d A = inertia_about_origin();
    const double size = A.cwiseAbs().maxCoeff();
    if ((A - A.transpose()).cwiseAbs().maxCoeff() > round_off * size)
      return Refusal{inertia_path, "expected a symmetric matrix, got one that is not"};
    const Eigen::Vector3d I = eigenvalues(A);
    const std::string moments = fmt::format("{:.15g}, {:.15g}, {:.15g}", I(0), I(1), I(2));
    if (!(I(0) > round_off * size))
      return Refusal{inertia_path, "expected positive principal moments of inertia, got " + moments};
    if (I(0) + I(1) < (1 - round_off) * I(2))
      return Refusal{inertia_path,
                     "expected principal moments of which none exceeds the sum of the two others, got " + moments};
    const auto [m, G, E0] = distribution();
    if (const double least = eigenvalues(E0 - m * G * G.transpose())(0); least < -round_off * size)
      return Refusal{inertia_path,
                     fmt::format("expected at least the inertia that the mass has at Center, got a second moment about "
                                 "Center of {:.6g}",
                                 least)};
    if (form == Form::constrained)
      if (auto status = FixedPointBody::accepts({E0, loads()}); !status) return Refusal{inertia_path, status.reason()};
    return {};
  }
  static Eigen::Vector3d eigenvalues(const Eigen::Matrix3d& A) { return mechanics::symmetric_spectrum(A).values; }

  /// Refuses a position or a velocity other than 0 for a body with a fixed point, and the springs that refuses_springs
  /// refuses.
  std::optional<Refusal> refuses_place() const {
    for (const auto& [path, x] : {std::pair("Rigid body/Position", &position), {"Rigid body/Velocity", &velocity}})
      if (!vector(*x).isZero(0))
        return Refusal{path, fmt::format("expected 0, 0, 0 where Fixed point = true, got {}", scene::print_row(*x))};
    return refuses_springs(Eigen::Vector3d::Zero());
  }
  /// Refuses a free body whose centre of mass is not its origin. Also refuses any springs in the forms of Euler and
  /// Lagrange, and the springs that refuses_springs refuses.
  std::optional<Refusal> refuses_free() const {
    if (!vector(center).isZero(0))
      return Refusal{
          "Rigid body/Center",
          fmt::format("expected 0, 0, 0 where Fixed point = false, which makes the centre of mass the origin "
                      "of the body, got {}",
                      scene::print_row(center))};
    if (form != Form::constrained && !springs.empty())
      return Refusal{"Rigid body/Springs",
                     fmt::format("expected none if Form = {} and Fixed point = false", form_kind.print(form)),
                     {{{"Rigid body/Form", "constrained"}}}};
    return refuses_springs(vector(position));
  }
  /// Refuses a negative stiffness or rest length, and a spring with a rest length whose initial length is 0. x is the
  /// initial position of the origin of the body.
  std::optional<Refusal> refuses_springs(const Eigen::Vector3d& x) const {
    std::size_t row = 0;
    for (const BodySpring& spring : loads().springs) {
      ++row;
      const auto& [k, l] = spring.law;
      if (k < 0 || l < 0)
        return Refusal{"Rigid body/Springs",
                       fmt::format("expected stiffness and rest length >= 0, got {} and {} in row "
                                   "{}",
                                   scene::print_number(k), scene::print_number(l), row)};
      if (l > 0 && (matrix(rotation) * spring.xi + x - spring.anchor).isZero(0))
        return Refusal{
            "Rigid body/Springs",
            fmt::format("expected two different ends of a spring with a rest length, got one place in row {}", row)};
    }
    return {};
  }
};

}  // namespace pseudorigid::systems
