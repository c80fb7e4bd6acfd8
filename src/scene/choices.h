#pragma once
/// The words that are valid values of entries, and the enumerators or members that they select in a Scene.

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "entries/entry_kinds.h"
#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

inline constexpr auto analysis_kind = choice<Analysis>({
    {"motion", Analysis::motion},
    {"modes", Analysis::modes},
    {"love numbers", Analysis::love_numbers},
    {"equilibrium", Analysis::equilibrium},
    {"manifolds", Analysis::manifolds},
    {"section", Analysis::section},
});
inline constexpr auto crossings_kind =
    choice<Crossings>({{"up", Crossings::up}, {"down", Crossings::down}, {"both", Crossings::both}});
inline constexpr auto initial_family_kind = choice<Family>({
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
});
inline constexpr auto starting_figure_kind =
    choice<StartingFigure>({{"affine", StartingFigure::affine}, {"own", StartingFigure::own}});
/// The families for Analysis = equilibrium. They are the families of initial_family_kind without `none`, and in
/// addition the equilibria at rest (`static`).
inline constexpr auto family_kind = []() consteval {
  auto table = initial_family_kind.table;
  std::ranges::rotate(table, table.begin() + 1);
  table.back() = {"static", Family::at_rest};
  return Choice(table);
}
();
inline constexpr auto error_estimate_kind =
    choice<ErrorEstimate>({{"none", ErrorEstimate::none}, {"auto", ErrorEstimate::automatic}});
inline constexpr auto bulk_kind = choice<Bulk>({{"pointwise", Bulk::pointwise}, {"projected", Bulk::projected}});
inline constexpr auto graphics_kind = choice<Graphics>({{"none", Graphics::none}, {"vtu", Graphics::vtu}});
inline constexpr auto cells_kind = choice<Cells>({{"linear", Cells::linear}, {"lagrange", Cells::lagrange}});
inline constexpr auto symmetry_kind = choice<Symmetry>({
    {"auto", Symmetry::automatic},
    {"none", Symmetry::none},
    {"x", Symmetry::x},
    {"y", Symmetry::y},
    {"z", Symmetry::z},
    {"xy", Symmetry::xy},
    {"xz", Symmetry::xz},
    {"yz", Symmetry::yz},
    {"octant", Symmetry::octant},
});
inline constexpr auto quantities_kind = []() consteval {
  NameTable<bool Quantities::*, std::size(mechanics::quantity_groups)> table;
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = {mechanics::quantity_groups[i].name, mechanics::quantity_groups[i].member};
  return Switches(table, mechanics::n_default_groups);
}
();
inline constexpr auto fields_kind = switches<Fields>({
    {"displacement", &Fields::displacement},
    {"velocity", &Fields::velocity},
    {"stress", &Fields::stress},
    {"deformation", &Fields::deformation},
    {"energy", &Fields::energy},
});

/// The documentation of Output/Quantities, composed of the documentation of each group.
std::string_view documentation_of_quantities();

/// The documentation of Material/Law, composed of the stored energies of the laws.
std::string_view documentation_of_laws();
/// The valid values of Material/Law.
inline Word law_kind() {
  Word kind;
  for (const materials::NamedLaw& law : materials::law_table) kind.allowed.push_back(law.name);
  return kind;
}

/// The valid values of System. The first is the ball.
inline Word system_kind(const Catalogue& catalogue) {
  Word kind{{ball}};
  for (const SystemDescription& system : catalogue.systems) kind.allowed.push_back(system.name);
  return kind;
}

/// The valid values of Models: the names of the models in the catalogue.
inline Words models_kind(const Catalogue& catalogue) {
  Words kind;
  for (const ModelDescription& model : catalogue.models) kind.allowed.push_back(model.name);
  return kind;
}

/// The valid values of Time/Method: the word `auto` and the names of the methods.
inline Word method_kind(const Catalogue& catalogue) {
  Word kind{{automatic}};
  for (const NamedMethod& method : catalogue.methods) kind.allowed.push_back(method.name);
  return kind;
}

}  // namespace pseudorigid::scene
