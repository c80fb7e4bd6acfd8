#pragma once
/// The gravity of the body on itself, with Newton's constant G.

#include "loads/load.h"

namespace pseudorigid::loads {

struct SelfGravity {
  double constant = 0;  ///< Newton's constant G

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(
        self.constant, scene::not_negative,
        scene::About{"Gravity/Constant", "length^3/mass/time^2", "Newton's constant G of the self-gravity; 0: none."});
  }

  static constexpr std::string_view no_equilibria = "";
  static constexpr std::string_view skipped =
      "self-gravity: Gravity/Constant is 0; no elliptic integrals, no pairs of surface points";
  std::string needed(const BodyFacts&) const { return "self-gravity"; }

  Forcing forcing() const { return {.gravity_constant = constant}; }
};

}  // namespace pseudorigid::loads
