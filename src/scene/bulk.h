#pragma once
/// The form in which models with non-affine motions have the bulk term of a compressible body
/// (materials/bulk_energy.h). If it is pointwise, the term belongs to the law at each point, and a step is limited by
/// the speed of pressure waves. If it is projected, the term acts on the projection of ln J on the functions of the
/// pressure, and methods integrate it implicitly (mechanics/methods/rattle.h). The step is then limited by the speed of
/// shear waves.

#include <optional>
#include <string>

#include "scene/catalogue.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// True if models with non-affine motions have a projected bulk term. This is the case for motions of a compressible
/// body if the entry Material/Bulk is `projected`. If the entry is `auto`, λ must also be at least 3000 μ, and the
/// scene must not ask for a method or an element that does not admit the projection.
bool projects_bulk(const Scene& scene);

/// A warning about a pointwise bulk term of polynomial bodies of degree 3 to 5 with λ ≥ 30 μ; otherwise empty. In large
/// motions, these bodies then resist changes of shape too much (locking): measured for the release of
/// benchmarks/nearly_incompressible.py until t = 1, their Q was wrong by 0.01 at λ = 30 μ and by 0.06 at λ = 1000 μ.
std::optional<std::string> warning_of_locking(const Scene& scene, bool has_polynomial_bodies);

/// The refusal of Material/Bulk = projected for a body or a law without a bulk term; otherwise empty.
std::optional<Refusal> refuses_bulk(const Scene& scene);

}  // namespace pseudorigid::scene
