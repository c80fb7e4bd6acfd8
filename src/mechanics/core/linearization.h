#pragma once
/// The two linearisations of a damping force that is not linear in the velocity (damping.h).

namespace pseudorigid::mechanics {

enum class Linearization { tangent, secant };

}  // namespace pseudorigid::mechanics
