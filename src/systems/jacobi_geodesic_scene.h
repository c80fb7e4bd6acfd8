#pragma once
/// Geodesics of the Jacobi metric of a particle of unit mass in the plane (mechanics/core/jacobi_metric.h; Oliva,
/// Geometric Mechanics, 5.2) in parameter files,
///
///   g_h = 2(h − U) |dq|²,   U = ½k|q|²  or  −μ/|q|,
///
/// by their arc s̃, which takes the place of time in the scene, so Time/End and the column `time` are arcs, of the unit
/// length²/time. By 5.2.1 they are the motions of energy h with ds̃ = 2(h − U)dt: beside the geodesic runs the motion
/// from the same initial data, and with it ∫2(h − U)dt, which must be s̃ again.

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "entries/entry_kinds.h"
#include "mechanics/core/jacobi_metric.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

/// The Euclidean plane, charted by x and y.
struct EuclideanPlane {
  static constexpr int dimension = 2;
  template <class T>
  Eigen::Matrix<T, 2, 2> metric(const mechanics::Coordinates<T, 2>&) const {
    Eigen::Matrix<T, 2, 2> g;
    g << T(1.0), T(0.0), T(0.0), T(1.0);
    return g;
  }
};
/// U = ½k|q|²
struct PlaneOscillator : EuclideanPlane {
  double k = 1;
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    return 0.5 * k * (q[0] * q[0] + q[1] * q[1]);
  }
};
/// U = −μ/|q|
struct PlaneKepler : EuclideanPlane {
  double mu = 1;
  template <class T>
  T potential(const mechanics::Coordinates<T, 2>& q) const {
    using std::sqrt;
    return -mu / sqrt(q[0] * q[0] + q[1] * q[1]);
  }
};

/// The motion from given initial data at any later time, each not before the last one. The steps do not depend on the
/// times asked for, so a run that is taken up again sees the same motion.
template <class Field>
class MotionFollower {
 public:
  MotionFollower(Field field, const mechanics::State<Field>& start)
      : field_(std::move(field)), ahead_(start), workspace_(field_, tolerance) {}

  mechanics::Status at(double t, mechanics::State<Field>& out) {
    constexpr double longest_step = 10;
    if (t == 0 && ahead_.t == 0) return out = ahead_, mechanics::Status();
    while (ahead_.t < t)
      if (auto status = mechanics::DormandPrince8::step(field_, ahead_.t + longest_step, ahead_, workspace_); !status)
        return status;
    return mechanics::DormandPrince8::interpolate(field_, t, out, workspace_);
  }

 private:
  /// Local; what is left of it over some orbits is below any tolerance of a scene.
  static constexpr double tolerance = 1e-14;
  Field field_;
  mechanics::State<Field> ahead_;
  mechanics::DormandPrince8Workspace<Field> workspace_;
};

struct JacobiGeodesicScene {
  static constexpr std::string_view name = "jacobi geodesic", file = "jacobi_geodesic", section = "Jacobi geodesic";
  static constexpr std::string_view documentation =
      "A geodesic of the Jacobi metric 2(h - U)|dq|^2 of a particle of unit mass in the plane. Time/End and the column "
      "time are its arc, of the unit length^2/time; the time of the motion along it is the column t.";
  static constexpr bool has_equilibria = false;

  enum class Potential { harmonic, kepler };
  static constexpr scene::Choice<Potential, 2> potential_kind{
      {{{"harmonic", Potential::harmonic}, {"kepler", Potential::kepler}}}};

