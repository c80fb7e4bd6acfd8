#pragma once
/// Geodesics of the Jacobi metric (mechanics/core/jacobi_metric.h; Oliva, Geometric Mechanics, 5.2) in parameter files.
/// For the energy h, the potential U and the metric g of the kinetic energy, the Jacobi metric is
///
///   g_h = 2(h − U) g.
///
/// The scene has one of four systems. The first two systems are a particle of unit mass in the plane, with U = ½k|q|²
/// or U = −μ/|q|. The third system is a heavy particle of unit mass on an upright torus. The fourth system is a double
/// pendulum whose first mass is 1. The arc length s̃ of the geodesic replaces the time of the scene. Time/End and the
/// column `time` are therefore arc lengths, with the unit length²/time.
///
/// By 5.2.1, the geodesics are the motions of energy h, and the arc length satisfies ds̃ = 2(h − U)dt. As a check, the
/// program also computes the motion from the same initial data. The integral ∫2(h − U)dt along this motion must equal
/// s̃.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <deque>
#include <type_traits>
#include <utility>
#include <vector>

#include "entries/entry_kinds.h"
#include "mechanics/core/jacobi_metric.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "systems/double_pendulum_chart.h"
#include "systems/system_scene.h"
#include "systems/torus.h"

namespace pseudorigid::systems {

/// The Euclidean plane with the coordinates x and y.
struct EuclideanPlane {
  static constexpr int dimension = 2;
  template <class T>
  Eigen::Matrix<T, 2, 2> metric(const mechanics::Coordinates<T, 2>&) const {
    Eigen::Matrix<T, 2, 2> g;
    g << T(1.0), T(0.0), T(0.0), T(1.0);
    return g;
  }
};
/// The potential U = ½k|q|² in the plane.
struct PlaneOscillator : EuclideanPlane {
  double k = 1;
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    return 0.5 * k * (q[0] * q[0] + q[1] * q[1]);
  }
};
/// The potential U = −μ/|q| in the plane.
struct PlaneKepler : EuclideanPlane {
  double mu = 1;
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    using std::sqrt;
    return -mu / sqrt(q[0] * q[0] + q[1] * q[1]);
  }
};

/// Computes the motion from given initial data at any later time. The steps do not depend on the requested times. A
/// resumed run therefore repeats the same motion. The last steps are stored, because a Poincaré section requests times
/// before the present time for its crossings. If a time is before the stored steps, the motion is computed again from
/// its start.
template <class Field>
class MotionFollower {
 public:
  using State = mechanics::State<Field>;

  MotionFollower(Field field, const State& start) : field_(std::move(field)), start_(start), ahead_(beginning()) {}

  /// Sets `out` to the state at the time t. Fails if a step of the motion or its interpolation fails.
  mechanics::Status at(double t, State& out) {
    if (t == start_.t) return out = start_, mechanics::Status();
    if (!steps_.empty() && t < steps_.front().workspace.t_start) {
      steps_.clear();
      ahead_ = beginning();
    }
    while (steps_.empty() || steps_.back().end.t < t)
      if (auto status = step(); !status) return status;
    const auto holds = [t](const Step& step) { return t <= step.end.t; };
    const auto within = std::find_if(steps_.begin(), steps_.end(), holds);
    return mechanics::DormandPrince8::interpolate(field_, t, out, within->workspace);
  }

 private:
  /// Tolerance of local errors, and the longest step in units of time. The tolerance is a tenth of the least value of
  /// Time/Tolerance.
  static constexpr double tolerance = 1e-14, longest_step = 10;
  static constexpr std::size_t n_kept = 64;  ///< number of stored steps

  struct Step {
    State end;
    mechanics::DormandPrince8Workspace<Field> workspace;
  };

  Step beginning() const { return {start_, mechanics::DormandPrince8Workspace<Field>(field_, tolerance)}; }

  mechanics::Status step() {
    auto& [state, workspace] = ahead_;
    if (auto status = mechanics::DormandPrince8::step(field_, state.t + longest_step, state, workspace); !status)
      return status;
    if (steps_.size() == n_kept) steps_.pop_front();
    steps_.push_back(ahead_);
    return {};
  }

  Field field_;
  State start_;
  Step ahead_;              ///< state and workspace before the next step
  std::deque<Step> steps_;  ///< the last `n_kept` steps in the order of time, with the data for interpolation
};

struct JacobiGeodesicScene {
  static constexpr std::string_view name = "jacobi geodesic", file = "jacobi_geodesic", section = "Jacobi geodesic";
  static constexpr std::string_view documentation =
      "The motion is a geodesic of the Jacobi metric 2(h - U) g of a particle of unit mass in the plane or on a torus, "
      "or of a double pendulum. Time/End and the column time are its arc, of the unit length^2/time; the time of the "
      "motion along it "
      "is "
      "the column t. On the torus and of the pendulum q1, q2 and their rates take the place of x, y, vx, vy, and there "
      "is no angular momentum.";
  static constexpr bool has_equilibria = false;

