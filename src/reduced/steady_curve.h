#pragma once
/// Curves of steady motions: the six equations of principal_plane.h and one condition c(u) = value (Λ₃ = 0, a
/// circulation, an axis ratio, …) leave one dimension of the eight, DF t = 0, |t| = 1. A fold of a quantity q along the
/// curve is where ∇q·t = 0, with exact derivatives.

#include "reduced/principal_plane.h"

namespace pseudorigid::reduced {

/// The null direction of the first seven rows, the one of their smallest singular value, and that value over the
/// largest one. At a point where another curve crosses both directions are null.
struct NullDirections {
  PlaneVector first, second;
  double second_singular_value;
  PlaneVector project(const PlaneVector& x) const { return first.dot(x) * first + second.dot(x) * second; }
};
NullDirections null_directions(const PlaneMatrix& DF);

template <SmoothPotential V>
class SteadyCurve {
 public:
  SteadyCurve(const IsotropicBody<V>& body, const Target& condition) : body_(body), condition_(condition) {}

  const IsotropicBody<V>& body() const { return body_; }

  /// Rows 0–5: F; row 6: the condition; row 7 is left free.
  void evaluate(const PlaneVector& u, PlaneVector& F, PlaneMatrix& DF) const {
    steady_equations(body_, u, F, DF);
    const PlaneDual c = condition_.quantity(mechanics::independent<double, 8>(u));
    F[6] = c.value() - condition_.value;
    DF.row(6) = c.derivatives().transpose();
  }

  /// The unit tangent of the curve at u, turned to `along`.
  PlaneVector tangent_at(const PlaneVector& u, const PlaneVector& along) const {
    PlaneVector F;
    PlaneMatrix DF;
    evaluate(u, F, DF);
    return tangent(DF, along);
  }

  /// The same for the derivatives DF. If another curve crosses, this curve continues along `along`.
  static PlaneVector tangent(const PlaneMatrix& DF, const PlaneVector& along) {
    constexpr double crossing = 1e-6;
    const NullDirections null = null_directions(DF);
    const PlaneVector t = null.second_singular_value > crossing ? null.first : null.project(along).normalized();
    return t.dot(along) < 0 ? PlaneVector(-t) : t;
  }

  /// ∇q·t
  static double slope(Quantity q, const PlaneVector& u, const PlaneVector& tangent) {
    return q(mechanics::independent<double, 8>(u)).derivatives().dot(tangent);
  }

 private:
  IsotropicBody<V> body_;
  Target condition_;
};

}  // namespace pseudorigid::reduced
