#pragma once
/// A curve of steady motions (reduced/steady_curve.h) by pseudo-arclength (Keller 1977):
///
///   predictor u₀ + s t₀,   corrector F(u) = 0, c(u) = value, t₀·(u − u₀) = s.
///
/// A simple branch point is where det[DF; t₀ᵀ] = 0 (Allgower, Georg; t·t₀ > 0), a smooth function of s that changes
/// sign, so that it is located to round-off. There the null space of DF is t and one more direction, along which the
/// other branch leaves.

#include "reduced/steady_curve.h"
#include "support/dense.h"

namespace pseudorigid::reduced {

struct CurvePoint {
  PlaneVector u, tangent;
  double determinant = 0;  ///< of [DF; t₀ᵀ], with t₀ of the point that this one was reached from
};

template <SmoothPotential V>
class ArclengthCurve : public SteadyCurve<V> {
 public:
  using SteadyCurve<V>::SteadyCurve;

  /// The point of the curve nearest to u in the direction across `along`, its tangent turned to `along`.
  mechanics::Status point_near(const PlaneVector& u, const PlaneVector& along, CurvePoint& point) const {
    PlaneVector x = u;
    const auto equations = [&](const PlaneVector& y, PlaneVector& F, PlaneMatrix& DF) {
      this->evaluate(y, F, DF);
      F[7] = along.dot(y - u);
      DF.row(7) = along.transpose();
    };
    if (mechanics::Status status = detail::plane_newton(equations, detail::equations_scale(this->body(), x), x);
        !status)
      return status;
    point.u = x;
    PlaneVector F;
    PlaneMatrix DF;
    this->evaluate(x, F, DF);
    point.tangent = this->tangent(DF, along);
    DF.row(7) = along.transpose();
    point.determinant = testing::determinant(DF);
    return {};
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
    this->evaluate(u, F, DF);
    const PlaneVector tangent = null_directions(DF).first;
    return point_near(u, this->slope(parameter, u, tangent) < 0 ? PlaneVector(-tangent) : tangent, point);
  }

  /// A point of the branch that crosses this curve at `crossing`, at a distance along it; positive: to where the first
  /// of the coordinates that change grows; negative: to the other side.
  mechanics::Status switch_branch(const CurvePoint& crossing, double distance, CurvePoint& point) const {
    PlaneVector F;
    PlaneMatrix DF;
    this->evaluate(crossing.u, F, DF);
    const NullDirections null = null_directions(DF);
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
    this->evaluate(crossing.u, F, DF);
    const auto on_curve = [&](const PlaneVector& g) {
      return (DF.topRows<7>() * g).norm() <= equal * DF.topRows<7>().norm() * g.norm();
    };
    const PlaneVector& u = crossing.u;
    PlaneVector spin = PlaneVector::Zero(), turn = PlaneVector::Zero();
    spin[4] = spin[6] = 1;
    turn.segment<4>(3) << u[4], -u[3], u[6], -u[5];
    return (std::abs(u[0] - u[1]) <= equal && on_curve(spin)) || (std::abs(u[1] - u[2]) <= equal && on_curve(turn));
  }
};

}  // namespace pseudorigid::reduced
