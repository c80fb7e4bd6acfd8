#pragma once
/// Follows a curve of steady motions (arclength_curve.h) with step control, locates its special points to round-off,
/// and changes to the branches that cross it.
///
/// A step is accepted where the tangent turns by less than a limit, so that the curve does not jump to a neighbour; it
/// grows while the tangent hardly turns.

#include <string>
#include <vector>

#include "reduced/equilibrium_families.h"
#include "support/arclength_curve.h"

namespace pseudorigid::reduced {

struct ContinuationOptions {
  double first_step = 0.01, longest_step = 0.05;  ///< arclength in (ln a, ω, Λ, λ)
  int n_steps = 400;
  double parameter_least = -HUGE_VAL, parameter_most = HUGE_VAL;  ///< the curve is left where it leaves this range
};

/// A curve from a motion on it. EquilibriumPoint::parameter is the value of `parameter`.
struct ContinuedFamily : EquilibriumFamily {
  std::vector<CurvePoint> branch_points;  ///< where switch_branch can leave, in the order of their special points
  std::string end;                        ///< why it ended, where it did before the range or the steps were used up
};

template <SmoothPotential V>
class Continuation {
 public:
  /// The curve on which `condition` holds, its folds being those of `parameter`.
  Continuation(const IsotropicBody<V>& body, const Target& condition, Quantity parameter)
      : curve_(body, condition), parameter_(parameter) {}

  const ArclengthCurve<V>& curve() const { return curve_; }

  /// From a motion on the curve, towards rising parameter (direction = 1) or falling (−1).
  ContinuedFamily follow(const SteadyMotion& start, int direction, const ContinuationOptions& options) const {
    CurvePoint point;
    if (mechanics::Status status = curve_.begin(start, parameter_, point); !status) return ended(status.reason());
    if (direction < 0) point = reversed(point);
    return follow(point, options);
  }

  /// Along the branch that crosses at a branch point, to one side (direction = ±1).
  ContinuedFamily follow_branch(const CurvePoint& crossing, int direction, const ContinuationOptions& options) const {
    CurvePoint point;
    if (mechanics::Status status = curve_.switch_branch(crossing, direction * options.first_step, point); !status)
      return ended(status.reason());
    return follow(point, options);
  }

  ContinuedFamily follow(CurvePoint point, const ContinuationOptions& options) const {
    constexpr double smallest_step = 1e-8, turn_to_reject = 0.15, turn_to_grow = 0.05;  // of the unit tangent
    ContinuedFamily family;
    if (mechanics::Status status = append(point, family); !status) return ended(status.reason());
    double h = options.first_step;
    for (int n = 0; n < options.n_steps; ++n) {
      CurvePoint next;
      mechanics::Status status = curve_.point_at(point, h, next);
      while (!status || (next.tangent - point.tangent).norm() > turn_to_reject) {
        if ((h /= 2) < smallest_step) {
          family.end = status ? "the curve turns too sharply to be followed" : status.reason();
          return family;
        }
        status = curve_.point_at(point, h, next);
      }
      const double parameter = value_of(parameter_, next.u);
      if (parameter < options.parameter_least || parameter > options.parameter_most) return family;
      locate(point, h, family);
      if (status = append(next, family); !status) {
        family.end = status.reason();
        return family;
      }
      if ((next.tangent - point.tangent).norm() < turn_to_grow) h = std::min(1.5 * h, options.longest_step);
      point = next;
    }
    return family;
  }

 private:
  static ContinuedFamily ended(std::string reason) {
    ContinuedFamily family;
    family.end = std::move(reason);
    return family;
  }
  static CurvePoint reversed(CurvePoint point) {
    point.tangent = -point.tangent;
    return point;
  }
  mechanics::Status describe(const CurvePoint& point, EquilibriumPoint& equilibrium) const {
    return describe_equilibrium(curve_.body(), motion_of(point.u), value_of(parameter_, point.u), equilibrium);
  }
  mechanics::Status append(const CurvePoint& point, EquilibriumFamily& family) const {
    EquilibriumPoint equilibrium;
    mechanics::Status status = describe(point, equilibrium);
    if (status) family.points.push_back(equilibrium);
    return status;
  }

  /// Special points within h of a point, in the order in which they are passed.
  void locate(const CurvePoint& from, double h, ContinuedFamily& family) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<SpecialPoint> found;
    const auto along = [&](const auto& test) {
      return [&, test](double s) {
        CurvePoint p;
        return curve_.point_at(from, s, p) ? test(p) : nan;
      };
    };
    const auto slope = along([&](const CurvePoint& p) { return curve_.slope(parameter_, p.u, p.tangent); });
    const auto determinant = along([](const CurvePoint& p) { return p.determinant; });
    if (const auto s = bracketed_root(slope, 0, h)) found.push_back({SpecialKind::fold, *s});
    if (const auto s = bracketed_root(determinant, 0, h)) {
      CurvePoint p;
      if (curve_.point_at(from, *s, p) && !curve_.is_same_motion(p)) found.push_back({SpecialKind::branch_point, *s});
    }
    const StabilityAlong stability = [&](double s) -> std::optional<LinearStability> {
      CurvePoint p;
      LinearStability result;
      if (!curve_.point_at(from, s, p) || !analyse_stability(curve_.body(), motion_of(p.u), result)) return {};
      return result;
    };
    locate_changes_of_stability(stability, 0, h, found);
    std::sort(found.begin(), found.end(), [](const SpecialPoint& a, const SpecialPoint& b) { return a.s < b.s; });
    for (const SpecialPoint& special : found) {
      CurvePoint p;
      EquilibriumPoint equilibrium;
      if (!curve_.point_at(from, special.s, p) || !describe(p, equilibrium)) continue;
      family.special.push_back({special.kind, equilibrium});
      if (special.kind == SpecialKind::branch_point) family.branch_points.push_back(p);
    }
  }

  ArclengthCurve<V> curve_;
  Quantity parameter_;
};

template <class V>
Continuation(const IsotropicBody<V>&, const Target&, Quantity) -> Continuation<V>;

}  // namespace pseudorigid::reduced
