#include "scene/bulk.h"

#include <fmt/format.h>

#include <algorithm>

#include "materials/bulk_energy.h"
#include "materials/rest_moduli.h"
#include "scene/scales.h"
#include "scene/stabilization.h"

namespace pseudorigid::scene {
namespace {

constexpr double least_ratio = 100;

/// The ratio λ/μ of the modulus of the bulk term to the shear modulus; empty if the law has no bulk term.
std::optional<double> ratio_of_moduli(const Scene& scene) {
  const auto split = materials::without_bulk(law_of(scene));
  if (!split) return {};
  return split->lambda / materials::moduli_at_rest(split->rest, true).shear;
}

bool runs(const Scene& scene, std::string_view model) {
  return std::ranges::find(scene.models, model) != scene.models.end();
}

/// The reason why the bulk term of a compressible body cannot be projected; empty if it can.
const char* obstacle(const Scene& scene) {
  const auto ratio = ratio_of_moduli(scene);
  if (!ratio) return "this law has no bulk term that depends on det F alone, so there is nothing to project";
  if (*ratio < least_ratio) return "a projected bulk term is for Lame lambda of at least 100 shear moduli";
  if (runs(scene, "continuum") && scene.continuum.degree == 1)
    return "the projection needs elements of degree 2 or more";
  if (scene.time.method != automatic && scene.time.method != "rattle" && scene.time.method != "symmetric-4")
    return "only the methods rattle and symmetric-4 integrate a projected bulk term, which is implicit in time";
  if (loads::present(scene.loads.get<loads::RigidPlanes>()))
    return "contact excites pressure waves, which a projected bulk term does not resolve";
  if (starts_from_own_figure(scene)) return "figures have a pointwise bulk term, and so have motions from them";
  return nullptr;
}

}  // namespace

bool projects_bulk(const Scene& scene) {
  return !scene.body.incompressible && scene.analysis == Analysis::motion && scene.material.bulk == Bulk::projected;
}

std::optional<std::string> warning_of_locking(const Scene& scene) {
  constexpr int first_degree = 3, last_degree = 5;
  constexpr double large = 0.01;  // violence of a large motion
  if (!runs(scene, "polynomial") || scene.body.incompressible || scene.analysis != Analysis::motion ||
      projects_bulk(scene))
    return {};
  const bool is_of_low_degree =
      std::ranges::any_of(scene.polynomial.degrees, [](int N) { return first_degree <= N && N <= last_degree; });
  if (!is_of_low_degree || obstacle(scene) || violence_of_start(scene) < large) return {};
  return fmt::format(
      "Material/Bulk: in large motions polynomial bodies of degree {} to {} lock at lambda/mu = {:.3g}; projected "
      "avoids it",
      first_degree, last_degree, *ratio_of_moduli(scene));
}

std::optional<Refusal> refuses_bulk(const Scene& scene) {
  if (scene.material.bulk != Bulk::projected) return {};
  const char* reason = scene.body.incompressible ? "an incompressible body has no bulk term" : obstacle(scene);
  if (!reason) return {};
  return Refusal{"Material/Bulk", reason, {{{"Material/Bulk", "pointwise"}}}};
}

}  // namespace pseudorigid::scene
