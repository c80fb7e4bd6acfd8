#pragma once
/// A quadratic external potential energy ½ xᵀTx per mass at the position x.

#include "loads/load.h"

namespace pseudorigid::loads {

struct Tide {
  scene::Matrix3 tensor{};  ///< the symmetric matrix T, in 1/time²

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(
        self.tensor, scene::Matrix{.symmetric = true},
        scene::About{"Loads/Tidal matrix", "1/time^2",
                     "Symmetric T of the external potential energy x^T T x/2 per mass: a tide, a centrifugal force, a "
                     "trap."});
  }

  static constexpr std::string_view no_equilibria = "relative equilibria are offered without an external potential";
  static constexpr std::string_view skipped = "external potential: Loads/Tidal matrix is 0";
  std::string needed(const BodyFacts&) const { return "quadratic external potential"; }

  Forcing forcing() const { return {.quadratic = to_eigen(tensor)}; }
};

}  // namespace pseudorigid::loads
