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
/// Of polynomial bodies.
inline constexpr int largest_polynomial_degree = 13;
/// Of a search; a scene may ask for more.
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

/// That of a scene which leaves nothing open.
std::optional<Discretization> fixed_discretization(const Scene& scene);

/// Those that a scene admits, each dearer than the one before and of a resolution that is higher by a tenth at least:
/// cheaper ones that resolve as much leave no place to the rest.
std::vector<Discretization> ladder(const Scene& scene);

/// The one that a run is compared with to estimate its error: of one degree less, at the least degree refined once
/// less, and of the coarsest one the next finer.
Discretization companion(const Discretization& d);

/// Likewise of a polynomial body of degree N. Motions with the symmetry of an octant go in steps of two. A richer body
/// tells the error itself, while the error of a poorer one is often many times as large; of the dearer ones, N ≥ 9, it
/// is that of two degrees less.
int companion_degree(int N);

}  // namespace pseudorigid::scene
