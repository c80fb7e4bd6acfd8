#pragma once
/// The part of a parameter file that a system defines: its subsection with entries, the columns of its CSV file, its
/// units, and its model. A new system needs one header with a struct such as PendulumScene, and one line in
/// systems/table.cpp.
///
///     struct PendulumScene {
///       static constexpr std::string_view name, file, section, documentation;   // as in scene::SystemDescription
///       static constexpr bool has_equilibria;                             // true if the model has a landscape
///       double length = 1; …                                              // entries with their defaults
///       template <class Self, class Visit> static void visit(Self& self, Visit&& visit);   // calls visit per entry
///       Scales scales() const;                                            // units in which the motion is of order 1
///       void rescale(const Scales& scales);                               // optional: converts rows of several units
///       std::optional<Refusal> refuses() const;                           // the error, in the units of the user
///       static constexpr bool complete;                                   // optional: motions exist for all time
///       std::vector<Column> columns() const;                              // columns of its file after `time`
///       template <class Run> auto with_model(Run&& run) const;            // calls run(model), in the scene's scales
///     };
///
/// Units are texts such as "mass*length^2/time" (entries/unit.h). Before the model is constructed, the entries are
/// divided by their units. Before the columns are written to the file, their values are multiplied by their units. The
/// model therefore never contains the units of the user.
///
///   struct Model {
///     System system;  State<System> initial;
///     Status row(state, workspace, std::vector<double>& row);           // appends the values of the columns
///     double rate(state) const;                                         // optional, default |v|/(1 + |q|)
///     auto landscape() const;                                           // potential, for Analysis = equilibrium
///     std::vector<Column> coordinates() const;                          // names of the coordinates of the landscape
///     Model resting_at(q) const;                                        // optional, if the motion has another q
///   };

#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::systems {

using scene::About;
using scene::Column;
using scene::Refusal;
using scene::Unit;

/// Units of length, mass and time of a scene, expressed in the units of the user.
struct Scales {
  double length = 1, mass = 1, time = 1;

  /// The size of `unit` in the units of the user. A quantity of the user divided by this number is the quantity in the
  /// scales.
  double operator()(scene::Unit unit) const {
    double product = 1;
    unit.visit([&](std::string_view word, int power) {
      const double size = std::pow(factor(word), std::abs(power));
      product *= power < 0 ? 1 / size : size;
    });
    return product;
  }

 private:
  double factor(std::string_view word) const {
    if (word == "length") return length;
    if (word == "mass") return mass;
    if (word == "time") return time;
    if (word == "pressure") return mass / (length * time * time);
    return 1;  // "radius", for entries in multiples of the radius of the body, and "1"
  }
};

namespace detail {

inline void divide(double& value, double unit) { value /= unit; }
inline void divide(std::vector<double>& values, double unit) {
  for (double& value : values) value /= unit;
}
inline void divide(scene::Matrix3& matrix, double unit) {
  for (auto& row : matrix)
    for (double& value : row) value /= unit;
}
template <class Word>
requires(std::is_enum_v<Word> || std::is_integral_v<Word> ||
         std::is_same_v<Word, std::string>) void divide(Word&, double) {}  // words and integers do not have a unit

}  // namespace detail

/// The values of the entries of a system in a scene that read_scene returned. Entries that the scene does not contain
/// have their defaults.
template <class SystemScene>
SystemScene system_scene(const scene::Scene& scene) {
  SystemScene system;
  SystemScene::visit(system, [&](auto& member, const auto& kind, const About& about) {
    const auto value = scene.system_values.find(about.path);
    if (value != scene.system_values.end()) (void)kind.read(value->second, member);  // read_scene has checked the value
  });
  return system;
}

/// The system with its entries divided by their units in the scales. An entry whose columns have several units (Rows)
/// has the unit "". If the system has a member function `rescale(scales)`, this function then converts such entries.
template <class SystemScene>
SystemScene in_scales(SystemScene system, const Scales& scales) {
  SystemScene::visit(
      system, [&](auto& member, const auto&, const About& about) { detail::divide(member, scales(about.unit)); });
  if constexpr (requires { system.rescale(scales); }) system.rescale(scales);
  return system;
}

}  // namespace pseudorigid::systems