  Potential potential = Potential::kepler;
  double stiffness = 1, attraction = 1, energy = -0.5;
  std::vector<double> position{1, 0}, direction{0, 1};

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    visit(s.potential, potential_kind,
          About{"Jacobi geodesic/Potential", "",
                "Potential per unit mass. harmonic: (Stiffness/2) |q|^2. kepler: -Attraction/|q|."});
    visit(s.stiffness, scene::positive,
          About{"Jacobi geodesic/Stiffness", "1/time^2", "Stiffness of the harmonic potential."});
    visit(s.attraction, scene::positive, About{"Jacobi geodesic/Attraction", "length^3/time^2", "Kepler's constant."});
    visit(s.energy, scene::Number{},
          About{"Jacobi geodesic/Energy", "length^2/time^2",
                "Energy h of the motions per unit mass; the metric exists only where U < h."});
    visit(s.position, scene::Numbers{2}, About{"Jacobi geodesic/Position", "length", "Where the geodesic starts."});
    visit(
        s.direction, scene::Numbers{2},
        About{"Jacobi geodesic/Direction", "", "Initial direction; the speed of the motion follows from the energy."});
  }

  /// The scene's time being an arc, the unit of time is that of length²/time.
  Scales scales() const { return {length(), 1, length() * speed()}; }

  std::optional<Refusal> refuses() const {
    if (potential == Potential::kepler && radius() == 0)
      return Refusal{"Jacobi geodesic/Position", "expected a place other than the centre, where U is infinite"};
    if (!(energy > potential_energy()))
      return Refusal{"Jacobi geodesic/Energy", "expected an energy above the potential at Position, which is " +
                                                   scene::print_number(potential_energy()) +
                                                   "; the Jacobi metric exists where U < h only"};
    if (direction[0] == 0 && direction[1] == 0)
      return Refusal{"Jacobi geodesic/Direction", "expected a direction, got zero"};
    return {};
  }

  std::vector<Column> columns() const {
    return {{"t", "time", "time of the motion along the geodesic; the column time is the arc, in length^2/time"},
            {"x", "length", "position"},
            {"y", "length", "position"},
            {"vx", "length/time", "velocity of the motion, dq/dt"},
            {"vy", "length/time", "velocity of the motion"},
            {"energy", "length^2/time^2", "|v|^2/2 + U along the geodesic, which is to be h"},
            {"angular_momentum", "length^2/time", "x vy - y vx"},
            {"jacobi_speed", "", "length of the geodesic's tangent in the Jacobi metric, which is to be 1"},
            {"jacobi_length", "length^2/time",
             "arc of the motion from the same initial data up to t, which is to be the column time"},
            {"deviation", "length", "distance of the geodesic from that motion at the same t"}};
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
    std::vector<double> units;  ///< of the columns, in units of the arc for time

    mechanics::Status row(const mechanics::State<System>& state, typename System::Workspace&,
                          std::vector<double>& row) {
      const double t = state.q[2];
      mechanics::State<Motion> same{0, system.make_vector(), system.make_vector()};
      if (auto status = motion.at(t, same); !status) return status;
      const Eigen::Vector2d q = state.q.template head<2>(), tangent = state.v.template head<2>();
      const Eigen::Vector2d v = tangent / state.v[2];
      const double U = chart.potential(q);
      const std::size_t first = row.size();
      row.insert(row.end(),
                 {t, q[0], q[1], v[0], v[1], 0.5 * v.squaredNorm() + U, q[0] * v[1] - q[1] * v[0],
                  std::sqrt(2 * (h - U)) * tangent.norm(), same.q[2], (q - same.q.template head<2>()).norm()});
      for (std::size_t i = 0; i < units.size(); ++i) row[first + i] *= units[i];
      return {};
    }
  };

  /// The model has a unit of time of its own, in which the motion is of order 1.
  template <class Run>
  auto with_model(Run&& run) const {
    const Scales own{1, 1, length() / speed()};
    std::vector<double> units;
    for (const Column& column : columns()) units.push_back(own(column.unit));
    const JacobiGeodesicScene scaled = in_scales(*this, own);
    if (potential == Potential::harmonic) {
      PlaneOscillator chart;
      chart.k = scaled.stiffness;
      return run(scaled.model(chart, units));
    }
    PlaneKepler chart;
    chart.mu = scaled.attraction;
    return run(scaled.model(chart, units));
  }

 private:
  template <class Chart>
  Model<Chart> model(const Chart& chart, const std::vector<double>& units) const {
    const Eigen::Vector2d q(position.data()), v = speed() * Eigen::Vector2d(direction.data()).stableNormalized();
    using Motion = mechanics::JacobiLengthField<Chart>;
    const mechanics::JacobiGeodesicField<Chart> field(chart, energy);
    mechanics::State<mechanics::JacobiGeodesicField<Chart>> geodesic{0, field.make_vector(), field.make_vector()};
    (void)field.start(q, v, geodesic.q, geodesic.v);  // h > U there: the scene refuses what is not so
    const Motion motion(chart);
    mechanics::State<Motion> start{0, motion.make_vector(), motion.make_vector()};
    motion.start(q, v, start.q, start.v);
    return {field, geodesic, chart, energy, MotionFollower<Motion>(motion, start), units};
  }

  double radius() const { return Eigen::Vector2d(position.data()).stableNorm(); }
  double potential_energy() const {
    return potential == Potential::harmonic ? 0.5 * stiffness * radius() * radius() : -attraction / radius();
  }
  double speed() const { return std::sqrt(2 * (energy - potential_energy())); }
  /// The distance from the centre; of a start in the centre, the amplitude.
  double length() const { return radius() > 0 ? radius() : std::sqrt(2 * energy / stiffness); }
};

}  // namespace pseudorigid::systems
