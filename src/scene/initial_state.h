#pragma once
/// Conditions on the initial state of the ball, and the exact projection of a nearly isochoric one.
///
/// For an incompressible body, with c = sqrt(shear modulus/density): |det Q0 - 1| <= 1e-8 and
/// |tr(Q0^-1 Qdot0)| r/c <= 1e-8 are demanded, and then made exact by
///     Q0    <- Q0 (det Q0)^(-1/3),
///     Qdot0 <- Qdot0 - tr(Q0^-1 Qdot0)/|Q0^-1|^2 Q0^-T     (orthogonal projection onto the tangent space of det = 1).

#include <optional>

#include "entries/matrix3.h"
#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Entries that are too large or too small, and a body that is turned inside out.
std::optional<Refusal> refuses_initial_state(const Scene& scene);

/// Projects the initial state of an incompressible body, or says why it is not near enough.
std::optional<Refusal> make_isochoric(Scene& scene);

/// Q0 (det Q0)^(-1/3); zeros stay zero, and a matrix that is exact up to round-off is returned unchanged.
Matrix3 project_deformation(const Matrix3& deformation);

/// The orthogonal projection of Qdot0 above; unchanged if it is exact up to round-off.
Matrix3 project_velocity(const Matrix3& deformation, const Matrix3& velocity);

}  // namespace pseudorigid::scene
