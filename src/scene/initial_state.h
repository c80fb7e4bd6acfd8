#pragma once
/// Conditions on the initial state of the ball, and the exact projection of an almost isochoric state.
///
/// For an incompressible body, with c = sqrt(shear modulus/density), the conditions are |det Q0 - 1| <= 1e-8 and
/// |tr(Q0^-1 Qdot0)| r/c <= 1e-8. The projection then makes det Q0 = 1 and tr(Q0^-1 Qdot0) = 0 up to round-off by
///     Q0    <- Q0 (det Q0)^(-1/3),
///     Qdot0 <- Qdot0 - tr(Q0^-1 Qdot0)/|Q0^-1|^2 Q0^-T     (orthogonal projection onto the tangent space of det = 1).

#include <optional>

#include "entries/matrix3.h"
#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Refuses entries of the initial state that are too large or too small, and a deformation with det Q0 <= 0.
std::optional<Refusal> refuses_initial_state(const Scene& scene);

/// Projects the initial state of an incompressible body. Returns the reason if its distance from an isochoric state is
/// too large.
std::optional<Refusal> make_isochoric(Scene& scene);

/// Returns Q0 (det Q0)^(-1/3). Zeros remain zero. A matrix that is exact up to round-off is returned unchanged.
Matrix3 project_deformation(const Matrix3& deformation);

/// The orthogonal projection of Qdot0 (formula above). A matrix that is exact up to round-off is returned unchanged.
Matrix3 project_velocity(const Matrix3& deformation, const Matrix3& velocity);

}  // namespace pseudorigid::scene
