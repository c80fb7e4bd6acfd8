#pragma once
/// The table name → law. A new law is one header (energy and stress of F) and one line here; both models instantiate
/// their code for every alternative of AnyLaw.

#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "materials/ciarlet_geymonat.h"

namespace pseudorigid::materials {

using AnyLaw = std::variant<CiarletGeymonat>;

struct LawParameters {
  double shear_modulus = 1, lame_lambda = 1;
  bool incompressible = true;
};

/// The law of that name. On SL(3) the neo-Hookean law has no bulk term; Ciarlet–Geymonat keeps it, where it only shifts
/// the multiplier. Throws std::invalid_argument for a name that is not in the table.
inline AnyLaw make_law(std::string_view name, const LawParameters& p) {
  if (name == "neo-hookean") return CiarletGeymonat{p.shear_modulus, p.incompressible ? 0.0 : p.lame_lambda};
  if (name == "ciarlet-geymonat") return CiarletGeymonat{p.shear_modulus, p.lame_lambda};
  throw std::invalid_argument("no material law is called " + std::string(name));
}

}  // namespace pseudorigid::materials