  enum class Potential { harmonic, kepler, torus, double_pendulum };
  static constexpr auto potential_kind = scene::choice<Potential>({{"harmonic", Potential::harmonic},
                                                                   {"kepler", Potential::kepler},
                                                                   {"torus", Potential::torus},
                                                                   {"double pendulum", Potential::double_pendulum}});

  Potential potential = Potential::kepler;
  double stiffness = 1, attraction = 1, gravity = 1, R = 3, r = 1, second_mass = 1, second_length = 1, energy = -0.5;
  std::vector<double> position{1, 0}, direction{0, 1};

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    visit(
        s.potential, potential_kind,
        About{"Jacobi geodesic/Potential", "",
              "Potential per unit mass. In the plane: harmonic, (Stiffness/2) |q|^2; kepler, -Attraction/|q|. torus: a "
              "heavy particle on an upright torus with Radius and Tube radius, as in System = torus. double pendulum: "
              "the first mass is 1, on a rod of the length Radius."});
    visit(s.stiffness, scene::positive,
          About{"Jacobi geodesic/Stiffness", "1/time^2", "Stiffness of the harmonic potential."});
    visit(s.attraction, scene::positive, About{"Jacobi geodesic/Attraction", "length^3/time^2", "Kepler's constant."});
    visit(s.gravity, scene::Number{.low = 0},
          About{"Jacobi geodesic/Gravity", "length/time^2", "Acceleration of gravity of torus and double pendulum."});
    visit(s.R, scene::positive,
          About{"Jacobi geodesic/Radius", "length",
                "The distance from the axis of the torus to the middle of its tube, or the length of the first rod of "
                "the double pendulum."});
    visit(s.r, scene::positive,
          About{"Jacobi geodesic/Tube radius", "length", "Radius of the tube of the torus, less than Radius."});
    visit(s.second_mass, scene::positive,
          About{"Jacobi geodesic/Second mass", "", "Lower mass of the double pendulum over the upper one."});
    visit(s.second_length, scene::positive,
          About{"Jacobi geodesic/Second length", "length", "Length of the lower rod of the double pendulum."});
    visit(s.energy, scene::Number{},
          About{"Jacobi geodesic/Energy", "length^2/time^2",
                "Energy h of the motions per unit mass; the metric exists only where U < h."});
    visit(s.position, scene::Numbers{2},
          About{"Jacobi geodesic/Position", "length",
                "Start of the geodesic. On the torus these are the angles w and u; for the double pendulum they are "
                "the angles of the rods from the downward vertical, in radians."});
    visit(
        s.direction, scene::Numbers{2},
        About{"Jacobi geodesic/Direction", "", "Initial direction; the speed of the motion follows from the energy."});
  }

  /// Corrects the units of a position that consists of angles: in_scales has divided the angles by the unit of length,
  /// and this function multiplies them by this unit.
  void rescale(const Scales& scales) {
    if (!in_plane())
      for (double& x : position) x *= scales.length;
  }

  /// The arc length s̃ of the Jacobi metric replaces the time of the scene, and has the dimension length²/time. Its
  /// unit is the unit of length times the initial speed.
  Scales scales() const { return {length(), 1, length() * speed()}; }

  std::optional<Refusal> refuses() const {
    if (potential == Potential::kepler && radius() == 0)
      return Refusal{"Jacobi geodesic/Position", "expected a place other than the centre, where U is infinite"};
    if (potential == Potential::torus && !(r < R))
      return Refusal{"Jacobi geodesic/Tube radius",
                     "expected a tube thinner than Jacobi geodesic/Radius; otherwise the torus meets itself"};
    if (!(energy > potential_energy()))
      return Refusal{"Jacobi geodesic/Energy", "expected an energy above the potential at Position, which is " +
                                                   scene::print_number(potential_energy()) +
                                                   "; the Jacobi metric exists where U < h only"};
    if (direction[0] == 0 && direction[1] == 0)
      return Refusal{"Jacobi geodesic/Direction", "expected a direction, got zero"};
    return {};
  }

  std::vector<Column> columns() const {
    std::vector<Column> columns{
        {"t", "time", "time of the motion along the geodesic; the column time is the arc, in length^2/time"}};
    if (in_plane())
      columns.insert(columns.end(), {{"x", "length", "position"},
                                     {"y", "length", "position"},
                                     {"vx", "length/time", "velocity of the motion, dq/dt"},
                                     {"vy", "length/time", "velocity of the motion"}});
    else
      columns.insert(columns.end(), {{"q1", "", "first angle, w or that of the upper rod"},
                                     {"q2", "", "second angle, u or that of the lower rod"},
                                     {"q1_dot", "1/time", "its rate along the motion"},
                                     {"q2_dot", "1/time", "as for q1_dot"}});
    columns.push_back({"energy", "length^2/time^2", "K + U along the geodesic, which is to be h"});
    if (in_plane()) columns.push_back({"angular_momentum", "length^2/time", "x vy - y vx"});
    columns.insert(columns.end(),
                   {{"jacobi_speed", "", "length of the geodesic's tangent in the Jacobi metric, which is to be 1"},
                    {"jacobi_length", "length^2/time",
                     "arc of the motion from the same initial data up to t, which is to be the column time"},
                    {"deviation", in_plane() ? Unit("length") : Unit(),
                     "distance of the geodesic from that motion at the same t, in the coordinates"}});
    return columns;
  }

  template <class Chart>
  struct Model {
    using System = mechanics::JacobiGeodesicField<Chart>;
    using Motion = mechanics::JacobiLengthField<Chart>;
    System system;
    mechanics::State<System> initial;
    Chart chart;
    double h;
    MotionFollower<Motion> motion;
    /// Factors that convert the columns from the units of the model to the scales of the scene.
    std::vector<double> units;

    mechanics::Status row(const mechanics::State<System>& state, typename System::Workspace&,
                          std::vector<double>& row) {
      const double t = state.q[2];
      mechanics::State<Motion> same{0, system.make_vector(), system.make_vector()};
      if (auto status = motion.at(t, same); !status) return status;
      const Eigen::Vector2d q = state.q.template head<2>(), tangent = state.v.template head<2>();
      const Eigen::Vector2d v = tangent / state.v[2];
      const double U = chart.potential(q), K = mechanics::kinetic_energy(chart, q, v);
      const std::size_t first = row.size();
      row.insert(row.end(), {t, q[0], q[1], v[0], v[1], K + U});
      if constexpr (std::is_base_of_v<EuclideanPlane, Chart>) row.push_back(q[0] * v[1] - q[1] * v[0]);
      row.insert(row.end(), {std::sqrt(4 * (h - U) * mechanics::kinetic_energy(chart, q, tangent)), same.q[2],
                             (q - same.q.template head<2>()).norm()});
      for (std::size_t i = 0; i < units.size(); ++i) row[first + i] *= units[i];
      return {};
    }
  };

  /// Calls run(model) and returns the result. In the scene, the unit of time is a unit of arc length. The model
  /// therefore has its own unit of time, in which the initial speed is of order 1.
  template <class Run>
  auto with_model(Run&& run) const {
    const Scales own{1, 1, length() / speed()};
    std::vector<double> units;
    for (const Column& column : columns()) units.push_back(own(column.unit));
    const JacobiGeodesicScene scaled = in_scales(*this, own);
    return scaled.with_chart([&](const auto& chart) { return run(scaled.model(chart, units)); });
  }

 private:
  bool in_plane() const { return potential == Potential::harmonic || potential == Potential::kepler; }

  template <class Use>
  auto with_chart(const Use& use) const {
    switch (potential) {
      case Potential::harmonic: {
        PlaneOscillator chart;
        chart.k = stiffness;
        return use(chart);
      }
      case Potential::torus: {
        Torus chart;
        chart.R = R;
        chart.r = r;
        chart.gravity = gravity;
        chart.c = 0;
        return use(chart);
      }
      case Potential::double_pendulum:
        return use(DoublePendulumChart{1, second_mass, R, second_length, gravity});
      case Potential::kepler:
        break;
    }
    PlaneKepler chart;
    chart.mu = attraction;
    return use(chart);
  }
  template <class Chart>
  Model<Chart> model(const Chart& chart, const std::vector<double>& units) const {
    const Eigen::Vector2d q(position.data()),
        along = Eigen::Vector2d(direction.data()).stableNormalized(),
        v = std::sqrt((energy - chart.potential(q)) / mechanics::kinetic_energy(chart, q, along)) * along;
    using Motion = mechanics::JacobiLengthField<Chart>;
    const mechanics::JacobiGeodesicField<Chart> field(chart, energy);
    mechanics::State<mechanics::JacobiGeodesicField<Chart>> geodesic{0, field.make_vector(), field.make_vector()};
    (void)field.start(q, v, geodesic.q, geodesic.v);  // h > U at the start, because the scene refuses other values
    const Motion motion(chart);
    mechanics::State<Motion> start{0, motion.make_vector(), motion.make_vector()};
    motion.start(q, v, start.q, start.v);
    return {field, geodesic, chart, energy, MotionFollower<Motion>(motion, start), units};
  }

  double radius() const { return Eigen::Vector2d(position.data()).stableNorm(); }
  double potential_energy() const {
    if (potential == Potential::harmonic) return 0.5 * stiffness * radius() * radius();
    if (potential == Potential::kepler) return -attraction / radius();
    return with_chart([&](const auto& chart) -> double { return chart.potential(Eigen::Vector2d(position.data())); });
  }
  /// The number √(2(h − U)) at the start. For a particle, this is the initial speed.
  double speed() const { return std::sqrt(2 * (energy - potential_energy())); }
  /// The unit of length. In the plane, it is the initial distance from the centre. If the particle starts at the
  /// centre, it is the amplitude of the harmonic motion. For the torus, the unit is the tube radius. For the double
  /// pendulum, it is the length of the first rod.
  double length() const {
    if (!in_plane()) return potential == Potential::torus ? r : R;
    return radius() > 0 ? radius() : std::sqrt(2 * energy / stiffness);
  }
};

}  // namespace pseudorigid::systems
