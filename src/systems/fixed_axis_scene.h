#pragma once
/// The body with a fixed axis (fixed_axis.h, mass_distribution.h) in parameter files. The entry Weights adds mass
/// points that are fixed to the body. The columns include the forces of the two bearings. The scales are the mass m,
/// the length √(tr E₀/m) and the time 1/ω with
///
///   ω² = the larger of θ̇² at the start and m|g||G|/I_e, or 1 if both are zero.
///
/// Here θ is the angle about the axis, and g is the acceleration of gravity. In these formulas, the mass m, the centre
/// of mass G, the second moment E₀ and the moment of inertia I_e include the weights.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "entries/entry_kinds.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/equilibria/chart_landscape.h"
#include "systems/fixed_axis.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

struct FixedAxisScene {
  static constexpr std::string_view name = "fixed axis", file = "fixed_axis", section = "Fixed axis";
  static constexpr std::string_view documentation =
      "Rigid body that turns about a fixed axis in two bearings, with their forces.";
  static constexpr bool has_equilibria = true;

  double mass = 1;
  std::vector<double> center{0, 0, 0};
  scene::Matrix3 inertia{{{0.4, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}}};  // a homogeneous ball of mass 1 and radius 1
  std::vector<double> weights, axis{0, 0, 1}, bearings{-1, 1}, gravity{0, 0, 0};
  double friction = 0, angle = 0, rate = 1;

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    visit(s.mass, scene::positive, About{"Fixed axis/Mass", "mass", "Mass of the body without its weights."});
    visit(
        s.center, scene::Numbers{3},
        About{"Fixed axis/Center", "length", "Its centre of mass, from the origin of the body, which is on the axis."});
    visit(s.inertia, scene::Matrix{},
          About{"Fixed axis/Inertia", "mass*length^2",
                "Its inertia operator about the origin; the diagonal holds the moments of inertia."});
    visit(s.weights, scene::Rows{4, true},
          About{"Fixed axis/Weights", "",
                "Mass points that are fixed to the body: a row for each, its place in the body (3 numbers, length) and "
                "its mass."});
    visit(s.axis, scene::Numbers{3},
          About{"Fixed axis/Axis", "", "Direction of the axis, in the body and, as it is fixed, in space."});
    visit(
        s.bearings, scene::Numbers{2},
        About{
            "Fixed axis/Bearings", "length",
            "Places of the two bearings along the axis, from the origin. The first also carries the force along it."});
    visit(s.gravity, scene::Numbers{3},
          About{"Fixed axis/Gravity", "length/time^2",
                "Acceleration of gravity in space; at angle 0 the axes of the body are those of space."});
    visit(s.friction, scene::Number{.low = 0},
          About{"Fixed axis/Friction", "mass*length^2/time",
                "c of the torque of friction, -c times the rate of the angle."});
    visit(s.angle, scene::Number{}, About{"Fixed axis/Angle", "", "Initial angle about the axis, in radians."});
    visit(s.rate, scene::Number{}, About{"Fixed axis/Rate", "1/time", "Initial rate of the angle."});
  }
  /// Converts the rows of weights to the given scales. The columns of a row have several units. Therefore in_scales
  /// does not convert the rows.
  void rescale(const Scales& scales) {
    for (std::size_t k = 0; k < weights.size(); k += n_weight_columns) {
      for (std::size_t j : {0, 1, 2}) weights[k + j] /= scales("length");
      weights[k + 3] /= scales("mass");
    }
  }

  Scales scales() const {
    const FixedAxis s = system();
    const double I = s.moment_of_inertia(), weight = s.body.mass * s.gravity.norm() * s.body.center.norm();
    const double omega_2 = std::max(rate * rate, weight / I);
    return {std::sqrt(s.body.E0.trace() / s.body.mass), s.body.mass, omega_2 > 0 ? 1 / std::sqrt(omega_2) : 1};
  }

  std::optional<Refusal> refuses() const {
    for (std::size_t k = 0; k < weights.size(); k += n_weight_columns)
      if (!(weights[k + 3] > 0))
        return Refusal{"Fixed axis/Weights",
                       fmt::format("expected masses > 0, got {} in row {}", scene::print_number(weights[k + 3]),
                                   k / n_weight_columns + 1)};
    if (vector(axis).isZero(0)) return Refusal{"Fixed axis/Axis", "expected a direction, got zero"};
    if (bearings[0] == bearings[1])
      return Refusal{"Fixed axis/Bearings", "expected two different places, got one: it would not hold the axis"};
    return refuses_inertia();
  }

  std::vector<Column> columns() const {
    const Unit energy = "mass*length^2/time^2", force = "mass*length/time^2";
    std::vector<Column> columns{{"angle", "", "angle about the axis, radians; full turns are counted"},
                                {"rate", "1/time", "rate of the angle"},
                                {"kinetic", energy, "kinetic energy"},
                                {"potential", energy, "potential energy of the weight"},
                                {"energy", energy, "their sum"},
                                {"momentum", "mass*length^2/time", "angular momentum about the axis"},
                                {"dissipated_power", "mass*length^2/time^3", "rate at which friction takes energy"}};
    const auto add = [&](const char* letter, std::string_view documentation) {
      for (int i = 1; i <= 3; ++i) columns.push_back({fmt::format("{}{}", letter, i), force, documentation});
    };
    add("A", "force of the first bearing on the body, in space");
    add("B", "force of the second bearing on the body, in space");
    add("A_body", "force of the first bearing, in the body");
    add("B_body", "force of the second bearing, in the body");
    return columns;
  }

  struct Model {
    using System = mechanics::ChartField<FixedAxis>;
    System system;
    mechanics::State<System> initial;
    double first, second;  ///< positions a and b of the bearings along the axis

    mechanics::Status row(const mechanics::State<System>& state, System::Workspace& workspace,
                          std::vector<double>& row) const {
      const FixedAxis& chart = system.chart();
      FixedAxis::Angle acceleration;
      if (auto status = system.acceleration(state.t, state.q, state.v, workspace, acceleration); !status) return status;
      const double I = chart.moment_of_inertia(), rate = state.v[0], K = 0.5 * I * rate * rate,
                   V = chart.potential(state.q);
      row.insert(row.end(), {state.q[0], rate, K, V, K + V, I * rate, chart.friction * rate * rate});
      const auto [a, b] = bearing_forces(chart, first, second, state.q[0], rate, acceleration[0]);
      const Eigen::Matrix3d R = chart.rotation(state.q[0]);
      for (const Eigen::Vector3d& f : {Eigen::Vector3d(R * a), Eigen::Vector3d(R * b), a, b})
        row.insert(row.end(), f.begin(), f.end());
      return {};
    }
    auto landscape() const { return mechanics::ChartLandscape<FixedAxis>(system.chart()); }
    std::vector<Column> coordinates() const { return {{"angle", "", ""}}; }
  };

  template <class Run>
  auto with_model(Run&& run) const {
    return run(Model{mechanics::ChartField(system()),
                     {0, FixedAxis::Angle(angle), FixedAxis::Angle(rate)},
                     bearings[0],
                     bearings[1]});
  }

 private:
  static constexpr std::size_t n_weight_columns = 4;  ///< three coordinates and a mass

  static Eigen::Vector3d vector(const std::vector<double>& x) { return {x[0], x[1], x[2]}; }
  static Eigen::Matrix3d matrix(const scene::Matrix3& rows) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows[0].data());
  }
  /// The system of the body and of the mass points in `weights`, with the axis as a unit vector.
  FixedAxis system() const {
    MassDistribution body{mass, mass * vector(center), second_moment(matrix(inertia))};
    for (std::size_t k = 0; k < weights.size(); k += n_weight_columns) {
      const Eigen::Vector3d xi(weights[k], weights[k + 1], weights[k + 2]);
      body.mass += weights[k + 3];
      body.center += weights[k + 3] * xi;
      body.E0 += weights[k + 3] * xi * xi.transpose();
    }
    body.center /= body.mass;
    return {body, vector(axis).stableNormalized(), vector(gravity), friction};
  }
  /// Refuses an inertia that is not symmetric, and an inertia that no body with this mass and centre of mass has. Also
  /// refuses a moment of inertia about the axis that is zero up to round-off.
  std::optional<Refusal> refuses_inertia() const {
    constexpr const char* path = "Fixed axis/Inertia";
    constexpr double round_off = 1e-12;
    const Eigen::Matrix3d A = matrix(inertia);
    const double size = A.cwiseAbs().maxCoeff();
    if ((A - A.transpose()).cwiseAbs().maxCoeff() > round_off * size)
      return Refusal{path, "expected a symmetric matrix, got one that is not"};
    const Eigen::Vector3d G = vector(center);
    const Eigen::Matrix3d about_center = second_moment(A) - mass * G * G.transpose();
    const double least = mechanics::symmetric_spectrum(about_center).values[0];
    if (least < -round_off * size)
      return Refusal{path,
                     fmt::format("expected the inertia of a body with this mass and Center, whose principal moments "
                                 "obey the triangle inequality; got a second moment about Center of {:.6g}",
                                 least)};
    if (!(system().moment_of_inertia() > round_off * size))
      return Refusal{path, "expected a positive moment of inertia about the axis"};
    return {};
  }
};

}  // namespace pseudorigid::systems
