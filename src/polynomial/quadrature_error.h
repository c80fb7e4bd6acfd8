#pragma once
/// Error of Q by the quadrature of a polynomial body, and the number of points that a tolerance requires. The
/// same body with another rule makes another motion. Pilot runs of both over a window w of a run of length T, by RATTLE
/// with the same long steps, whose errors cancel, give
///
///   e = 6 max_k |Q(t_k) − Q'(t_k)| (T/w)^(3/2).
///
/// Every rule is exact for affine states, of which the body is one at first, so the window holds about half a
/// pulsation, or a sixteenth of the run. Beyond it the errors of the phases grow like t, and have hardly begun to in
/// it: hence the power 3/2, as for the pilots of a step (mechanics/steps/step_search.h). If points are added, w = T
/// and the factor of the volume is 60: there the long steps hide more of the difference. In the motions that the
/// factors were chosen with the error was at most 0.75 e. docs/theory.md has those that judge them.
///
/// For the volume, Q' has one point more in each direction of an octant. For self-gravity it has two less on the
/// surface: that costs a quarter, and the difference is no less than the error if that falls with the fourth power.
///
/// It does not include instability: errors that the motion magnifies beyond the window are larger.

#include <functional>
#include <optional>
#include <string>

#include "mechanics/core/constrained_system.h"
#include "polynomial/observe.h"

namespace pseudorigid::polynomial {

/// The power with which e grows beyond the window.
inline constexpr double quadrature_growth = 1.5;

struct QuadratureRequest {
  double end = 0;                   ///< T, from the state on
  double stable_step = 0;           ///< of RATTLE; 0: not known
  double tolerance = 1e-6;          ///< of Q
  bool adds_points = false;         ///< until e is half of the tolerance
  std::function<bool()> give_up{};  ///< asked after every step of a pilot
};

struct QuadratureChoice {
  int n_points = 0;               ///< in each direction of an octant
  std::optional<double> error{};  ///< e; not known if the pilots fail
  std::string reason{};           ///< then, why
  long n_force = 0;               ///< of all pilots
};

/// `setup` is that of the body.
template <class Body>
QuadratureChoice choose_quadrature(const BodySetup& setup, const Body& body, const BodyState& state,
                                   const QuadratureRequest& request);

}  // namespace pseudorigid::polynomial
