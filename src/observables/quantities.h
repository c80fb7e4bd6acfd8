#pragma once
/// The groups of observables, which are also the groups of columns in the CSV files. Models compute an expensive
/// observable only if its group is requested. A new group needs a member of Quantities and a line of quantity_groups.

#include <cstddef>
#include <iterator>
#include <string_view>

namespace pseudorigid::mechanics {

/// The requested groups. A member is true if its group is requested. The initial values are the defaults of the entry
/// Output/Quantities.
struct Quantities {
  bool state = true, energies = true, momenta = true, multiplier = true, axes = true, nonaffine = true;
  bool orbit = true;  ///< written only if the scene has companions
  bool pressure = false, bipolar = false, stretches = false, stresses = false, vibration = false;
  /// A group without a word in parameter files, for models with motions that are not affine. The group is written if
  /// the energies are requested and the body has the volumetric stabilisation.
  bool volumetric = false;
  /// A group without a word in parameter files, which is written if the scene has rigid planes.
  bool contact = false;
  /// A group without a word in parameter files, which is written with `orbit` if the scene has a second companion.
  bool second_orbit = false;
  /// A group without a word in parameter files, which is written if the energies are requested and the scene has
  /// viscoelastic branches.
  bool branches = false;
};

/// The word of a group in parameter files, the member of the group, and its text for the documentation.
struct QuantityGroup {
  std::string_view name;
  bool Quantities::*member;
  std::string_view documentation;
};

/// The groups that a parameter file can request by a word. The groups that are requested by default come first.
inline constexpr QuantityGroup quantity_groups[] = {
    {"state", &Quantities::state, "Q, Qdot, centre of mass, mean gradient"},
    {"energies", &Quantities::energies, "the parts of the energy and their sum"},
    {"momenta", &Quantities::momenta, "J, Z"},
    {"multiplier", &Quantities::multiplier, "that of the constraint"},
    {"axes", &Quantities::axes, "volume ratio and semi-axes"},
    {"nonaffine", &Quantities::nonaffine, "how far a body that bends is from an affine motion"},
    {"orbit", &Quantities::orbit,
     "of a body with companions, their motion, orbital elements, the lag of the bulge, k2, 1/Q, torque, spin, "
     "obliquity "
     "and the angular momentum of body and orbit"},
    {"pressure", &Quantities::pressure,
     "of the reduced model, the pressure at the centre of a fluid or a loaded body (central_pressure = 5/2 times the "
     "multiplier's force per volume)"},
    {"bipolar", &Quantities::bipolar,
     "of the reduced model, Q = T^T A S followed along the motion (semi-axes A1, A2, A3 in no order, T, S), Omega* and "
     "Lambda* in these frames, and bipolar_residual, the largest entry of the residual of the equation of motion in "
     "them (Oliva 5.121), by differences along the path"},
    {"stretches", &Quantities::stretches,
     "the principal stretches of the mean deformation, and of a body that bends the largest and the least anywhere"},
    {"stresses", &Quantities::stresses, "the von Mises stress: its mean, its largest value, and at the centre"},
    {"vibration", &Quantities::vibration,
     "of an incompressible elastic ball, the energy of vibration and its parts by the degree of the motion"},
};
static_assert(sizeof(Quantities) == std::size(quantity_groups) + 4,
              "every group but `volumetric`, `contact`, `second_orbit` and `branches` has one line of quantity_groups");

/// Number of the groups in quantity_groups that are requested by default. The definition does not compile if they do
/// not come first.
inline constexpr std::size_t n_default_groups = [] {
  std::size_t n = 0;
  while (Quantities{}.*quantity_groups[n].member) ++n;
  for (std::size_t i = n; i < std::size(quantity_groups); ++i)
    if (Quantities{}.*quantity_groups[i].member) throw "the groups that are true by default come first";
  return n;
}();

}  // namespace pseudorigid::mechanics
