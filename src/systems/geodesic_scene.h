#pragma once
/// Geodesics of surfaces (surfaces.h; Oliva, Geometric Mechanics, 5.3 with F = 0) in parameter files. The velocity q̇
/// of a geodesic satisfies
///
///   Dq̇/dt = 0,   |q̇| = const,   ⟨q̇, X⟩ = const for each vector field X whose flow preserves the metric
///
/// For example, X = ∂/∂φ on a surface of revolution gives Clairaut's constant ρ² φ̇ with the distance ρ from the axis.
/// A column contains ⟨q̇, X⟩ for the rotation X about the axis of the surface. On the hyperbolic half-plane, X is the
/// translation ∂/∂x. On an ellipsoid with semi-axes a ≠ b, the rotation about the third axis is not a symmetry, and
/// this number is not constant.
///
/// The coordinates of sphere and ellipsoid are angles, in which the metric is singular at the poles. The half-plane
/// ends at y = 0. If a geodesic reaches such a point, the run ends with a message.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "entries/entry_kinds.h"
#include "mechanics/core/chart_field.h"
#include "systems/surfaces.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

struct GeodesicScene {
  static constexpr std::string_view name = "geodesic", file = "geodesic", section = "Geodesic";
  static constexpr std::string_view documentation =
      "A geodesic of a surface: the motion of a free particle that is kept on it. A path that runs into a pole of the "
      "sphere or the ellipsoid, where their angles end, stops there with a report.";
  static constexpr bool has_equilibria = false;

  enum class Surface { sphere, torus, ellipsoid, paraboloid, hyperbolic_plane };
  static constexpr auto surface_kind = scene::choice<Surface>({{"sphere", Surface::sphere},
                                                               {"torus", Surface::torus},
                                                               {"ellipsoid", Surface::ellipsoid},
                                                               {"paraboloid", Surface::paraboloid},
                                                               {"hyperbolic plane", Surface::hyperbolic_plane}});

