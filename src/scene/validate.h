#pragma once
/// Checks of a scene that need several entries, and the exact projection of nearly isochoric initial states.
///
/// For an incompressible body, with c = sqrt(shear modulus/density): |det Q0 - 1| <= 1e-8 and
/// |tr(Q0^-1 Qdot0)| r/c <= 1e-8 are demanded, and then made exact by
///     Q0    <- Q0 (det Q0)^(-1/3),
///     Qdot0 <- Qdot0 - tr(Q0^-1 Qdot0)/|Q0^-1|^2 Q0^-T     (orthogonal projection onto the tangent space of det = 1).

#include "scene/read_scene.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// The scene to run: `scene` with the initial state projected. Throws UserError, one sentence that begins with the
/// origin of the entry and says what was expected.
Scene validate(Scene scene, const Origins& origins = {});

/// Q0 (det Q0)^(-1/3); zeros stay zero, and a matrix that is exact up to round-off is returned unchanged.
Matrix3 project_deformation(const Matrix3& deformation);

/// The orthogonal projection of Qdot0 above; unchanged if it is exact up to round-off.
Matrix3 project_velocity(const Matrix3& deformation, const Matrix3& velocity);

}  // namespace pseudorigid::scene
