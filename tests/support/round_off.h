#pragma once
/// What round-off may leave of a sum of some ten terms of order 1 to 10.

namespace pseudorigid::testing {

inline constexpr double round_off = 1e-13;

}  // namespace pseudorigid::testing
