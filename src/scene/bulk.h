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

/// True if models with non-affine motions have a projected bulk term: in motions of a compressible body, if the entry
/// Material/Bulk is `projected`.
bool projects_bulk(const Scene& scene);

/// A warning about a pointwise bulk term in a large motion of polynomial bodies of degree 3 to 5 if λ ≥ 100 μ;
/// otherwise empty. These bodies resist changes of shape too much (locking). In the release of
/// benchmarks/nearly_incompressible.py until t = 1, Q of degree 3 was wrong by 0.03 at λ = 100 μ and by 0.06 at 1000 μ.
std::optional<std::string> warning_of_locking(const Scene& scene);

/// The refusal of Material/Bulk = projected; otherwise empty. λ must be at least 100 μ. The body, the law, the method
/// and the elements must admit the projection. Contact planes and a start from the own figure of a model do not.
std::optional<Refusal> refuses_bulk(const Scene& scene);

}  // namespace pseudorigid::scene
