#pragma once
/// The two linearisations of a damping force F(q, v) (damping.h). `tangent` is the operator −∂F/∂v. `secant` is the
/// operator S with F(q, v) = F(q, 0) − S v. The two operators are equal if F is linear in v.

namespace pseudorigid::mechanics {

enum class Linearization { tangent, secant };

}  // namespace pseudorigid::mechanics
