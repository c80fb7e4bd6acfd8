#pragma once
/// Linear drag: the force −cρẋ per reference volume, with the reference density ρ and the velocity ẋ.

#include "loads/load.h"

namespace pseudorigid::loads {

struct Drag {
  double drag = 0;  ///< the drag coefficient c, in 1/time

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(
        self.drag, scene::not_negative,
        scene::About{"Material/Drag", "1/time",
                     "c of the force -c (density) (velocity) per volume. It damps every motion, rigid ones included."});
  }

  static constexpr std::string_view no_equilibria = "drag leaves no relative equilibrium";
  static constexpr std::string_view skipped = "";
  std::string needed(const BodyFacts&) const { return {}; }

  Forcing forcing() const { return {.drag = drag}; }
};

}  // namespace pseudorigid::loads
