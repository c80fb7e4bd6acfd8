#pragma once
/// The words that entries of a parameter file may have as values, and what they stand for.

#include <cstddef>

#include "entries/entry_kinds.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

inline constexpr Choice<Analysis, 5> analysis_kind{{{
    {"motion", Analysis::motion},
    {"modes", Analysis::modes},
    {"equilibrium", Analysis::equilibrium},
    {"manifolds", Analysis::manifolds},
    {"section", Analysis::section},
}}};
inline constexpr Choice<Crossings, 3> crossings_kind{
    {{{"up", Crossings::up}, {"down", Crossings::down}, {"both", Crossings::both}}}};
/// The names are those of the laws' own table, materials/law_table.h.
inline constexpr Choice<Law, 8> law_kind{{{
    {"neo-hookean", Law::neo_hookean},
    {"mooney-rivlin", Law::mooney_rivlin},
    {"gent", Law::gent},
    {"ciarlet-geymonat", Law::ciarlet_geymonat},
    {"ciarlet-geymonat (as printed)", Law::ciarlet_geymonat_as_printed},
    {"saint-venant-kirchhoff", Law::saint_venant_kirchhoff},
    {"saint-venant-kirchhoff (as printed)", Law::saint_venant_kirchhoff_as_printed},
    {"none", Law::none},
}}};
inline constexpr Choice<Family, 10> initial_family_kind{{{
    {"none", Family::none},
    {"maclaurin", Family::maclaurin},
    {"spheroids", Family::spheroids},
    {"spinning", Family::spinning},
    {"jacobi", Family::jacobi},
    {"dedekind", Family::dedekind},
    {"riemann-s", Family::riemann_s},
    {"riemann-s-dual", Family::riemann_s_dual},
    {"riemann-planar", Family::riemann_planar},
    {"riemann-planar-dual", Family::riemann_planar_dual},
}}};
/// Those that Analysis = equilibrium can write.
inline constexpr Choice<Family, 10> family_kind = [] {
  Choice<Family, 10> kind;
  for (std::size_t i = 0; i + 1 < kind.table.size(); ++i) kind.table[i] = initial_family_kind.table[i + 1];
  kind.table.back() = {"static", Family::at_rest};
  return kind;
}();
inline constexpr Choice<ErrorEstimate, 2> error_estimate_kind{
    {{{"none", ErrorEstimate::none}, {"auto", ErrorEstimate::automatic}}}};
inline constexpr Choice<Graphics, 2> graphics_kind{{{{"none", Graphics::none}, {"vtu", Graphics::vtu}}}};
inline constexpr Choice<Cells, 2> cells_kind{{{{"linear", Cells::linear}, {"lagrange", Cells::lagrange}}}};
inline constexpr Choice<Symmetry, 9> symmetry_kind{{{
    {"auto", Symmetry::automatic},
    {"none", Symmetry::none},
    {"x", Symmetry::x},
    {"y", Symmetry::y},
    {"z", Symmetry::z},
    {"xy", Symmetry::xy},
    {"xz", Symmetry::xz},
    {"yz", Symmetry::yz},
    {"octant", Symmetry::octant},
}}};
inline constexpr Switches<Quantities, 9> quantities_kind{{{
                                                             {"state", &Quantities::state},
                                                             {"energies", &Quantities::energies},
                                                             {"momenta", &Quantities::momenta},
                                                             {"multiplier", &Quantities::multiplier},
                                                             {"axes", &Quantities::axes},
                                                             {"nonaffine", &Quantities::nonaffine},
                                                             {"pressure", &Quantities::pressure},
                                                             {"bipolar", &Quantities::bipolar},
                                                             {"stretches", &Quantities::stretches},
                                                         }},
                                                         6};

inline constexpr Switches<Fields, 5> fields_kind{{{
                                                     {"displacement", &Fields::displacement},
                                                     {"velocity", &Fields::velocity},
                                                     {"stress", &Fields::stress},
                                                     {"deformation", &Fields::deformation},
                                                     {"energy", &Fields::energy},
                                                 }},
                                                 5};

/// The systems by name, the ball first.
inline Word system_kind(const Catalogue& catalogue) {
  Word kind{{ball}};
  for (const SystemDescription& system : catalogue.systems) kind.allowed.push_back(system.name);
  return kind;
}

/// The models by name.
inline Words models_kind(const Catalogue& catalogue) {
  Words kind;
  for (const ModelDescription& model : catalogue.models) kind.allowed.push_back(model.name);
  return kind;
}

/// `auto` and the methods by name.
inline Word method_kind(const Catalogue& catalogue) {
  Word kind{{automatic}};
  for (const NamedMethod& method : catalogue.methods) kind.allowed.push_back(method.name);
  return kind;
}

}  // namespace pseudorigid::scene
