#pragma once
/// The planar double pendulum in parameter files. The multiplier form (double_pendulum.h) and the Lagrange form
/// (double_pendulum_chart.h) give the same motion. The columns contain the tensions T_k = −λ_k / l_k of the rods, with
/// the lengths l_k and the multipliers λ_k. They also contain the reactions R₁ and R₂ of the rods on the points (5.43).
/// The reactions are computed from the second fundamental form, without multipliers.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "entries/entry_kinds.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/core/second_fundamental_form.h"
#include "mechanics/equilibria/chart_landscape.h"
#include "mechanics/equilibria/constrained_landscape.h"
#include "systems/double_pendulum.h"
#include "systems/double_pendulum_chart.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

struct DoublePendulumScene {
  static constexpr std::string_view name = "double pendulum", file = "double_pendulum", section = "Double pendulum";
  static constexpr std::string_view documentation =
      "Planar double pendulum (two heavy points on massless rods), y pointing down, angles from the downward vertical.";
  static constexpr bool has_equilibria = true, complete = true;

  enum class Form { multiplier, lagrange };
  static constexpr auto form_kind =
      scene::choice<Form>({{"multiplier", Form::multiplier}, {"lagrange", Form::lagrange}});

  Form form = Form::multiplier;
  double m1 = 1, m2 = 1, l1 = 1, l2 = 1, gravity = 9.81;
  std::vector<double> angles{0.5, 0.3}, rates{0, 0};

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    visit(s.form, form_kind,
          About{"Double pendulum/Form", "",
                "multiplier: positions with two constraints and their reactions. lagrange: angles, a chart with the "
                "metric of the kinetic energy."});
    visit(s.m1, scene::positive, About{"Double pendulum/First mass", "mass", "Mass of the upper point."});
    visit(s.m2, scene::positive, About{"Double pendulum/Second mass", "mass", "Mass of the lower point."});
    visit(s.l1, scene::positive, About{"Double pendulum/First length", "length", "Length of the upper rod."});
    visit(s.l2, scene::positive, About{"Double pendulum/Second length", "length", "Length of the lower rod."});
    visit(s.gravity, scene::Number{.low = 0},
          About{"Double pendulum/Gravity", "length/time^2", "Acceleration of gravity."});
    visit(s.angles, scene::Numbers{2},
          About{"Double pendulum/Angles", "", "Initial angles of the rods from the downward vertical, in radians."});
    visit(s.rates, scene::Numbers{2}, About{"Double pendulum/Rates", "1/time", "Initial rates of the angles."});
  }

  /// The unit of length is the length l₁ of the upper rod, and the unit of mass is the mass m₁ of the upper point. The
  /// unit of time is the smaller of two times. The first time is √(l/g) with the length l of the shorter rod and the
  /// acceleration of gravity g. The second time is the reciprocal of the largest absolute value of an initial rate.
  /// Without gravity and at rest, it is 1.
  Scales scales() const {
    const double rate = std::max({std::sqrt(gravity / std::min(l1, l2)), std::abs(rates[0]), std::abs(rates[1])});
    return {l1, m1, rate > 0 ? 1 / rate : 1};
  }
  std::optional<Refusal> refuses() const { return {}; }

  std::vector<Column> columns() const {
    return {{"theta", "", "angle of the upper rod from the downward vertical, radians, -pi to pi"},
            {"phi", "", "angle of the lower rod from the downward vertical, radians, -pi to pi"},
            {"theta_dot", "1/time", "rate of theta"},
            {"phi_dot", "1/time", "rate of phi"},
            {"x1", "length", "position of the upper point, horizontal"},
            {"y1", "length", "position of the upper point, downwards"},
            {"x2", "length", "position of the lower point, horizontal"},
            {"y2", "length", "position of the lower point, downwards"},
            {"kinetic", "mass*length^2/time^2", "kinetic energy"},
            {"potential", "mass*length^2/time^2", "potential energy"},
            {"energy", "mass*length^2/time^2", "their sum"},
            {"tension1", "mass*length/time^2", "force along the upper rod, positive if it pulls"},
            {"tension2", "mass*length/time^2", "force along the lower rod"},
            {"R1x", "mass*length/time^2",
             "reaction of the rods on the upper point by the second fundamental form (5.29), without multipliers, "
             "horizontal"},
            {"R1y", "mass*length/time^2", "as for R1x, downwards"},
            {"R2x", "mass*length/time^2", "reaction on the lower point, horizontal"},
            {"R2y", "mass*length/time^2", "as for R2x, downwards"}};
  }

  DoublePendulum::Parameters parameters() const { return {m1, m2, l1, l2, gravity}; }

  /// The function `append` appends the values of the columns for a state in multiplier form. It fails if the
  /// multipliers cannot be computed.
  struct Observer {
    DoublePendulum pendulum;

    mechanics::Status append(const mechanics::State<DoublePendulum>& state, std::vector<double>& row) const {
      Eigen::Vector2d angles, rates, lambda = Eigen::Vector2d::Zero();
      pendulum.to_angles(state.q, state.v, angles, rates);
      DoublePendulum::Workspace workspace;
      if (auto status = mechanics::multiplier_of_motion(pendulum, state, workspace, lambda); !status) return status;
      const auto& p = pendulum.parameters();
      const double K = pendulum.kinetic_energy(state.v), U = pendulum.potential_energy(state.q);
      row.insert(row.end(), {angles[0], angles[1], rates[0], rates[1]});
      row.insert(row.end(), state.q.begin(), state.q.end());
      row.insert(row.end(), {K, U, K + U, -lambda[0] / p.l1, -lambda[1] / p.l2});
      const Eigen::Vector4d R = reactions(state, rates);
      row.insert(row.end(), R.begin(), R.end());
      return {};
    }

   private:
    /// The reactions (R₁, R₂). Let X = (q₁, q₂) be the positions as functions of the angles θ and φ. Then ∂X/∂θ =
    /// (l₁e_θ, l₁e_θ) and ∂X/∂φ = (0, l₂e_φ), with unit vectors e_θ, e_φ perpendicular to the rods. The second
    /// derivative along the rates of the angles is −(θ̇²q₁, θ̇²q₁ + φ̇²(q₂ − q₁)).
    Eigen::Vector4d reactions(const mechanics::State<DoublePendulum>& state, const Eigen::Vector2d& rates) const {
      const auto& p = pendulum.parameters();
      const Eigen::Vector2d upper = state.q.head<2>(), rod = state.q.tail<2>() - upper;
      Eigen::Matrix<double, 4, 2> tangents;
      tangents.col(0) << upper.y(), -upper.x(), upper.y(), -upper.x();
      tangents.col(1) << 0, 0, rod.y(), -rod.x();
      Eigen::Vector4d second;
      second << -rates[0] * rates[0] * upper, -rates[0] * rates[0] * upper - rates[1] * rates[1] * rod;
      return mechanics::reaction_by_second_fundamental_form<4, 2>(tangents, second, {p.m1, p.m1, p.m2, p.m2},
                                                                  {0, p.m1 * p.g, 0, p.m2 * p.g});
    }
  };

  /// The model in multiplier form, whose state is (q, q̇).
  struct MultiplierModel {
    using System = DoublePendulum;
    System system;
    mechanics::State<System> initial;
    Observer observer;

    mechanics::Status row(const mechanics::State<System>& state, System::Workspace&, std::vector<double>& row) const {
      return observer.append(state, row);
    }
    auto landscape() const { return mechanics::ConstrainedLandscape<System>(system); }
    std::vector<Column> coordinates() const {
      return {{"x1", "length", ""}, {"y1", "length", ""}, {"x2", "length", ""}, {"y2", "length", ""}};
    }
  };

  /// The model in Lagrange form, whose state has the angles and their rates. `row` converts this state to the
  /// multiplier form.
  struct LagrangeModel {
    using System = mechanics::ChartField<DoublePendulumChart>;
    System system;
    mechanics::State<System> initial;
    Observer observer;

    mechanics::Status row(const mechanics::State<System>& state, System::Workspace&, std::vector<double>& row) const {
      mechanics::State<DoublePendulum> points{state.t, {}, {}};
      observer.pendulum.from_angles(state.q, state.v, points.q, points.v);
      return observer.append(points, row);
    }
    auto landscape() const { return mechanics::ChartLandscape<DoublePendulumChart>(system.chart()); }
    std::vector<Column> coordinates() const { return {{"theta", "", ""}, {"phi", "", ""}}; }
  };

  template <class Run>
  auto with_model(Run&& run) const {
    const Eigen::Vector2d at(angles[0], angles[1]), rate(rates[0], rates[1]);
    const Observer observer{DoublePendulum(parameters())};
    if (form == Form::lagrange)
      return run(
          LagrangeModel{mechanics::ChartField(DoublePendulumChart{m1, m2, l1, l2, gravity}), {0, at, rate}, observer});
    MultiplierModel model{observer.pendulum, {}, observer};
    observer.pendulum.from_angles(at, rate, model.initial.q, model.initial.v);
    return run(std::move(model));
  }
};

}  // namespace pseudorigid::systems
