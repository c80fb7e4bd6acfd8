#pragma once
/// Table of the material laws by name, and their entries in parameter files. A new law needs a header with operator==,
/// and with energy, stress and tangent for any scalar type of tensor.h. law_limits.h and stress_coefficients.h describe
/// the optional declarations. In this file, add the type of the law to AnyLaw, its parameters to LawParameters and
/// law_entries, and a line to law_table.

#include <concepts>
#include <iterator>
#include <limits>
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

using AnyLaw = std::variant<CiarletGeymonat,                //
                            MooneyRivlin,                   //
                            Gent,                           //
                            SaintVenantKirchhoff,           //
                            SaintVenantKirchhoffAsPrinted,  //
                            Fluid>;

static_assert([]<class... Laws>(std::variant<Laws...>*) { return (std::equality_comparable<Laws> && ...); }(
                  static_cast<AnyLaw*>(nullptr)),
              "a law declares `bool operator==(const Law&) const = default;`");

/// The parameters of all laws. law_entries has one entry of the parameter file for each parameter.
struct LawParameters {
  ByName by_name{};
  double shear_modulus = 1;
  double lame_lambda = 1;
  double mooney_fraction = 0.5;
  double gent_limit = 10;
};

/// The entry `path` of parameter files, which sets the parameter `member`. Permitted values are from `low` to `high`,
/// without `low` if `low_excluded` is true.
struct LawEntry {
  double LawParameters::*member;
  std::string_view path;
  bool is_modulus = false;  ///< true if the unit is a pressure; otherwise the parameter has no unit
  double low = 0, high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;
  std::string_view documentation;
};

/// The entries in the order of a parameter file.
inline constexpr LawEntry law_entries[] = {
    {.member = &LawParameters::shear_modulus,
     .path = "Material/Shear modulus",
     .is_modulus = true,
     .low_excluded = true,
     .documentation = "Shear modulus mu at rest; c = sqrt(mu/density) is the speed of shear waves. The law none does "
                      "not use it."},
    {.member = &LawParameters::lame_lambda,
     .path = "Material/Lame lambda",
     .is_modulus = true,
     .low_excluded = true,
     .documentation = "First Lame modulus at rest, which resists changes of volume (mooney-rivlin has 2 b mu more, "
                      "gent 2 mu/J_m, ciarlet-geymonat as printed twice this). On incompressible bodies only the two "
                      "forms of saint-venant-kirchhoff depend on it."},
    {.member = &LawParameters::mooney_fraction,
     .path = "Material/Mooney fraction",
     .high = 1,
     .documentation = "b of mooney-rivlin, the share of the shear modulus that belongs to II; 0 is neo-hookean. Other "
                      "laws ignore it."},
    {.member = &LawParameters::gent_limit,
     .path = "Material/Gent limit",
     .low_excluded = true,
     .documentation = "J_m of gent, the value of I - 3 that no deformation reaches; a motion that reaches it is "
                      "stopped. The law tends to neo-hookean as J_m grows. Other laws ignore it."},
};
static_assert(sizeof(LawParameters) == sizeof(double) * (1 + std::size(law_entries)),
              "every number of LawParameters has one line of law_entries");

/// One line of the table of laws.
struct NamedLaw {
  std::string_view name;
  /// Documentation of the law in parameter files: the formula for W, and remarks. The documentation of Material/Law
  /// defines the symbols, such as the bulk term B (scene/choices.h).
  std::string_view energy;
  /// Makes the law. `bulk` is the modulus λ of the bulk term; `make` passes 0 for an incompressible body. Both forms of
  /// ciarlet-geymonat and of saint-venant-kirchhoff ignore `bulk` and always use lame_lambda. The law `none` ignores
  /// both arguments.
  AnyLaw (*of)(const LawParameters&, double bulk);
  /// Warnings to the user about the choice of this law for an incompressible and for a compressible body; empty if
  /// there is none.
  std::string_view warning_incompressible = "", warning_compressible = warning_incompressible;

  /// Makes the law for an incompressible or a compressible body. The modulus of the bulk term is 0 for an
  /// incompressible body, and otherwise lame_lambda.
  AnyLaw make(const LawParameters& p, bool incompressible = true) const {
    return of(p, incompressible ? 0 : p.lame_lambda);
  }
};

