#pragma once
/// Error of the affine part Q of a motion due to the quadrature of a polynomial body. The function choose_quadrature
/// estimates this error, and can also find the number of points that a tolerance requires. The estimate compares pilot
/// runs with different quadrature rules over the first part of the run, the window. The window has the length w, and
/// the run has the length T. The pilot runs use RATTLE with the same long steps, so that most of the errors of the
/// steps cancel. Let Q be the result with the rule of the body, and Q' the result with another rule, at the times t_k
/// of the window. Let |…| be the largest absolute value of the entries. An estimate is
///
///   e = 6 max_k |Q(t_k) − Q'(t_k)| (T/w)^(3/2).
///
/// One estimate is for the rule in the volume. With self-gravity, a second estimate is for the rule on the surface, and
/// the estimated error is the sum of both.
///
/// For the volume, the rule of Q' has one point more in each direction of an octant. For self-gravity, the rule of Q'
/// has two points less in each direction of an octant of the surface, because the sums of a smaller rule take less
/// time. If the rule of Q has fewer than 4 points in each direction, the rule of Q' has two points more. If the error
/// of the gravity decreases at least with the fourth power of the number of points, the difference of the default rules
/// is at least 0.6 times the error.
///
/// Every rule is exact for affine states, and the body is affine at first, so the difference needs time to develop.
/// Therefore the window is at least 3 r/c, with the radius r and the speed c of shear waves. This is more than a period
/// of the lowest mode. The window is also at least a sixteenth of the run. Shorter runs are covered completely. If the
/// pilot run of Q fails and shorter steps do not help, the window becomes half of the time that the last attempt
/// reached. After the window, the errors of the phases grow in proportion to the time, but inside the window this
/// growth has only begun. Therefore the power is 3/2, as in the pilot runs that choose a step
/// (mechanics/steps/step_search.h). If points are added, w = T. The factor for the volume is then 60 instead of 6,
/// because the errors of the long steps hide more of the difference. The error was at most 0.75 e in the motions from
/// which the factors were chosen. docs/theory.md has the motions that test the factors.
///
/// The estimate does not include instability. If the motion amplifies errors after the window, the error can be larger
/// than e.

#include <functional>
#include <optional>
#include <string>

#include "mechanics/core/constrained_system.h"
#include "polynomial/observe.h"

namespace pseudorigid::polynomial {

/// The power of T/w with which e grows after the window.
inline constexpr double quadrature_growth = 1.5;

struct QuadratureRequest {
  double end = 0;                   ///< length T of the run
  double stable_step = 0;           ///< stability limit of RATTLE; 0 if it is not known
  double tolerance = 1e-6;          ///< largest permitted error of an entry of Q
  bool adds_points = false;         ///< true if points are added until e is at most half of the tolerance
  std::function<bool()> give_up{};  ///< called after every step of a pilot run; if it returns true, the pilot run ends
};

struct QuadratureChoice {
  int n_points = 0;               ///< number of points in the volume, in each direction of an octant
  std::optional<double> error{};  ///< sum of the estimates e; empty after a failure
  std::string reason{};           ///< reason of the failure, or empty
  long n_force = 0;               ///< number of force evaluations in all pilot runs
};

/// Estimates the error of the quadrature of `body`, and adds points in the volume if request.adds_points is true. The
/// function adds at most 8 points in each direction. It also stops if the last point did not halve e. For degree 1 the
/// error is 0, because the motion remains affine. `setup` must be the setup of `body`, and `state` is the state at the
/// start of the run.
template <class Body>
QuadratureChoice choose_quadrature(const BodySetup& setup, const Body& body, const BodyState& state,
                                   const QuadratureRequest& request);

}  // namespace pseudorigid::polynomial
