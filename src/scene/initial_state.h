#pragma once
/// Conditions on the initial state of the ball, and the exact projection of an almost isochoric state.
///
/// For an incompressible body, the conditions are |det Q0 - 1| <= 1e-8 and |tr(Q0^-1 Qdot0)| t <= 1e-8. Here t is the
/// unit of time of scene/scales.h. For an elastic ball without self-gravity, it is the radius divided by the speed of
/// shear waves. The projection then makes det Q0 = 1 and tr(Q0^-1 Qdot0) = 0 up to round-off by
///     Q0    <- Q0 (det Q0)^(-1/3),
///     Qdot0 <- Qdot0 - tr(Q0^-1 Qdot0)/|Q0^-1|^2 Q0^-T     (orthogonal projection onto the tangent space of det = 1).

#include <optional>

#include "entries/matrix3.h"
#include "scene/catalogue.h"

namespace pseudorigid::scene {

/// Refuses det Q0 <= 0 and a condition number of Q0, in the Frobenius norm, above 1e12. Also refuses a Q0 whose largest
/// entry is outside [1e-12, 1e12], and entries of Qdot0 above 1e12/t. Sizes of entries are absolute values. The bounds
/// keep products of such numbers finite and accurate.
std::optional<Refusal> refuses_initial_state(const Scene& scene);

/// Refuses a model's own figure (Initial state/Figure = own) or a small motion (Initial state/Mode) without a relative
/// equilibrium. Also refuses a small motion of a model with non-affine motions, if the model does not start from its
/// own figure. The number of a small motion depends on the model and its discretisation, so a number is refused with
/// several models or degrees, or with a search.
std::optional<Refusal> refuses_starting_figure(const Scene& scene);

/// Projects the initial state of the scene, whose body must be incompressible. If the scene gives an equilibrium, the
/// velocity is neither judged nor projected. If a condition in the head of this file
/// is violated, returns the reason; the scene is then not usable.
std::optional<Refusal> make_isochoric(Scene& scene);

/// Returns Q0 (det Q0)^(-1/3). Zero entries remain zero, so that symmetries remain. If det Q0 is 1 up to round-off,
/// returns Q0 unchanged.
Matrix3 project_deformation(const Matrix3& deformation);

/// Returns the orthogonal projection of Qdot0 (`velocity`) by the formula above, for Q0 = `deformation`. If the trace
/// is zero up to round-off, returns Qdot0 unchanged.
Matrix3 project_velocity(const Matrix3& deformation, const Matrix3& velocity);

}  // namespace pseudorigid::scene