  Surface surface = Surface::sphere;
  double R = 3, r = 1, curvature = 1;
  std::vector<double> semi_axes{1, 1, 0.5}, point{1, 0}, velocity{0, 1};

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    visit(s.surface, surface_kind,
          About{"Geodesic/Surface", "",
                "With coordinates: sphere and ellipsoid, theta from the z axis and phi around it; torus about the x "
                "axis, w around the tube (0 outside) and u around the axis; paraboloid z = (curvature/2) (x^2 + y^2), "
                "x and y; hyperbolic plane, x and y > 0 of the half-plane with ds^2 = (dx^2 + dy^2)/y^2."});
    visit(s.R, scene::positive,
          About{"Geodesic/Radius", "length",
                "Radius of the sphere; of the torus, the distance from the axis to the middle of the tube."});
    visit(s.r, scene::positive,
          About{"Geodesic/Tube radius", "length", "Radius of the tube of the torus, less than Radius."});
    visit(s.semi_axes, scene::Numbers{3, scene::positive},
          About{"Geodesic/Semi-axes", "length",
                "Semi-axes of the ellipsoid along x, y, z. It is one of revolution if the first two are equal."});
    visit(s.curvature, scene::positive,
          About{"Geodesic/Curvature", "1/length", "Curvature of the paraboloid at its vertex."});
    visit(s.point, scene::Numbers{2},
          About{"Geodesic/Point", "",
                "Initial coordinates: angles in radians, on the paraboloid lengths, on the hyperbolic plane numbers."});
    visit(s.velocity, scene::Numbers{2},
          About{"Geodesic/Velocity", "1/time", "Initial rates of the coordinates, on the paraboloid length/time."});
  }

  /// The unit of length is size(). The unit of time is the reciprocal of the larger absolute value of the two initial
  /// rates of the coordinates. On the paraboloid, the rates are first divided by the unit of length. If the point is at
  /// rest, the unit of time is 1.
  Scales scales() const {
    const double rate = std::max(std::abs(velocity[0]), std::abs(velocity[1])) / coordinate_unit(size());
    return {size(), 1, rate > 0 ? 1 / rate : 1};
  }

  /// Divides the coordinates and rates of the paraboloid by the unit of length, because they are lengths. The function
  /// in_scales has divided `velocity` by the unit 1/time before.
  void rescale(const Scales& scales) {
    for (auto* coordinates : {&point, &velocity})
      for (double& x : *coordinates) x /= coordinate_unit(scales.length);
  }

  std::optional<Refusal> refuses() const {
    const bool has_poles = surface == Surface::sphere || surface == Surface::ellipsoid;
    if (has_poles && !(between_poles(point[0]) > 0))
      return Refusal{"Geodesic/Point", "expected theta between 0 and pi; the coordinates end at the poles"};
    if (surface == Surface::hyperbolic_plane && !(point[1] > 0))
      return Refusal{"Geodesic/Point", "expected y > 0, a point of the upper half-plane"};
    if (surface == Surface::torus && !(r < R))
      return Refusal{"Geodesic/Tube radius",
                     "expected a tube thinner than Geodesic/Radius; otherwise the torus meets itself"};
    return {};
  }

  std::vector<Column> columns() const {
    const bool lengths = surface == Surface::paraboloid, embedded = surface != Surface::hyperbolic_plane;
    std::vector<Column> columns{
        {"q1", lengths ? Unit("length") : Unit(), "first coordinate: theta, w or x"},
        {"q2", lengths ? Unit("length") : Unit(), "second coordinate: phi, u or y; full turns are counted"},
        {"q1_dot", lengths ? Unit("length/time") : Unit("1/time"), "rate of the first coordinate"},
        {"q2_dot", lengths ? Unit("length/time") : Unit("1/time"), "rate of the second coordinate"}};
    if (embedded)
      columns.insert(columns.end(), {{"x", "length", "position in space (not for the hyperbolic plane)"},
                                     {"y", "length", "position in space"},
                                     {"z", "length", "position in space"}});
    columns.push_back(
        {"speed", embedded ? Unit("length/time") : Unit("1/time"), "length of the velocity, constant on geodesics"});
    columns.push_back({"clairaut", embedded ? Unit("length^2/time") : Unit("1/time"),
                       "scalar product of the velocity with the rotation about the axis (hyperbolic plane: with the "
                       "translation along x), constant if that is a symmetry"});
    return columns;
  }

  /// The geodesic flow in a chart. The acceleration fails if the chart has a function `reserve` (surfaces.h) and its
  /// value is not positive. The point is then outside the chart, or its angle from a pole is at most √ε with the
  /// machine precision ε.
  template <class Chart>
  class Field : public mechanics::ChartField<Chart> {
   public:
    using Base = mechanics::ChartField<Chart>;
    using Base::Base;
    using typename Base::Vector, typename Base::Workspace;

    mechanics::Status acceleration(double t, const Vector& q, const Vector& v, Workspace& w, Vector& a) const {
      if (auto status = inside(this->chart(), q); !status) return status;
      return Base::acceleration(t, q, v, w, a);
    }
  };

  template <class Chart>
  struct Model {
    using System = Field<Chart>;
    System system;
    mechanics::State<System> initial;
    /// The angle w₀ of a torus (surfaces.h), or 0 for other surfaces. The output adds w₀ to the first coordinate of the
    /// chart.
    double origin = 0;

    mechanics::Status row(const mechanics::State<System>& state, typename System::Workspace&,
                          std::vector<double>& row) const {
      const Chart& chart = system.chart();
      row.insert(row.end(), {origin + state.q[0], state.q[1], state.v[0], state.v[1]});
      if constexpr (requires { chart.embedding(state.q); }) {
        const Eigen::Vector3d x = chart.embedding(state.q);
        row.insert(row.end(), x.begin(), x.end());
      }
      const Eigen::Vector2d momentum = mechanics::apply_mass(chart, state.q, state.v);
      row.push_back(std::sqrt(momentum.dot(state.v)));
      row.push_back(momentum.dot(symmetry(chart, state.q)));
      return {};
    }
  };

  template <class Run>
  auto with_model(Run&& run) const {
    const auto on = [&](const auto& chart, double origin = 0) {
      using Chart = std::decay_t<decltype(chart)>;
      return run(Model<Chart>{
          Field<Chart>(chart), {0, {point[0] - origin, point[1]}, Eigen::Vector2d(velocity.data())}, origin});
    };
    switch (surface) {
      case Surface::torus: {
        const TorusCircle circle(point[0]);
        return on(TorusSurface{R, r, circle.outward()}, circle.angle());
      }
      case Surface::ellipsoid:
        return on(Ellipsoid{semi_axes[0], semi_axes[1], semi_axes[2]});
      case Surface::paraboloid:
        return on(Paraboloid{curvature});
      case Surface::hyperbolic_plane:
        return on(HyperbolicHalfPlane{});
      case Surface::sphere:
        break;
    }
    return on(Sphere{R});
  }

 private:
  /// The unit of length. It is the radius of the sphere, the tube radius of the torus, or the largest semi-axis of the
  /// ellipsoid. For the paraboloid, it is the radius of curvature at the vertex. For the half-plane, it is 1.
  double size() const {
    switch (surface) {
      case Surface::torus:
        return r;
      case Surface::ellipsoid:
        return *std::max_element(semi_axes.begin(), semi_axes.end());
      case Surface::paraboloid:
        return 1 / curvature;
      case Surface::hyperbolic_plane:
        return 1;
      case Surface::sphere:
        break;
    }
    return R;
  }
  /// The unit of the coordinates: the unit of length `length` on the paraboloid, and 1 for angles and on the
  /// half-plane.
  double coordinate_unit(double length) const { return surface == Surface::paraboloid ? length : 1; }

  /// Fails if the function `reserve` of the chart (surfaces.h) is not positive at q. Never fails for a chart without
  /// this function.
  template <class Chart>
  static mechanics::Status inside(const Chart& chart, const Eigen::Vector2d& q) {
    if constexpr (requires { chart.reserve(q); })
      if (!(chart.reserve(q) > 0))
        return mechanics::Status::failure(std::is_same_v<Chart, HyperbolicHalfPlane>
                                              ? "the geodesic is nearer to the edge y = 0 than its tolerance"
                                              : "the geodesic runs into a pole, where the chart ends");
    return {};
  }

  /// The vector field X of the column `clairaut` (head of this file) at the point q.
  template <class Chart>
  static Eigen::Vector2d symmetry(const Chart&, const Eigen::Vector2d& q) {
    if constexpr (std::is_same_v<Chart, Paraboloid>) return {-q[1], q[0]};
    if constexpr (std::is_same_v<Chart, HyperbolicHalfPlane>) return Eigen::Vector2d::UnitX();
    return Eigen::Vector2d::UnitY();
  }
};

}  // namespace pseudorigid::systems
