#pragma once
/// Discretisations of the finite-element model. A discretisation has the degree k of the elements and the number r of
/// refinements of the mesh. If the scene does not set both numbers, a search tries discretisations by increasing cost.
///
/// An affine motion is x = QX. For other motions, the matrix Q is ∫ρxXᵀ dV E₀⁻¹ with E₀ = ∫ρXXᵀ dV. The error of Q
/// decreases with the resolution
///
///   N = k · 1.6^r.
///
/// The base 1.6 is fitted to measured errors of released balls (tests/app/auto_degree_test.py). The number of intervals
/// between nodes along an edge of an unrefined cell is k 2^r. The error does not depend on k 2^r alone: at equal k 2^r,
/// a high degree is more accurate. The motion is not smooth at shear fronts, which start at the surface. The error
/// therefore decreases only with a power of N, but high degrees resolve the fronts better. The largest stable step is
/// proportional to 1/(k² 2^r). With this step, the cost of a run is
///
///   c = (k 2^r)³ · k² 2^r.

#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace pseudorigid::scene {

/// The largest degree of finite elements that a scene may set and that a search tries.
inline constexpr int largest_degree = 8;
/// The largest degree of polynomial bodies that a scene may set.
inline constexpr int largest_polynomial_degree = 13;
/// The largest number of refinements in a search. A scene may set more.
inline constexpr int largest_refinements_of_search = 2;

struct Discretization {
  int degree = 4, refinements = 0;
  bool operator==(const Discretization&) const = default;
};

/// The resolution N.
double resolution(const Discretization& d);
/// The cost c, in units of the cost of degree 1 on the unrefined mesh.
double cost(const Discretization& d);
/// The discretisation in words, for example "degree 4, unrefined" or "degree 5, refined once".
std::string describe(const Discretization& d);

/// The discretisation of a scene that sets the degree and the refinements. The result is empty if the scene does not
/// set both.
std::optional<Discretization> fixed_discretization(const Scene& scene);

/// The discretisations that a search tries, by increasing cost. If the scene sets the degree or the refinements, this
/// number is the same in all of them. A discretisation is omitted if its resolution is not at least 10 % higher than
/// the resolution of the previous discretisation in the list.
std::vector<Discretization> ladder(const Scene& scene);

/// The discretisation of the companion run for a run with the discretisation `d`. The difference of the two runs
/// estimates the error of `d`. The companion of a degree above 2 has one degree less. For degrees 1 and 2, the
/// companion has one refinement less on a refined mesh, and one degree more on an unrefined mesh.
Discretization companion(const Discretization& d);

/// The degree of the companion run for a polynomial body of degree N: N + 2 for N < 9, otherwise N − 2. The degrees
/// differ by two, because bodies with the symmetry of an octant use odd degrees only. The difference from a companion
/// of higher degree is about the error of the run. The difference from a companion of lower degree is often many times
/// this error. For N ≥ 9 the lower degree is nevertheless used, because higher degrees are too costly.
int companion_degree(int N);

}  // namespace pseudorigid::scene
