#pragma once
/// Families of steady motions over a range of a parameter, with stability and special points. The semi-axes of the body
/// are a₁, a₂, a₃. A spheroid has the eccentricity e = √(1 − a₃²/a₁²). If its semi-axes are scaled to the product 1,
/// its polar axis is ℓ = a₃. Its spin is Ω = ω − Λ, with the angular velocity ω and the internal rotation Λ of
/// steady_motion.h. The functions, their parameters and their motions are
///
///   spheroids            e or ℓ                    spheroids: fluid (Maclaurin), elastic, elastic with gravity
///   spheroids_of_spin    Ω                         the same motions, found by Newton's iteration from the sphere
///   jacobi, dedekind     a₂/a₁                     figures with Λ = 0, and their dual motions with ω = 0
///   type_s               a₂/a₁ at fixed a₃/a₁      Riemann S; triaxial elastic figures
///   planar               a₂/a₁ at fixed a₃/a₁      Riemann types I–III, ω and Λ in the plane of axes 2 and 3
///
/// If there is no steady motion for a parameter, the family lists the parameter with the reason.

#include <functional>
#include <string>
#include <vector>

#include "mechanics/equilibria/special_points.h"
#include "reduced/ellipsoidal_motions.h"
#include "reduced/equilibrium_point.h"
#include "reduced/steady_curve.h"

