#pragma once
/// A zero of a continuous function between two points with opposite signs. The method is inverse quadratic
/// interpolation if it is safe, and bisection otherwise (Chandrupatla, Adv. Eng. Software 28 (1997) 145). It ends at an
/// exact zero, or if the bracket is as narrow as `resolution` or consists of neighbouring numbers.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pseudorigid::mechanics {

/// The zero of f. Empty if f(a) and f(b) have the same sign, or if a value of f is not finite. A jump across zero
/// counts as a zero. `resolution` is the relative width of the last bracket.
template <class Function>
std::optional<double> bracketed_root(const Function& f, double a, double b,
                                     double resolution = std::numeric_limits<double>::epsilon()) {
  constexpr int max_evaluations = 200;
  double fa = f(a), fb = f(b);
  if (fa == 0) return a;
  if (fb == 0) return b;
  if (!(fa * fb < 0)) return std::nullopt;
  double t = 0.5;
  for (int i = 0; i < max_evaluations; ++i) {
    const double x = a + t * (b - a), fx = f(x);
    if (!std::isfinite(fx)) return std::nullopt;
    double c = a, fc = fa;  // the end that is left out of the bracket
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
