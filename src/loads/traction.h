#pragma once
/// A dead traction P̄N per reference area, with the reference normal N. The vector does not change when the body moves.

#include "loads/load.h"

namespace pseudorigid::loads {

struct Traction {
  scene::Matrix3 nominal_stress{};  ///< the matrix P̄, a constant first Piola–Kirchhoff stress

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(self.nominal_stress, scene::Matrix{},
          scene::About{
              "Loads/Nominal traction", "pressure",
              "Dead traction on the surface: the matrix P of a constant nominal (first Piola-Kirchhoff) stress. "
              "The traction is P N per undeformed area with the undeformed normal N, the same vector however the "
              "body moves. Its energy is -P : F per undeformed volume."});
  }

  static constexpr std::string_view no_equilibria = "relative equilibria are offered without a traction";
  static constexpr std::string_view skipped = "traction: Loads/Nominal traction is 0";
  std::string needed(const BodyFacts&) const { return "dead traction on the surface"; }

  Forcing forcing() const { return {.nominal_traction = to_eigen(nominal_stress)}; }
};

}  // namespace pseudorigid::loads