namespace pseudorigid::reduced {

using mechanics::SpecialKind, mechanics::SpecialPoint, mechanics::StabilityAlong;

/// The n values from first to last, both included, with equal distances. For n = 1 the only value is `first`.
struct ParameterRange {
  double first, last;
  int n;
  std::function<bool()> give_up{};  ///< called before each value, if set; if it returns true, the family ends
  double value(int k) const { return k == 0 ? first : k == n - 1 ? last : first + (last - first) * k / (n - 1); }
};

/// A special point of the family with its kind: a fold or a change of stability.
struct SpecialEquilibrium {
  SpecialKind kind;
  EquilibriumPoint point;
};

/// A parameter without a steady motion, and the reason.
struct NoEquilibrium {
  double parameter;
  std::string reason;
};

/// The steady motions that were found, in the order of the parameters, and the special points between them. `missing`
/// has the parameters without a motion.
struct EquilibriumFamily {
  std::vector<EquilibriumPoint> points;
  std::vector<SpecialEquilibrium> special;
  std::vector<NoEquilibrium> missing;
};

/// The quantity that is constant along a family, and the quantity whose extrema along the family are folds.
struct FamilyCurve {
  Target condition;
  Quantity fold_quantity;
};

namespace detail {

/// Appends the folds and changes of stability between the parameters a and b to result.special. The function motion(p,
/// m) sets m to the motion with the parameter p and returns a Status. Points whose motion cannot be computed are left
/// out.
template <SmoothPotential V, class MotionOfParameter>
void locate_special_equilibria(const IsotropicBody<V>& body, const MotionOfParameter& motion, const FamilyCurve& family,
                               double a, double b, EquilibriumFamily& result) {
  std::vector<SpecialPoint> found;
  const StabilityAlong stability = [&](double p) -> std::optional<LinearStability> {
    SteadyMotion m;
    LinearStability s;
    if (!motion(p, m) || !analyse_stability(body, m, s)) return std::nullopt;
    return s;
  };
  locate_changes_of_stability(stability, a, b, found);

  const auto coordinates = [&](double p) -> PlaneVector {
    SteadyMotion m;
    if (!motion(p, m)) return PlaneVector::Constant(std::numeric_limits<double>::quiet_NaN());
    return plane_coordinates(m);
  };
  const SteadyCurve curve(body, family.condition);
  const PlaneVector forward = coordinates(b) - coordinates(a);
  const auto slope = [&](double p) {
    const PlaneVector u = coordinates(p);
    if (!u.allFinite()) return u[0];
    return curve.slope(family.fold_quantity, u, curve.tangent_at(u, forward));
  };
  if (const auto p = bracketed_root(slope, a, b); p && std::abs(slope(*p)) < 1e-6)
    found.push_back({SpecialKind::fold, *p});

  for (const SpecialPoint& special : found) {
    SteadyMotion m;
    EquilibriumPoint point;
    if (motion(special.s, m) && describe_equilibrium(body, m, special.s, point))
      result.special.push_back({special.kind, point});
  }
}

}  // namespace detail

/// Returns the family of the motions with the parameters of `range`. motion(p, m) sets m to the motion with parameter p
/// and returns a Status. A parameter is missing if `motion` fails, if the law does not admit A, or if the stability
/// cannot be computed. Folds and changes of stability are found between adjacent parameters if both have a motion.
template <SmoothPotential V, class MotionOfParameter>
EquilibriumFamily equilibrium_family(const IsotropicBody<V>& body, const ParameterRange& range,
                                     const FamilyCurve& family, const MotionOfParameter& motion) {
  EquilibriumFamily result;
  bool previous = false;
  for (int k = 0; k < range.n && !(range.give_up && range.give_up()); ++k) {
    const double p = range.value(k);
    SteadyMotion m;
    EquilibriumPoint point;
    mechanics::Status status = motion(p, m);
    if (status) status = body.admissible(m.A);
    if (status) status = describe_equilibrium(body, m, p, point);
    if (status) {
      if (previous) detail::locate_special_equilibria(body, motion, family, result.points.back().parameter, p, result);
      result.points.push_back(point);
    } else {
      result.missing.push_back({p, status.reason()});
    }
    previous = status.ok();
  }
  return result;
}

/// The parameter of a spheroid: the eccentricity e, or the polar axis ℓ after scaling to det A = 1.
enum class SpheroidParameter { eccentricity, polar_axis };

template <SmoothPotential V>
EquilibriumFamily spheroids(const IsotropicBody<V>& body, SpheroidParameter parameter, const ParameterRange& range) {
  const auto motion = [&](double p, SteadyMotion& m) {
    const double ratio = parameter == SpheroidParameter::eccentricity ? std::sqrt((1 - p) * (1 + p)) : p * std::sqrt(p);
    if (!(ratio > 0)) return mechanics::Status::failure("there is no spheroid with this parameter");
    return motion_of_shape(
        body, axes_of_ratios(1, ratio),
        [&](const Eigen::Vector3d& a, SteadyMotion& of_axes) { return spheroid_motion(body, a[0], a[2], of_axes); }, m);
  };
  return equilibrium_family(body, range, {{quantities::Lambda_3, 0}, quantities::omega_3}, motion);
}

template <SmoothPotential V>
EquilibriumFamily jacobi(const IsotropicBody<V>& body, const ParameterRange& a2_to_a1) {
  const auto motion = [&](double p, SteadyMotion& m) { return jacobi_motion(body, p, m); };
  return equilibrium_family(body, a2_to_a1, {{quantities::Lambda_3, 0}, quantities::omega_3}, motion);
}

template <SmoothPotential V>
EquilibriumFamily dedekind(const IsotropicBody<V>& body, const ParameterRange& a2_to_a1) {
  const auto motion = [&](double p, SteadyMotion& m) {
    mechanics::Status status = jacobi_motion(body, p, m);
    m = m.dual();
    return status;
  };
  return equilibrium_family(body, a2_to_a1, {{quantities::omega_3, 0}, quantities::Lambda_3}, motion);
}

/// Returns the family of the motions of type S with ω ≥ |Λ|. If `dual` is true, returns the family of the dual motions,
/// in which ω and Λ are exchanged.
template <SmoothPotential V>
EquilibriumFamily type_s(const IsotropicBody<V>& body, const ParameterRange& a2_to_a1, double a3_to_a1,
                         bool dual = false) {
  const auto motion = [&](double p, SteadyMotion& m) {
    mechanics::Status status = motion_of_shape(
        body, axes_of_ratios(p, a3_to_a1),
        [&](const Eigen::Vector3d& a, SteadyMotion& of_axes) { return type_s_motion(body, a, of_axes); }, m);
    if (dual) m = m.dual();
    return status;
  };
  return equilibrium_family(body, a2_to_a1, {{quantities::axis_ratio_31, a3_to_a1}, quantities::omega_3}, motion);
}

/// Returns the family of the motions with ω and Λ in the plane of axes 2 and 3, for the root p with |p| ≤ 1 of the
/// equation in ellipsoidal_motions.h. If `dual` is true, returns the family for the other root.
template <SmoothPotential V>
EquilibriumFamily planar(const IsotropicBody<V>& body, const ParameterRange& a2_to_a1, double a3_to_a1,
                         bool dual = false) {
  const auto motion = [&](double p, SteadyMotion& m) {
    mechanics::Status status = motion_of_shape(
        body, axes_of_ratios(p, a3_to_a1),
        [&](const Eigen::Vector3d& a, SteadyMotion& of_axes) { return planar_motion(body, a, of_axes); }, m);
    if (dual) m = m.dual();
    return status;
  };
  return equilibrium_family(body, a2_to_a1, {{quantities::axis_ratio_31, a3_to_a1}, quantities::omega_3}, motion);
}

/// Spheroids with given spins Ω. The first motion is found from the sphere at rest, and each other motion from the last
/// motion found. Between two motions the spin changes in eight steps. If the spin has a maximum in the family, this
/// maximum is a fold, and larger spins are missing.
template <SmoothPotential V>
EquilibriumFamily spheroids_of_spin(const IsotropicBody<V>& body, const ParameterRange& Omega) {
  constexpr int n_steps = 8;  // for small steps, Newton's iteration does not change to another branch
  SteadyMotion last;
  (void)motion_of_shape(
      body, Eigen::Vector3d::Ones(),
      [&](const Eigen::Vector3d& a, SteadyMotion& m) { return spheroid_motion(body, a[0], a[2], m); }, last);
  const auto motion = [&](double spin, SteadyMotion& m) {
    m = last;
    const double from = last.omega[2];
    for (int k = 1; k <= n_steps; ++k) {
      const double step = from + (spin - from) * k / n_steps;
      if (mechanics::Status status =
              find_steady_motion(body, {Target{quantities::omega_3, step}, Target{quantities::Lambda_3, 0}}, m);
          !status)
        return status;
    }
    last = m;
    return mechanics::Status();
  };
  return equilibrium_family(body, Omega, {{quantities::Lambda_3, 0}, quantities::omega_3}, motion);
}

}  // namespace pseudorigid::reduced
