#pragma once
/// Special points along a family of relative equilibria. The family is a curve of solutions of equations F = 0, with
/// the tangent t. Each kind of special point is a zero of a smooth test function, which can be located to round-off.
/// Below, t₀ is the tangent at a fixed point nearby, J the angular momentum and Z the circulation. The functions of
/// this header locate only index points and instabilities. The kinds of special points are
///
///   fold          a quantity q of the family (angular velocity or a momentum) has an extremum: ∇q·t = 0
///   branch point  another branch of steady motions crosses:                          det[DF; t₀ᵀ] = 0
///   index         the number of negative eigenvalues of the second variation of the energy at fixed J and Z changes:
///                 the k-th eigenvalue in increasing order is zero, and a rate of the motion passes through 0. Without
///                 dissipation the motion may remain stable. With dissipation it may become unstable, as Maclaurin's
///                 spheroid does at Jacobi's bifurcation ("secular instability"). The number also jumps by 2 if J or Z
///                 passes through 0, which is not a change of the motion.
///   instability   rates leave the imaginary axis or return to it: two rates of opposite energy collide (Krein), or a
///                 pair ±s collides at 0
///
/// Beyond an instability, the largest real part of the rates grows like a square root, and the error of its value is
/// large. For the two colliding rates s, s', however,
///
///     δ = Re (s − s')²
///
/// is a smooth function of the parameter of the family. On the stable side of the collision, δ is −(difference of
/// frequencies)². On the unstable side, δ is (2 growth rate)². Imaginary rates with equal signs of the energy ½x̄ᵀSx
/// cannot leave the imaginary axis and are omitted. Here x is the eigenvector of a rate (linear_stability.h).

#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "mechanics/core/bracketed_root.h"
#include "mechanics/equilibria/linear_stability.h"

namespace pseudorigid::mechanics {

enum class SpecialKind { fold, branch_point, index, instability };

inline const char* name_of(SpecialKind kind) {
  switch (kind) {
    case SpecialKind::fold:
      return "fold";
    case SpecialKind::branch_point:
      return "branch point";
    case SpecialKind::index:
      return "index";
    case SpecialKind::instability:
      return "instability";
  }
  return "";
}

struct SpecialPoint {
  SpecialKind kind;
  double s;  ///< value of the parameter at the special point
};

/// Returns the largest δ of two rates that can collide, divided by the square of the largest |rate|. This is the test
/// function of instabilities. Returns 0 if all rates are 0, and −∞ if no two rates can collide.
inline double collision(const LinearStability& stability) {
  double largest = 0;
  for (const Rate& r : stability.rates) largest = std::max(largest, std::abs(r.s));
  if (largest == 0) return 0;
  const double tolerance = zero_growth * largest;
  const auto imaginary = [&](const Rate& r) { return std::abs(r.s.real()) <= tolerance; };
  double delta = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < stability.rates.size(); ++i) {
    const Rate& a = stability.rates[i];
    if (a.s.imag() < -tolerance) continue;
    if (imaginary(a) || std::abs(a.s.imag()) <= tolerance) delta = std::max(delta, 4 * (a.s * a.s).real());
    for (std::size_t j = 0; j < i; ++j) {
      const Rate& b = stability.rates[j];
      if (b.s.imag() < -tolerance) continue;
      const bool can_meet = imaginary(a) && imaginary(b) ? a.energy_sign * b.energy_sign <= 0
                                                         : std::abs(a.s + std::conj(b.s)) <= tolerance;
      if (can_meet) delta = std::max(delta, ((a.s - b.s) * (a.s - b.s)).real());
    }
  }
  return delta / (largest * largest);
}

/// A function that returns the linear stability of the relative equilibrium at the parameter s of a family. The result
/// is empty if there is no relative equilibrium at s.
using StabilityAlong = std::function<std::optional<LinearStability>(double s)>;

/// Appends the index points and instabilities between the parameters a and b to `found`. Finds only zeros of test
/// functions that have opposite signs at a and b, and at most one instability. If there is no relative equilibrium at a
/// or b, or if the numbers of eigenvalues at a and b differ, appends nothing. `resolution` is the relative resolution
/// of s (bracketed_root.h).
inline void locate_changes_of_stability(const StabilityAlong& stability, double a, double b,
                                        std::vector<SpecialPoint>& found,
                                        double resolution = std::numeric_limits<double>::epsilon()) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto at_a = stability(a), at_b = stability(b);
  if (!at_a || !at_b || at_a->second_variation.size() != at_b->second_variation.size()) return;
  const auto [least, most] = std::minmax(at_a->n_negative, at_b->n_negative);
  double last = nan;
  for (int k = least; k < most; ++k) {
    const auto eigenvalue = [&](double s) {
      const auto r = stability(s);
      // Near a zero, round-off can change the number of symmetry directions that are removed, and thus the number of
      // eigenvalues.
      if (!r || r->second_variation.size() <= k) return nan;
      const double x = r->second_variation[k];
      return std::abs(x) <= zero_variation ? 0 : x;
    };
    const auto s = bracketed_root(eigenvalue, a, b, resolution);
    // Skip a jump of the eigenvalue through 0, which is not a zero. Also skip a root at the place of the previous root,
    // because two eigenvalues of a spheroid vanish together.
    if (!s || std::abs(eigenvalue(*s)) > 1e-6 || std::abs(*s - last) <= 1e-7 * std::abs(b - a)) continue;
    found.push_back({SpecialKind::index, *s});
    last = *s;
  }
  const auto delta = [&](double s) {
    const auto r = stability(s);
    return r ? collision(*r) : nan;
  };
  if (const auto s = bracketed_root(delta, a, b, resolution); s && std::abs(delta(*s)) < 1e-6)
    found.push_back({SpecialKind::instability, *s});
}

}  // namespace pseudorigid::mechanics
