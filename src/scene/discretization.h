#pragma once
/// Discretisations of the finite-element model, with degree k on the mesh after r refinements. If the scene does not
/// set both numbers, a search tries discretisations in a fixed order.
///
/// The error of Q decreases with the resolution
///
///   N = k · 1.6^r,
///
/// and not with k 2^r, the number of nodes along an edge. At equal k 2^r, a high degree is more accurate. Shear fronts
/// leave the surface, so that the rate in N is algebraic, but high degrees resolve the fronts better. The base 1.6 is
/// fitted to measured errors of releases (tests/app/auto_degree_test.py). With the largest stable step, which is
/// proportional to 1/(k² 2^r), the cost is
///
///   c = (k 2^r)³ · k² 2^r.

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace pseudorigid::scene {

inline constexpr int largest_degree = 8;
/// The largest degree of polynomial bodies.
inline constexpr int largest_polynomial_degree = 13;
/// The largest number of refinements in a search. A scene may set more.
inline constexpr int largest_refinements_of_search = 2;

struct Discretization {
  int degree = 4, refinements = 0;
  bool operator==(const Discretization&) const = default;
};

/// The resolution N.
double resolution(const Discretization& d);
/// The cost c, in units of one trilinear element per cell.
double cost(const Discretization& d);
/// The discretisation in words, such as "degree 4, unrefined" or "degree 5, refined once".
std::string describe(const Discretization& d);

/// The discretisation of a scene that sets both numbers; otherwise empty.
std::optional<Discretization> fixed_discretization(const Scene& scene);

/// The discretisations that the scene admits, by increasing cost. Each has a resolution at least 10 % higher than the
/// one before; others are omitted.
std::vector<Discretization> ladder(const Scene& scene);

/// The discretisation of the companion run, by which a run estimates its error. It has one degree less. At the least
/// degree, it has one refinement less, or one degree more if the mesh is unrefined.
Discretization companion(const Discretization& d);

/// The degree of the companion run of a polynomial body of degree N. The degrees differ by two, because bodies with the
/// symmetry of an octant only use odd degrees. A higher degree gives the error itself, while a lower degree often gives
/// many times the error. For N ≥ 9, high degrees are costly, and the companion has two degrees less.
int companion_degree(int N);

}  // namespace pseudorigid::scene
