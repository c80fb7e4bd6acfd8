#pragma once
/// Mass points in parameter files. There are n points with mutual attraction, springs, dashpots and external fields
/// (mass_points.h). The first point has the number 1. Point i has the mass m_i and the position q_i. G is the
/// gravitational constant, g the uniform field, and μ the strength of the attracting centre. A spring and the
/// confinement have stiffnesses k. Let q̄ be the centre of mass of the initial positions, and c the centre of forces.
/// Motions of any size are of order 1 in the scales
///
///   mass     M = Σ m_i
///   length   L = the largest of |q_i − q̄|, of |q_i − c| if c exerts forces, and of the rest lengths of springs
///   time     1/ω,  ω² = the largest of GM/L³, μ/L³, |g|/L, k(1/m_i + 1/m_j), k/m_i;  without forces ω = |v|/L
///
/// Here |v| is the largest initial speed. All of the lengths in L can be 0, for example for one point. Then L is |v|/ω
/// with the ω of springs and confinement, or |v|²/|g| without springs and confinement. If these formulas also give 0 or
/// are not defined, L is 1. If ω = 0, the unit of time is 1.

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "entries/entry_kinds.h"
#include "mechanics/equilibria/constrained_landscape.h"
#include "systems/mass_points.h"
#include "systems/system_scene.h"

namespace pseudorigid::systems {

struct MassPointsScene {
  static constexpr std::string_view name = "mass points", file = "mass_points", section = "Mass points";
  static constexpr std::string_view documentation =
      "Mass points in space with mutual gravitation, springs, dashpots and external fields.";
  static constexpr bool has_equilibria = true;

  std::vector<double> masses{0.5, 0.5};  // with the defaults below, two points that orbit each other in the time 2π
  std::vector<double> positions{0.5, 0, 0, -0.5, 0, 0}, velocities{0, 0.5, 0, 0, -0.5, 0};
  double gravitational_constant = 1;
  std::vector<double> springs, dashpots;  // rows (i, j, k, l) for springs, and (i, j, d) for dashpots
  std::vector<double> field{0, 0, 0}, center{0, 0, 0};
  double confinement = 0, central_attraction = 0, drag = 0;

  template <class Self, class Visit>
  static void visit(Self& s, Visit&& visit) {
    const scene::Number not_negative{.low = 0};
    visit(s.masses, scene::Numbers{.n = 0, .number = scene::positive},
          About{"Mass points/Masses", "mass", "Masses of the points, one for each point."});
    visit(s.positions, scene::Rows{3},
          About{"Mass points/Positions", "length", "Initial positions, one row (x, y, z) per point."});
    visit(s.velocities, scene::Rows{3},
          About{"Mass points/Velocities", "length/time", "Initial velocities, one row per point."});
    visit(s.gravitational_constant, not_negative,
          About{"Mass points/Gravitational constant", "length^3/mass/time^2",
                "G of the mutual attraction G m_i m_j / r^2; 0: none."});
    visit(s.springs, scene::Rows{4, true},
          About{"Mass points/Springs", "",
                "One row per spring: first point, second point, stiffness (mass/time^2), rest length (length). "
                "Points are numbered from 1."});
    visit(s.dashpots, scene::Rows{3, true},
          About{"Mass points/Dashpots", "",
                "One row per dashpot: first point, second point, damping (mass/time) of the rate of their distance."});
    visit(s.field, scene::Numbers{3}, About{"Mass points/Field", "length/time^2", "Acceleration of a uniform field."});
    visit(s.center, scene::Numbers{3},
          About{"Mass points/Center", "length",
                "Centre of Confinement and Central attraction; the angular momentum is taken about it."});
    visit(s.confinement, not_negative,
          About{"Mass points/Confinement", "mass/time^2", "Stiffness of a spring from each point to the center."});
    visit(s.central_attraction, not_negative,
          About{"Mass points/Central attraction", "length^3/time^2",
                "Attraction by the center: the acceleration is this number / r^2."});
    visit(s.drag, not_negative,
          About{"Mass points/Drag", "mass/time", "Force against the velocity of each point, per unit of velocity."});
  }
  /// Converts the rows of springs and dashpots to the given scales. The columns of a row have several units. Therefore
  /// in_scales does not convert the rows.
  void rescale(const Scales& scales) {
    for (std::size_t k = 0; k < springs.size(); k += 4) {
      springs[k + 2] /= scales("mass/time^2");
      springs[k + 3] /= scales("length");
    }
    for (std::size_t k = 0; k < dashpots.size(); k += 3) dashpots[k + 2] /= scales("mass/time");
  }

