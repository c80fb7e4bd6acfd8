#pragma once
/// Curves of steady motions: the six equations of principal_plane.h and one condition c(u) = value (Λ₃ = 0, a
/// circulation, an axis ratio, …) leave one dimension of the eight, followed by pseudo-arclength (Keller 1977):
///
///   predictor u₀ + s t₀,   corrector F(u) = 0, c(u) = value, t₀·(u − u₀) = s,   DF t = 0, |t| = 1.
///
/// Along a curve, with exact derivatives,
///   fold of a quantity q:  ∇q·t = 0;    simple branch point:  det[DF; t₀ᵀ] = 0 (Allgower, Georg; t·t₀ > 0),
/// and both are smooth functions of s that change sign, so that they are located to round-off. At a branch point the
/// null space of DF is t and one more direction, along which the other branch leaves.

#include "reduced/principal_plane.h"

namespace pseudorigid::reduced {

struct CurvePoint {
  PlaneVector u, tangent;
  double determinant = 0;  ///< of [DF; t₀ᵀ], with t₀ of the point that this one was reached from
};

namespace detail {

/// The null direction of the first seven rows, the one of their smallest singular value, and that value over the
/// largest one.
struct NullDirections {
  PlaneVector first, second;
  double second_singular_value;
  PlaneVector project(const PlaneVector& x) const { return first.dot(x) * first + second.dot(x) * second; }
};
NullDirections null_directions(const PlaneMatrix& DF);

}  // namespace detail

template <SmoothPotential V>
class SteadyCurve {
 public:
  SteadyCurve(const IsotropicBody<V>& body, const Target& condition) : body_(body), condition_(condition) {}

  const IsotropicBody<V>& body() const { return body_; }

  /// The point of the curve nearest to u in the direction across `along`, its tangent turned to `along`.
  mechanics::Status point_near(const PlaneVector& u, const PlaneVector& along, CurvePoint& point) const {
    PlaneVector x = u;
    const auto equations = [&](const PlaneVector& y, PlaneVector& F, PlaneMatrix& DF) {
      evaluate(y, F, DF);
      F[7] = along.dot(y - u);
      DF.row(7) = along.transpose();
    };
    if (mechanics::Status status = detail::plane_newton(equations, detail::equations_scale(body_, x), x); !status)
      return status;
    point.u = x;
    PlaneVector F;
    PlaneMatrix DF;
    evaluate(x, F, DF);
    point.tangent = tangent(DF, along);
    DF.row(7) = along.transpose();
    point.determinant = DF.determinant();
    return {};
  }

  /// The unit tangent of the curve at u, turned to `along`.
  PlaneVector tangent_at(const PlaneVector& u, const PlaneVector& along) const {
    PlaneVector F;
    PlaneMatrix DF;
    evaluate(u, F, DF);
    return tangent(DF, along);
  }

  /// The point at arclength s along the tangent of `start`.
  mechanics::Status point_at(const CurvePoint& start, double s, CurvePoint& point) const {
    return point_near(start.u + s * start.tangent, start.tangent, point);
  }

  /// A first point: the curve's point at a motion that lies on it, with its tangent towards rising `parameter`.
  mechanics::Status begin(const SteadyMotion& motion, Quantity parameter, CurvePoint& point) const {
    const PlaneVector u = plane_coordinates(to_principal_plane(motion));
    PlaneVector F;
    PlaneMatrix DF;
    evaluate(u, F, DF);
    const PlaneVector tangent = detail::null_directions(DF).first;
    return point_near(u, slope(parameter, u, tangent) < 0 ? PlaneVector(-tangent) : tangent, point);
  }

  /// A point of the branch that crosses this curve at `crossing`, at a distance along it; positive: to where the first
  /// of the coordinates that change grows; negative: to the other side.
  mechanics::Status switch_branch(const CurvePoint& crossing, double distance, CurvePoint& point) const {
    PlaneVector F;
    PlaneMatrix DF;
    evaluate(crossing.u, F, DF);
    const detail::NullDirections null = detail::null_directions(DF);
    PlaneVector across =
        (null.first.dot(crossing.tangent) * null.second - null.second.dot(crossing.tangent) * null.first).normalized();
    for (int i = 0; i < 8; ++i)
      if (std::abs(across[i]) > 0.1) {
        if (across[i] < 0) across = -across;
        break;
      }
    return point_near(crossing.u + distance * across, distance < 0 ? PlaneVector(-across) : across, point);
  }

  /// Whether the branch that crosses there is only the same motion seen otherwise: where two axes coincide, the same
  /// spin about the third can be added to ω and Λ, or both can be turned about it, and nothing moves differently.
  bool is_same_motion(const CurvePoint& crossing) const {
    constexpr double equal = 1e-4;  // such points are located less sharply than others
    PlaneVector F;
    PlaneMatrix DF;
    evaluate(crossing.u, F, DF);
    const auto on_curve = [&](const PlaneVector& g) {
      return (DF.topRows<7>() * g).norm() <= equal * DF.topRows<7>().norm() * g.norm();
    };
    const PlaneVector& u = crossing.u;
    PlaneVector spin = PlaneVector::Zero(), turn = PlaneVector::Zero();
    spin[4] = spin[6] = 1;
    turn.segment<4>(3) << u[4], -u[3], u[6], -u[5];
    return (std::abs(u[0] - u[1]) <= equal && on_curve(spin)) || (std::abs(u[1] - u[2]) <= equal && on_curve(turn));
  }

  /// ∇q·t
  static double slope(Quantity q, const PlaneVector& u, const PlaneVector& tangent) {
    return q(mechanics::independent<double, 8>(u)).derivatives().dot(tangent);
  }

 private:
  /// Rows 0–5: F; row 6: the condition; row 7 is left free.
  void evaluate(const PlaneVector& u, PlaneVector& F, PlaneMatrix& DF) const {
    steady_equations(body_, u, F, DF);
    const PlaneDual c = condition_.quantity(mechanics::independent<double, 8>(u));
    F[6] = c.value() - condition_.value;
    DF.row(6) = c.derivatives().transpose();
  }
  /// At a branch point both directions are null, and the curve goes on along `along`.
  static PlaneVector tangent(const PlaneMatrix& DF, const PlaneVector& along) {
    constexpr double branch_point = 1e-6;
    const detail::NullDirections null = detail::null_directions(DF);
    const PlaneVector t = null.second_singular_value > branch_point ? null.first : null.project(along).normalized();
    return t.dot(along) < 0 ? PlaneVector(-t) : t;
  }

  IsotropicBody<V> body_;
  Target condition_;
};

}  // namespace pseudorigid::reduced
