#pragma once
/// The heavy particle of unit mass on a rough torus (torus.h; Oliva, Geometric Mechanics, 5.8.8) in parameter files.
/// The metric is r² dw² + (R + r cos w)² du². The potential is V = g ⟨q, up⟩ with the upward unit vector `up`. The
/// damping D(v) and the energy E satisfy
///
///   dE/dt = ⟨D(v), v⟩,   E(t) + k ≥ (E(0) + k) e^{−2μt} for t > 0, ≤ for t < 0                               (5.8.9)
///
/// with the greatest damping μ and k = −min V. Every motion therefore has bounded energy in finite time, and exists for
/// all time. With gravity, V has four critical points with the Morse indices 0, 1, 1, 2, except for a tilt of a right
/// angle.
///
/// The first coordinate of the motion is w − w₀. Here w₀ = 0 or π (modulo 2π) is the symmetric circle that is nearest
/// to the start (surfaces.h). Entries and columns contain w itself, which is 0 on the outer circle of the torus.

#include <algorithm>
#include <cmath>
#include <limits>

#include "entries/entry_kinds.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/equilibria/chart_landscape.h"
#include "systems/system_scene.h"
#include "systems/torus.h"

namespace pseudorigid::systems {

struct TorusScene {
  static constexpr std::string_view name = "torus", file = "torus", section = "Torus";
  static constexpr std::string_view documentation =
      "A heavy particle of unit mass moves on a rough torus about the horizontal x axis, with friction in proportion "
      "to its velocity. It is a strongly dissipative system with one sink, two saddles and one source.";
  static constexpr bool has_equilibria = true, complete = true;

  double R = 3, r = 1, gravity = 1, damping = 1, grain = 0, grain_angle = 0, tilt = 0;
  std::vector<double> variation{0, 0};
  std::vector<double> angles{0.1, 0.2}, rates{0, 0};

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    visit(s.R, scene::positive, About{"Torus/Radius", "length", "Distance R from the axis to the middle of the tube."});
    visit(s.r, scene::positive, About{"Torus/Tube radius", "length", "Radius r of the tube, less than Radius."});
    visit(s.gravity, scene::Number{.low = 0}, About{"Torus/Gravity", "length/time^2", "Acceleration of gravity."});
    visit(
        s.damping, scene::Number{.low = 0},
        About{"Torus/Damping", "1/time",
              "Friction c: the force on the particle is -c times its velocity, but for the two entries that follow."});
    visit(
        s.variation, scene::Numbers{2},
        About{"Torus/Damping variation", "",
              "Two numbers a, b with |a| + |b| < 1, by which the friction changes from place to place: c (1 + a cos w "
              "+ b cos u)."});
    visit(s.grain, scene::not_negative,
          About{"Torus/Grain", "",
                "How much more the surface brakes along its grain: there the friction is c (1 + Grain)."});
    visit(
        s.grain_angle, scene::Number{},
        About{"Torus/Grain angle", "",
              "Angle in radians from the circle around the tube (rising w) to the grain (a quarter turn: rising u). A "
              "grain that is oblique breaks the orbit that joins the saddles, as Tilt does."});
    visit(s.tilt, scene::Number{},
          About{"Torus/Tilt", "",
                "Angle in radians by which the vertical leans out of the plane of the ring, towards the axis. "
                "Without tilt the two saddles are joined by an orbit."});
    visit(s.angles, scene::Numbers{2},
          About{"Torus/Angles", "",
                "Initial angles w, u in radians: w around the tube, 0 outside; u around the axis, 0 at the top."});
    visit(s.rates, scene::Numbers{2}, About{"Torus/Rates", "1/time", "Initial rates of the angles."});
  }

  /// The unit of length is the tube radius r, and the unit of mass is 1. Let g be the acceleration of gravity. The unit
  /// of time is the smaller of √(r/g) and the reciprocal of the largest absolute value of an initial rate. Without
  /// gravity and at rest, it is 1.
  Scales scales() const {
    const double rate = std::max({std::sqrt(gravity / r), std::abs(rates[0]), std::abs(rates[1])});
    return {r, 1, rate > 0 ? 1 / rate : 1};
  }