  Scales scales() const {
    const double M = vector(masses).sum(), g = vector(field).norm(),
                 speed = points(velocities).colwise().norm().maxCoeff();
    double L = spread(points(positions) * vector(masses) / M), omega_2 = 0;
    if (has_center()) L = std::max(L, spread(vector(center)));
    for (std::size_t k = 0; k < springs.size(); k += 4) {
      L = std::max(L, springs[k + 3]);
      omega_2 = std::max(omega_2, springs[k + 2] * (1 / mass(springs[k]) + 1 / mass(springs[k + 1])));
    }
    omega_2 = std::max(omega_2, confinement / vector(masses).minCoeff());
    if (L == 0 && speed > 0) L = omega_2 > 0 ? speed / std::sqrt(omega_2) : g > 0 ? speed * speed / g : 0;
    if (L == 0) L = 1;
    const double attraction = std::max(n() > 1 ? gravitational_constant * M : 0, central_attraction);
    omega_2 = std::max({omega_2, attraction / (L * L * L), g / L});
    const double omega = omega_2 > 0 ? std::sqrt(omega_2) : speed / L;
    return {L, M, omega > 0 ? 1 / omega : 1};
  }

  std::optional<Refusal> refuses() const {
    for (const auto& [path, rows] :
         {std::pair("Mass points/Positions", &positions), {"Mass points/Velocities", &velocities}})
      if (rows->size() != 3 * masses.size())
        return Refusal{path,
                       fmt::format("expected as many rows as there are masses, {}, got {}", n(), rows->size() / 3)};
    if (auto refusal = refuses_pairs("Mass points/Springs", "spring", springs, 4)) return refusal;
    if (auto refusal = refuses_pairs("Mass points/Dashpots", "dashpot", dashpots, 3)) return refusal;
    return refuses_places();
  }

  /// The columns for the points of the scene. The documentation uses the columns of the default scene, which has two
  /// points, as an example.
  std::vector<Column> columns() const {
    std::vector<Column> columns;
    add_point_columns(columns, "", "length", "position of point 1; every point i has its xi, yi, zi");
    add_point_columns(columns, "v", "length/time", "velocity of point 1; every point i has its vxi, vyi, vzi");
    const Unit energy = "mass*length^2/time^2", momentum = "mass*length/time";
    columns.insert(columns.end(), {{"kinetic", energy, "kinetic energy"},
                                   {"potential", energy, "potential energy of all forces that have one"},
                                   {"energy", energy, "their sum"},
                                   {"dissipated_power", "mass*length^2/time^3",
                                    "power lost to dashpots and drag: the rate at which the energy falls"}});
    add_components(columns, "P", momentum, "momentum, the sum of m v");
    add_components(columns, "L", "mass*length^2/time", "angular momentum about Center, the sum of m (q - c) x v");
    add_components(columns, "center_", "length", "centre of mass");
    return columns;
  }

  struct Model {
    using System = MassPoints;
    System system;
    mechanics::State<System> initial;
    std::vector<Column> coordinates_;

    mechanics::Status row(const mechanics::State<System>& state, System::Workspace&, std::vector<double>& row) const {
      const auto& [t, q, v] = state;
      const auto& p = system.parameters();
      const double K = system.kinetic_energy(v), V = system.potential_energy(q);
      const Eigen::Vector3d P = system.momentum(v), L = system.angular_momentum(q, v, p.center);
      const Eigen::Vector3d mean = q * p.masses / p.masses.sum();
      row.insert(row.end(), q.data(), q.data() + q.size());
      row.insert(row.end(), v.data(), v.data() + v.size());
      row.insert(row.end(), {K, V, K + V, system.dissipated_power(q, v)});
      for (const Eigen::Vector3d& a : {P, L, mean}) row.insert(row.end(), a.begin(), a.end());
      return {};
    }
    /// The rate of change of a state per unit of time (any_model.h), |v|/(1 + |q|) with the maximum norm. If the centre
    /// c does not exert forces, positions q and velocities v are relative to the centre of mass.
    double rate(const mechanics::State<System>& state) const {
      const auto& p = system.parameters();
      const bool has_center = p.confinement > 0 || p.central_attraction > 0;
      const auto size = [&](const Eigen::Matrix3Xd& x) {
        Eigen::Vector3d common = Eigen::Vector3d::Zero();
        if (!has_center) common = x * p.masses / p.masses.sum();
        return (x.colwise() - common).cwiseAbs().maxCoeff();
      };
      return size(state.v) / (1 + size(state.q));
    }
    auto landscape() const { return mechanics::ConstrainedLandscape<System>(system); }
    std::vector<Column> coordinates() const { return coordinates_; }
  };

