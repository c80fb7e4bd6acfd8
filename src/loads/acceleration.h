#pragma once
/// A uniform acceleration b of all mass points, with the potential energy −b·x per mass at the position x.

#include "loads/load.h"

namespace pseudorigid::loads {

struct Acceleration {
  std::vector<double> acceleration{0, 0, 0};  ///< the three components of b

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(self.acceleration, scene::Numbers{3},
          scene::About{"Loads/Acceleration", "length/time^2",
                       "Uniform acceleration b. It moves the centre of mass; its energy is -b.x per mass."});
  }

  static constexpr std::string_view no_equilibria = "";
  static constexpr std::string_view skipped = "";
  std::string needed(const BodyFacts&) const { return {}; }

  Forcing forcing() const { return {.acceleration = {acceleration[0], acceleration[1], acceleration[2]}}; }
};

}  // namespace pseudorigid::loads
