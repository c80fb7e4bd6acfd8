#pragma once
/// A zero of a continuous function between two points at which the function has opposite signs. Each step is an inverse
/// quadratic interpolation if this is safe, otherwise a bisection (Chandrupatla, Adv. Eng. Software 28 (1997) 145). The
/// iteration ends at an exact zero. It also ends if the width of the bracket is less than 2 · `resolution` · |x|. Here
/// x is the end of the bracket at which the function has the smaller absolute value.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pseudorigid::mechanics {

/// Returns a zero of f in [a, b] (a > b is permitted). If f(a) or f(b) is 0, returns a or b. The result is empty if
/// f(a) and f(b) do not have opposite signs, or if f is not finite at a point inside the bracket. A jump of f across 0
/// counts as a zero. If 200 evaluations inside the bracket are not enough, returns the last point.
template <class Function>
std::optional<double> bracketed_root(const Function& f, double a, double b,
                                     double resolution = std::numeric_limits<double>::epsilon()) {
  constexpr int max_evaluations = 200;
  double fa = f(a), fb = f(b);
  if (fa == 0) return a;
  if (fb == 0) return b;
  if (!(fa < 0 && fb > 0) && !(fa > 0 && fb < 0)) return std::nullopt;
  double t = 0.5;
  for (int i = 0; i < max_evaluations; ++i) {
    const double x = a + t * (b - a), fx = f(x);
    if (!std::isfinite(fx)) return std::nullopt;
    double c = a, fc = fa;  // the end that the new bracket does not contain
    if ((fx > 0) != (fa > 0)) {
      c = b, fc = fb;
      b = a, fb = fa;
    }
    a = x, fa = fx;
    const double best = std::abs(fa) < std::abs(fb) ? a : b;
    const double least = resolution * std::abs(best) / std::abs(b - a);
    if (fa == 0 || least > 0.5) return best;
    const double xi = (a - b) / (c - b), phi = (fa - fb) / (fc - fb);
    t = 0.5;
    if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
      t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
    t = std::clamp(t, least, 1 - least);
  }
  return a;
}

}  // namespace pseudorigid::mechanics
