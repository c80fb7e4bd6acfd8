#include "scene/discretization.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pseudorigid::scene {
namespace {

/// The least degree of a search if the scene does not set the degree. A companion run never decreases the degree below
/// this number. With degree 1, the surface is a polyhedron, and there is no pressure space for these elements.
constexpr int least_degree = 2;
/// The base 1.6 of the resolution N = k · 1.6^r for degree k and r refinements. The least ratio of the resolutions of
/// successive discretisations in the list of a search.
constexpr double resolution_of_a_refinement = 1.6, least_gain = 1.1;

}  // namespace

double resolution(const Discretization& d) { return d.degree * std::pow(resolution_of_a_refinement, d.refinements); }

double cost(const Discretization& d) {
  const double k = d.degree, n_along_edge = std::ldexp(k, d.refinements);
  return n_along_edge * n_along_edge * n_along_edge * n_along_edge * k;
}

std::string describe(const Discretization& d) {
  const std::string times = d.refinements == 0   ? "unrefined"
                            : d.refinements == 1 ? "refined once"
                                                 : fmt::format("refined {} times", d.refinements);
  return fmt::format("degree {}, {}", d.degree, times);
}

std::optional<Discretization> fixed_discretization(const Scene& scene) {
  const auto& [degree, refinements] = std::pair(scene.continuum.degree, scene.continuum.refinements);
  return degree && refinements ? std::optional(Discretization{*degree, *refinements}) : std::nullopt;
}

std::vector<Discretization> ladder(const Scene& scene) {
  const auto& degree = scene.continuum.degree;
  const auto& refinements = scene.continuum.refinements;
  std::vector<Discretization> all, kept;
  for (int k = degree.value_or(least_degree); k <= degree.value_or(largest_degree); ++k)
    for (int r = refinements.value_or(0); r <= refinements.value_or(largest_refinements_of_search); ++r)
      all.push_back({k, r});
  std::ranges::sort(all, {}, cost);
  for (const Discretization& d : all)
    if (kept.empty() || resolution(d) >= least_gain * resolution(kept.back())) kept.push_back(d);
  return kept;
}

Discretization companion(const Discretization& d) {
  if (d.degree > least_degree) return {d.degree - 1, d.refinements};
  if (d.refinements > 0) return {d.degree, d.refinements - 1};
  return {d.degree + 1, d.refinements};
}

int companion_degree(int N) { return N < 9 ? N + 2 : N - 2; }

}  // namespace pseudorigid::scene