  std::optional<Refusal> refuses() const {
    if (!(r < R))
      return Refusal{"Torus/Tube radius",
                     "expected a tube thinner than Torus/Radius; otherwise the torus meets itself"};
    if (!(std::abs(variation[0]) + std::abs(variation[1]) < 1))
      return Refusal{"Torus/Damping variation",
                     "expected numbers whose absolute values add up to less than 1; otherwise the friction drives"};
    return {};
  }

  std::vector<Column> columns() const {
    return {{"w", "", "angle around the tube, radians, 0 outside; full turns are counted"},
            {"u", "", "angle around the axis, 0 at the top; full turns are counted"},
            {"w_dot", "1/time", "rate of w"},
            {"u_dot", "1/time", "rate of u"},
            {"x", "length", "position along the axis of the torus"},
            {"y", "length", "position across"},
            {"z", "length", "position in the plane of the ring, upwards; vertical without Tilt"},
            {"kinetic", "length^2/time^2", "kinetic energy per unit mass"},
            {"potential", "length^2/time^2", "potential energy per unit mass"},
            {"energy", "length^2/time^2", "their sum"},
            {"dissipated_power", "length^2/time^3", "rate at which friction dissipates energy, per unit mass"},
            {"energy_bound", "length^2/time^2",
             "bound of the energy by the greatest friction (5.8.9): the energy is not less at later times than the "
             "start, and not more at earlier ones"}};
  }

  struct Model {
    using System = mechanics::ChartField<Torus>;
    System system;
    mechanics::State<System> initial;
    TorusCircle circle;

    mechanics::Status row(const mechanics::State<System>& state, System::Workspace&, std::vector<double>& row) const {
      const Torus& torus = system.chart();
      const Eigen::Vector3d x = torus.embedding(state.q);
      const double K = mechanics::kinetic_energy(torus, state.q, state.v), V = torus.potential(state.q);
      const Eigen::Vector2d D = torus.dissipation(state.q, state.v);
      const double E0 = system.energy(initial.q, initial.v), k = torus.depth();
      row.insert(row.end(), {circle.angle() + state.q[0], state.q[1], state.v[0], state.v[1], x[0], x[1], x[2], K, V,
                             K + V, -D.dot(mechanics::apply_mass(torus, state.q, state.v)),
                             std::min((E0 + k) * std::exp(-2 * torus.greatest_damping() * state.t) - k,
                                      std::numeric_limits<double>::max())});
      return {};
    }
    /// The potential landscape in the coordinates (w, u). It does not depend on the circle w₀ of the motion.
    auto landscape() const {
      Torus torus = system.chart();
      torus.outward = 1;
      return mechanics::ChartLandscape<Torus>(torus);
    }
    std::vector<Column> coordinates() const { return {{"w", "", ""}, {"u", "", ""}}; }
    /// The model at rest at the point q = (w, u) of the landscape, with the circle w₀ nearest to this point.
    Model resting_at(const Eigen::VectorXd& q) const {
      const TorusCircle nearest(q[0]);
      Torus torus = system.chart();
      torus.outward = nearest.outward();
      return {mechanics::ChartField(torus), {0, {q[0] - nearest.angle(), q[1]}, Eigen::Vector2d::Zero()}, nearest};
    }
  };

  template <class Run>
  auto with_model(Run&& run) const {
    const TorusCircle circle(angles[0]);
    const Torus torus{{R, r, circle.outward()}, gravity, damping, tilt, variation[0], variation[1], grain, grain_angle};
    return run(Model{mechanics::ChartField(torus),
                     {0, {angles[0] - circle.angle(), angles[1]}, Eigen::Vector2d(rates.data())},
                     circle});
  }
};

}  // namespace pseudorigid::systems
