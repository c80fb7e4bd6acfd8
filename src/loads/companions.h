#pragma once
/// Point masses in orbit about the body (mechanics/core/orbit.h). The tidal force of each companion acts on the body.
/// The gravity of the body and of the other companions acts on each companion.

#include <algorithm>
#include <optional>

#include "loads/load.h"

namespace pseudorigid::loads {

struct CompanionMasses {
  /// The mass m_i of each companion, and its position r_i and velocity ṙ_i at the start. Positions and velocities are
  /// relative to the centre of mass of the body, with three numbers for each companion. Without velocities, the orbits
  /// are circular about the z axis.
  std::vector<double> masses, positions, velocities;
  /// Orbital elements at the start in place of r_i and ṙ_i, with angles in radians. Companion i is in orbit about the
  /// centre of mass of the body and of the companions before i. Each list has a number for each companion. A list other
  /// than that of the semi-major axes may be empty, and its elements are then 0.
  std::vector<double> semi_major_axes, eccentricities, inclinations, ascending_nodes, arguments_of_pericentre,
      mean_anomalies;
  bool full_potential = false;  ///< true if finite elements use the whole potential, not its expansion to degree 2

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(self.masses, scene::Rows{1, true},
          scene::About{"Companions/Masses", "mass",
                       "Masses of one or two companions, separated by ';'. A companion is a point mass. It acts on the "
                       "body by its gravity, to degree 2 in the size of the body, and the body acts on it in the same "
                       "way. The constant of gravity is that of the body."});
    visit(self.positions, scene::Rows{3, true},
          scene::About{"Companions/Positions", "length",
                       "Position of each companion at the start, relative to the centre of mass of the body, a row "
                       "each. Initial state/Center and the columns x and v are the common centre of mass then."});
    visit(
        self.velocities, scene::Rows{3, true},
        scene::About{"Companions/Velocities", "length/time",
                     "Velocity of each companion at the start, relative to the centre of mass of the body, a row each. "
                     "Without rows, each companion has the circular orbit of point masses about the z axis. The "
                     "centre of this orbit is the centre of mass of the body and the companions before it."});
    visit(self.semi_major_axes, scene::Rows{1, true},
          scene::About{
              "Companions/Semi-major axes", "length",
              "Orbital elements in place of positions and velocities, a row for each companion: the semi-major "
              "axis, negative for a hyperbola. The elements are those of a Kepler orbit about the centre of mass of "
              "the body and the companions before. It has the sum of all these masses. Elements without rows "
              "are 0."});
    visit(self.eccentricities, scene::Rows{1, true},
          scene::About{"Companions/Eccentricities", "",
                       "Eccentricities: from 0 to less than 1, or more than 1 for a hyperbola."});
    visit(self.inclinations, scene::Rows{1, true},
          scene::About{"Companions/Inclinations", "",
                       "Inclinations of the orbits to the plane z = 0, in radians, as all angles."});
    visit(self.ascending_nodes, scene::Rows{1, true},
          scene::About{"Companions/Ascending nodes", "", "Longitudes of the ascending nodes, from the x axis."});
    visit(self.arguments_of_pericentre, scene::Rows{1, true},
          scene::About{"Companions/Arguments of pericentre", "", "Angles from the ascending node to the pericentre."});
    visit(self.mean_anomalies, scene::Rows{1, true},
          scene::About{
              "Companions/Mean anomalies", "",
              "Mean anomalies at the start, 0 at the pericentre. A hyperbola with the eccentricity e has the mean "
              "anomaly e sinh H - H."});
    visit(self.full_potential, scene::Boolean{},
          scene::About{"Companions/Full potential", "",
                       "true: the finite-element model has the whole potential of each companion, as a sum over its "
                       "nodes. Other models have its second degree."});
  }

  static constexpr std::string_view no_equilibria = "no body is looked for in equilibrium with a companion";
  static constexpr bool has_static_equilibria = false;
  static constexpr std::string_view skipped = "companions: Companions/Masses is empty; no orbit";
  std::string needed(const BodyFacts&) const {
    return "companions in orbit, and their tides: " + std::to_string(masses.size());
  }
  bool is_present() const { return !masses.empty(); }

  bool has_elements() const { return !semi_major_axes.empty(); }

  /// Returns a Forcing with the companions. If there are semi-major axes, the elements determine the orbits, and the
  /// positions are not used. A companion without a semi-major axis, or without a position if there are no elements, is
  /// omitted here; scene/companions.h rejects scenes with such companions.
  Forcing forcing() const {
    Forcing sum;
    sum.companions.full_potential = full_potential;
    const std::size_t n_orbits = has_elements() ? semi_major_axes.size() : positions.size() / 3;
    for (std::size_t i = 0; i < std::min(masses.size(), n_orbits); ++i) {
      mechanics::Companion companion{.mass = masses[i]};
      if (has_elements())
        companion.elements = elements(i);
      else
        companion.position = row(positions, i);
      if (3 * i + 2 < velocities.size()) companion.velocity = row(velocities, i);
      sum.companions.push_back(companion);
    }
    return sum;
  }

  /// Returns the reason why x_i = 0 is not a plane of symmetry: a clause about the first companion that leaves this
  /// plane. Empty if no companion leaves the plane.
  std::optional<std::string> breaks_plane(int i) const {
    const mechanics::Companions list = forcing().companions;
    for (std::size_t j = 0; j < list.size(); ++j) {
      const auto& elements = list[j].elements;
      if (elements && (i < 2 || elements->inclination != 0)) return leaves(j);
      if (elements) continue;
      const bool moves_across = list[j].velocity ? (*list[j].velocity)[i] != 0 : i < 2;
      if (list[j].position[i] != 0 || moves_across) return leaves(j);
    }
    return std::nullopt;
  }

 private:
  static std::string leaves(std::size_t j) { return "companion " + std::to_string(j + 1) + " leaves this plane"; }
  mechanics::KeplerElements elements(std::size_t i) const {
    const auto of = [i](const std::vector<double>& list) { return i < list.size() ? list[i] : 0; };
    return {of(semi_major_axes), of(eccentricities),          of(inclinations),
            of(ascending_nodes), of(arguments_of_pericentre), of(mean_anomalies)};
  }
  static Eigen::Vector3d row(const std::vector<double>& numbers, std::size_t i) {
    return {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  }
};

}  // namespace pseudorigid::loads
