#pragma once
/// The table name → law. A new law is one header (energy, stress and tangent of F, over any scalar; law_limits.h has
/// what else it may declare), its type in AnyLaw and one line of the table.

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include "materials/ciarlet_geymonat.h"
#include "materials/fluid.h"
#include "materials/gent.h"
#include "materials/law_limits.h"
#include "materials/mooney_rivlin.h"
#include "materials/saint_venant_kirchhoff.h"
#include "materials/saint_venant_kirchhoff_as_printed.h"
#include "mechanics/core/by_name.h"

namespace pseudorigid::materials {

using AnyLaw =
    std::variant<CiarletGeymonat, MooneyRivlin, Gent, SaintVenantKirchhoff, SaintVenantKirchhoffAsPrinted, Fluid>;

struct LawParameters {
  ByName by_name{};
  double shear_modulus = 1, lame_lambda = 1;
  bool incompressible = true;
  double mooney_fraction = 0.5;
  double gent_limit = 10;

  /// On SL(3) the neo-Hookean law, Mooney–Rivlin's and Gent's have no bulk term.
  double bulk_lambda() const { return incompressible ? 0.0 : lame_lambda; }
};

struct NamedLaw {
  std::string_view name;
  AnyLaw (*make)(const LawParameters&);
};

/// Ciarlet–Geymonat's law keeps its bulk term on SL(3), where it only shifts the multiplier.
inline constexpr NamedLaw law_table[] = {
    {"neo-hookean",
     [](const LawParameters& p) -> AnyLaw {
       return CiarletGeymonat{p.shear_modulus, p.bulk_lambda()};
     }},
    {"mooney-rivlin",
     [](const LawParameters& p) -> AnyLaw {
       return MooneyRivlin{p.shear_modulus, p.bulk_lambda(), p.mooney_fraction};
     }},
    {"gent",
     [](const LawParameters& p) -> AnyLaw {
       return Gent{p.shear_modulus, p.bulk_lambda(), p.gent_limit};
     }},
    {"ciarlet-geymonat",
     [](const LawParameters& p) -> AnyLaw {
       return CiarletGeymonat{p.shear_modulus, p.lame_lambda};
     }},
    {"ciarlet-geymonat (as printed)",
     [](const LawParameters& p) -> AnyLaw {
       return CiarletGeymonat{p.shear_modulus, 2 * p.lame_lambda};
     }},
    {"saint-venant-kirchhoff",
     [](const LawParameters& p) -> AnyLaw {
       return SaintVenantKirchhoff{p.shear_modulus, p.lame_lambda};
     }},
    {"saint-venant-kirchhoff (as printed)",
     [](const LawParameters& p) -> AnyLaw {
       return SaintVenantKirchhoffAsPrinted{p.shear_modulus, p.lame_lambda};
     }},
    {"none", [](const LawParameters&) -> AnyLaw { return Fluid{}; }},
};

/// The law of that name. Throws std::invalid_argument for a name that is not in the table.
inline AnyLaw make_law(std::string_view name, const LawParameters& p) {
  for (const NamedLaw& law : law_table)
    if (law.name == name) return law.make(p);
  throw std::invalid_argument("no material law is called " + std::string(name));
}

/// Whether the law admits F, J > 0 supposed, and what has happened where it does not (law_limits.h).
inline bool admits(const AnyLaw& law, const Tensor<double>& F) {
  return std::visit([&](const auto& l) { return admits(l, F); }, law);
}
inline std::string_view limit_of(const AnyLaw& law) {
  return std::visit([](const auto& l) { return limit_of(l); }, law);
}
/// λ₁/λ_n at which the surface of an incompressible body of this law wrinkles, where the law declares it.
inline std::optional<double> surface_limit(const AnyLaw& law) {
  return std::visit(
      []<class Law>(const Law&) -> std::optional<double> {
        if constexpr (requires { Law::surface_limit; }) return Law::surface_limit;
        return std::nullopt;
      },
      law);
}

}  // namespace pseudorigid::materials