  template <class Run>
  auto with_model(Run&& run) const {
    MassPoints::Parameters p{.masses = vector(masses),
                             .gravitational_constant = gravitational_constant,
                             .field = vector(field),
                             .center = vector(center),
                             .confinement = confinement,
                             .central_attraction = central_attraction,
                             .drag = drag};
    for (std::size_t k = 0; k < springs.size(); k += 4)
      p.springs.push_back({index(springs[k]), index(springs[k + 1]), {springs[k + 2], springs[k + 3]}});
    for (std::size_t k = 0; k < dashpots.size(); k += 3)
      p.dashpots.push_back({index(dashpots[k]), index(dashpots[k + 1]), dashpots[k + 2]});
    std::vector<Column> coordinates;
    add_point_columns(coordinates, "", "length", "");
    return run(Model{MassPoints(std::move(p)), {0, points(positions), points(velocities)}, std::move(coordinates)});
  }

 private:
  using Map = Eigen::Map<const Eigen::VectorXd>;
  static Map vector(const std::vector<double>& x) { return {x.data(), static_cast<Eigen::Index>(x.size())}; }
  static Eigen::Map<const Eigen::Matrix3Xd> points(const std::vector<double>& rows) {
    return {rows.data(), 3, static_cast<Eigen::Index>(rows.size() / 3)};
  }
  std::size_t n() const { return masses.size(); }
  /// The index of a point, from 0, for its number in a scene, which counts from 1.
  static int index(double number) { return static_cast<int>(number) - 1; }
  double mass(double number) const { return masses[static_cast<std::size_t>(index(number))]; }
  bool has_center() const { return confinement > 0 || central_attraction > 0; }
  /// The largest initial distance of a mass point from the point c.
  double spread(const Eigen::Vector3d& c) const {
    return (points(positions).colwise() - c).colwise().norm().maxCoeff();
  }
  bool at_one_place(int i, int j) const { return points(positions).col(i) == points(positions).col(j); }

  void add_point_columns(std::vector<Column>& columns, const std::string& prefix, Unit unit,
                         std::string_view of_first) const {
    for (std::size_t i = 1; i <= n(); ++i)
      for (const char* axis : {"x", "y", "z"})
        columns.push_back({fmt::format("{}{}{}", prefix, axis, i), unit, i == 1 ? of_first : "as for point 1"});
  }
  static void add_components(std::vector<Column>& columns, const std::string& prefix, Unit unit,
                             std::string_view documentation) {
    for (int k = 1; k <= 3; ++k) columns.push_back({fmt::format("{}{}", prefix, k), unit, documentation});
  }

  /// Refuses wrong rows of springs or dashpots. The first two numbers of a row must be the numbers of two different
  /// points, and the other numbers must not be negative.
  std::optional<Refusal> refuses_pairs(const char* path, const char* kind, const std::vector<double>& rows,
                                       std::size_t n_columns) const {
    for (std::size_t k = 0; k < rows.size(); k += n_columns) {
      const std::size_t row = k / n_columns + 1;
      for (std::size_t j = k; j < k + 2; ++j)
        if (!(rows[j] >= 1 && rows[j] <= static_cast<double>(n()) && rows[j] == std::floor(rows[j])))
          return Refusal{path, fmt::format("expected the numbers of two points, 1 to {}, got {} in row {}", n(),
                                           scene::print_number(rows[j]), row)};
      if (rows[k] == rows[k + 1])
        return Refusal{path, fmt::format("expected a {} between two different points, got point {} twice in row {}",
                                         kind, rows[k], row)};
      for (std::size_t j = k + 2; j < k + n_columns; ++j)
        if (rows[j] < 0)
          return Refusal{path, fmt::format("expected numbers >= 0 after the two points, got {} in row {}",
                                           scene::print_number(rows[j]), row)};
    }
    return {};
  }

  /// Refuses two points at one position if they attract each other or a spring with a rest length connects them. Also
  /// refuses a point at an attracting centre. In these cases the force does not have a direction or a finite size.
  std::optional<Refusal> refuses_places() const {
    const char* path = "Mass points/Positions";
    const auto coincide = [&](int i, int j, const char* act) {
      return Refusal{path, fmt::format("expected different places of points that {}, got points {} and {} at one place",
                                       act, i + 1, j + 1)};
    };
    for (int i = 0; i < static_cast<int>(n()); ++i) {
      if (central_attraction > 0 && points(positions).col(i) == vector(center))
        return Refusal{path, fmt::format("expected no point at the attracting center, got point {} there", i + 1)};
      for (int j = 0; j < i; ++j)
        if (gravitational_constant > 0 && at_one_place(i, j)) return coincide(j, i, "attract each other");
    }
    for (std::size_t k = 0; k < springs.size(); k += 4)
      if (springs[k + 3] > 0 && at_one_place(index(springs[k]), index(springs[k + 1])))
        return coincide(index(springs[k]), index(springs[k + 1]), "a spring with a rest length joins");
    return {};
  }
};

}  // namespace pseudorigid::systems
