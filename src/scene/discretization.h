#pragma once
/// Discretisations of the continuum: finite elements of degree k on the mesh refined r times, and the order in which
/// they are tried if the scene leaves the choice open.
///
/// The error of Q falls with the resolution
///
///   N = k · 1.6^r,
///
/// not with k 2^r, the number of nodes along an edge: at equal k 2^r high degree is the more accurate (shear fronts
/// leave the surface, so that the rate in N is algebraic, but of high degree they are resolved better; the base is
/// fitted to measured errors of releases, tests/app/auto_degree_test.py). The cost at the stable step ~ 1/(k² 2^r) is
///
///   c = (k 2^r)³ · k² 2^r.

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace pseudorigid::scene {

inline constexpr int largest_degree = 8;
/// Largest degree of polynomial bodies.
inline constexpr int largest_polynomial_degree = 13;
/// Largest number of refinements in a search; a scene may set more.
inline constexpr int largest_refinements_of_search = 2;

struct Discretization {
  int degree = 4, refinements = 0;
  bool operator==(const Discretization&) const = default;
};

/// N.
double resolution(const Discretization& d);
/// c, in units of one trilinear element a cell.
double cost(const Discretization& d);
/// "degree 4, unrefined", "degree 5, refined once".
std::string describe(const Discretization& d);

/// The discretisation of a scene without `auto`.
std::optional<Discretization> fixed_discretization(const Scene& scene);

/// The discretisations that a scene admits. Each costs more than the one before and has a resolution higher by at least
/// a tenth; discretisations that cost more for the same resolution are left out.
std::vector<Discretization> ladder(const Scene& scene);

/// The one that a run is compared with to estimate its error: of one degree less, at the least degree refined once
/// less, and of the coarsest one the next finer.
Discretization companion(const Discretization& d);

/// The companion of a polynomial body of degree N. With the symmetry of an octant degrees rise by two. A higher degree
/// gives the error itself, while a lower degree often gives many times the error. For N ≥ 9, where degrees are costly,
/// the companion has two degrees less.
int companion_degree(int N);

}  // namespace pseudorigid::scene