/// The table of laws. Both forms of ciarlet-geymonat have their bulk term even for an incompressible body, because the
/// term and its stress are 0 at J = 1.
inline constexpr NamedLaw law_table[] = {
    {.name = "neo-hookean",
     .energy = "(mu/2) (I - 3 - 2 ln J) + B.",
     .of = [](const LawParameters& p, double bulk) -> AnyLaw {
       return CiarletGeymonat{p.shear_modulus, bulk};
     }},
    {.name = "mooney-rivlin",
     .energy = "(mu/2) [(1 - b) (I - 3) + b (II - 3)] - mu (1 + b) ln J + B, b the Mooney fraction.",
     .of = [](const LawParameters& p, double bulk) -> AnyLaw {
       return MooneyRivlin{p.shear_modulus, bulk, p.mooney_fraction};
     }},
    {.name = "gent",
     .energy = "-(mu/2) J_m ln(1 - (I - 3)/J_m) - mu ln J + B, J_m the Gent limit.",
     .of = [](const LawParameters& p, double bulk) -> AnyLaw {
       return Gent{p.shear_modulus, bulk, p.gent_limit};
     }},
    {.name = "ciarlet-geymonat",
     .energy = "that of neo-hookean.",
     .of = [](const LawParameters& p, double) -> AnyLaw {
       return CiarletGeymonat{p.shear_modulus, p.lame_lambda};
     }},
    {.name = "ciarlet-geymonat (as printed)",
     .energy = "with 2 B for B, as Oliva prints it (5.7.9).",
     .of = [](const LawParameters& p, double) -> AnyLaw {
       return CiarletGeymonat{p.shear_modulus, 2 * p.lame_lambda};
     },
     .warning_incompressible =
         "as printed in Oliva 5.7.9(2) the energy of ciarlet-geymonat has lambda/2 in place of lambda/4, which is of "
         "no effect on an incompressible body",
     .warning_compressible =
         "as printed in Oliva 5.7.9(2) the energy of ciarlet-geymonat has lambda/2 in place of lambda/4; the first "
         "Lame modulus of the body is twice the entry"},
    {.name = "saint-venant-kirchhoff",
     .energy = "(lambda/8) (I - 3)^2 + (mu/4) (I^2 - 2 II - 2 I + 3); it loses stability in compression.",
     .of = [](const LawParameters& p, double) -> AnyLaw {
       return SaintVenantKirchhoff{p.shear_modulus, p.lame_lambda};
     },
     .warning_incompressible =
         "saint-venant-kirchhoff loses stability in compression (it softens below a stretch of 1/sqrt(3) along one "
         "axis and lets volumes vanish); do not trust it where the body is compressed much"},
    {.name = "saint-venant-kirchhoff (as printed)",
     .energy = "(lambda/2) (I - 3)^2 + mu (I - 3), as Oliva prints it (5.7.9); it is stressed at rest.",
     .of = [](const LawParameters& p, double) -> AnyLaw {
       return SaintVenantKirchhoffAsPrinted{p.shear_modulus, p.lame_lambda};
     },
     .warning_incompressible =
         "as printed in Oliva 5.7.9(3) the energy of saint-venant-kirchhoff is another one, with the stress 2 mu Id at "
         "rest (a pressure, which incompressibility carries) and the shear modulus 2 mu there",
     .warning_compressible =
         "as printed in Oliva 5.7.9(3) the energy of saint-venant-kirchhoff is another one, with the stress 2 mu Id at "
         "rest: the body contracts by itself"},
    {.name = "none",
     .energy =
         "0. It is a fluid or, where Incompressible = false, free particles (reduced model only); the continuum then "
         "needs self-gravity or a confining tidal matrix.",
     .of = [](const LawParameters&, double) -> AnyLaw { return Fluid{}; }},
};

/// Returns the line of the table with this name. Throws std::invalid_argument if there is no such line.
inline const NamedLaw& find_law(std::string_view name) {
  for (const NamedLaw& law : law_table)
    if (law.name == name) return law;
  throw std::invalid_argument("no material law is called " + std::string(name));
}

/// Makes the law with this name for an incompressible or a compressible body. Throws std::invalid_argument if there is
/// no law with this name.
inline AnyLaw make_law(std::string_view name, const LawParameters& p, bool incompressible = true) {
  return find_law(name).make(p, incompressible);
}

/// Returns true if the law stores no energy.
inline bool is_fluid(const AnyLaw& law) { return std::holds_alternative<Fluid>(law); }

/// Returns true if the law admits F, for F with J = det F > 0. If the law does not admit F, limit_of(law) is the reason
/// (law_limits.h).
inline bool admits(const AnyLaw& law, const Tensor<double>& F) {
  return std::visit([&](const auto& l) { return admits(l, F); }, law);
}
inline std::string_view limit_of(const AnyLaw& law) {
  return std::visit([](const auto& l) { return limit_of(l); }, law);
}
/// Returns the ratio λ₁/λ_n at which the surface of an incompressible body wrinkles (law_limits.h). Empty if the law
/// does not declare it.
inline std::optional<double> surface_limit(const AnyLaw& law) {
  return std::visit(
      []<class Law>(const Law&) -> std::optional<double> {
        if constexpr (requires { Law::surface_limit; }) return Law::surface_limit;
        return std::nullopt;
      },
      law);
}

}  // namespace pseudorigid::materials
