#include "scene/bulk.h"

#include <fmt/format.h>

#include <algorithm>

#include "materials/bulk_energy.h"
#include "materials/rest_moduli.h"
#include "scene/scales.h"

namespace pseudorigid::scene {
namespace {

bool is_method_for_projection(const Scene& scene) {
  const std::string_view method = scene.time.method;
  return method == automatic || method.starts_with("rattle");
}

}  // namespace

bool projects_bulk(const Scene& scene) {
  constexpr double least_ratio = 3000;
  const Bulk asked = scene.material.bulk;
  if (scene.body.incompressible || scene.analysis != Analysis::motion || asked == Bulk::pointwise) return false;
  if (asked == Bulk::projected) return true;
  const auto split = materials::without_bulk(law_of(scene));
  if (!split || scene.continuum.degree == 1 || !is_method_for_projection(scene) || starts_from_own_figure(scene))
    return false;
  return split->lambda >= least_ratio * materials::moduli_at_rest(split->rest, true).shear;
}

std::optional<std::string> warning_of_locking(const Scene& scene, bool has_polynomial_bodies) {
  constexpr double least_ratio = 30;
  constexpr int first_degree = 3, last_degree = 5;
  if (!has_polynomial_bodies || scene.body.incompressible || scene.analysis != Analysis::motion || projects_bulk(scene))
    return {};
  const bool is_of_low_degree =
      std::ranges::any_of(scene.polynomial.degrees, [](int N) { return first_degree <= N && N <= last_degree; });
  const auto split = materials::without_bulk(law_of(scene));
  if (!is_of_low_degree || !split) return {};
  const double ratio = split->lambda / materials::moduli_at_rest(split->rest, true).shear;
  if (!(ratio >= least_ratio)) return {};
  return fmt::format(
      "Material/Bulk: in large motions polynomial bodies of degree {} to {} lock at lambda/mu = {:.3g}; projected "
      "avoids it",
      first_degree, last_degree, ratio);
}

std::optional<Refusal> refuses_bulk(const Scene& scene) {
  if (scene.material.bulk != Bulk::projected) return {};
  const Refusal refusal{"Material/Bulk", "", {{{"Material/Bulk", "auto"}}}};
  const auto because = [&](const char* reason) {
    Refusal result = refusal;
    result.sentence = reason;
    return result;
  };
  if (scene.body.incompressible) return because("an incompressible body has no bulk term");
  if (!materials::without_bulk(law_of(scene)))
    return because("this law has no bulk term that depends on det F alone, so there is nothing to project");
  if (scene.continuum.degree == 1) return because("the projection needs elements of degree 2 or more");
  if (!is_method_for_projection(scene))
    return because("only the methods rattle integrate a projected bulk term, which is implicit in time");
  if (starts_from_own_figure(scene))
    return because("figures have a pointwise bulk term, and so have motions from them");
  return {};
}

}  // namespace pseudorigid::scene
