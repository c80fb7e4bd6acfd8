#pragma once
/// The entries of the analyses other than a motion: equilibria, modes, Love numbers, manifolds and sections. The list
/// of all entries in scene/entries.h includes them.

#include <concepts>
#include <type_traits>

#include "scene/choices.h"
#include "scene/discretization.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The type Scene, or const Scene if the visitor only reads the entries.
template <class S>
concept SceneOrConst = std::same_as<std::remove_const_t<S>, Scene>;

template <SceneOrConst S, class Visit>
void visit_equilibria(S& scene, Visit& visit) {
  auto& [family, first, last, number, ratio, small_motions] = scene.equilibria;
  visit(
      family, family_kind,
      About{"Equilibrium/Family", "",
            "Family of relative equilibria that Analysis = equilibrium writes, under the law and the gravity of "
            "the scene. maclaurin: spheroids that turn rigidly, by their eccentricity e; spheroids: the same by "
            "a3, in radii; spinning: by their spin; jacobi: ellipsoids that turn rigidly, by a2/a1; dedekind: "
            "their duals, at rest in space; riemann-s: spin and circulation about axis 3, by a2/a1 at the given "
            "Axis ratio; riemann-planar: both in the plane of axes 2 and 3 (Riemann's types I to III); -dual: "
            "spin and circulation exchanged. static: no family, but all equilibria at rest that a search from 400 "
            "starts finds, the critical points of the potential energy under every load that does not depend on time, "
            "for any Semi-axes and Inertia, with Morse index and rates; of polynomial bodies and finite elements, the "
            "one that is reached as "
            "the loads rise from 0. The other entries of the section are then ignored."});
  visit(first, Number{}, About{"Equilibrium/First", "", "First value of the family's parameter."});
  visit(last, Number{}, About{"Equilibrium/Last", "", "Last value of the family's parameter."});
  visit(number, Integer{1, 1'000'000},
        About{"Equilibrium/Number", "", "Number of members, equally spaced in the parameter."});
  visit(ratio, positive, About{"Equilibrium/Axis ratio", "", "a3/a1 of Riemann's families."});
  visit(
      small_motions, Boolean{},
      About{"Equilibrium/Small motions", "",
            "Whether polynomial bodies and finite elements compute the small motions about a figure. With false, their "
            "tables have no rates, no stability and no special points but folds, and take a fraction of the time. The "
            "pseudo-rigid model always computes them."});
}

template <SceneOrConst S, class Visit>
void visit_modes(S& scene, Visit& visit) {
  visit(scene.modes.number, Integer{1, 100},
        About{"Modes/Number", "",
              "Number of frequencies that Analysis = modes writes, from the lowest, one per row of modes.csv. "
              "Columns: index; omega, the mean of the 2n+1 copies of a mode of degree n; kind: 1 spheroidal, 2 "
              "toroidal; degree n; overtone: 0 is the fundamental of its kind and degree; multiplicity 2n+1; "
              "spread: (largest - smallest copy)/omega, an error of the mesh alone; exact: omega of the elastic "
              "sphere; reduced: omega of the pseudo-rigid ball, or 0 if it has no such mode. Rigid motions are "
              "left out. Graphics shows one mode of each row (modes.pvd), for the first Frames rows, with a "
              "largest displacement of one radius."});
}

template <SceneOrConst S, class Visit>
void visit_love_numbers(S& scene, Visit& visit) {
  visit(scene.love.degrees, AutoOrIntegers{{2, largest_love_degree}},
        About{"Love numbers/Degrees", "",
              "Degrees n of the tides for which Analysis = love numbers writes Love numbers, one row each. With auto, "
              "they are 2 to 8, or less if the finite elements do not resolve these: up to Degree times 2^Refinements. "
              "Degree 1 moves the ball as a whole, and its numbers depend on the frame."});
}

template <SceneOrConst S, class Visit>
void visit_manifolds(S& scene, Visit& visit) {
  visit(scene.manifolds.starts, Integer{1, 10'000},
        About{"Manifolds/Starts", "",
              "Number of motions that Analysis = manifolds follows away from a critical point with several unstable "
              "directions, spread around it; from a point with one, both motions are followed. On the stable "
              "manifolds of the points that are unstable the motions come in along single directions. Each is "
              "followed until it is within 1e-6 of a critical point, or for Time/End."});
}

template <SceneOrConst S, class Visit>
void visit_section(S& scene, Visit& visit) {
  auto& [column, value, period, crossings] = scene.section;
  visit(column, Text{},
        About{"Section/Column", "",
              "The column of the system's CSV file that Analysis = section watches. Every crossing of Value until "
              "Time/End is a row of section.csv, with the columns of the motion at that time."});
  visit(value, Number{}, About{"Section/Value", "", "The value that is crossed, in the column's own unit."});
  visit(period, not_negative,
        About{"Section/Period", "",
              "For a column that is an angle and counts its turns: the values Value + k Period, k any integer, are "
              "crossed as well. 0: none. A jump of a column is not a crossing."});
  visit(crossings, crossings_kind,
        About{"Section/Direction", "", "Which crossings count: of a column that rises, that falls, or both."});
}

}  // namespace pseudorigid::scene
