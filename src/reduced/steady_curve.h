#pragma once
/// Curves of steady motions. The six equations of principal_plane.h and one condition c(u) = value define a curve in
/// the space of the eight unknowns u. Examples of the condition are Λ₃ = 0, a circulation, or an axis ratio. Let DF be
/// the derivative of these seven equations. The tangent t of the curve satisfies DF t = 0, |t| = 1. A fold of a
/// quantity q is a point of the curve with ∇q·t = 0. The derivatives are exact.

#include "reduced/principal_plane.h"

namespace pseudorigid::reduced {

/// Two directions in the space of u that the first seven rows of DF determine. `first` is a null direction of these
/// rows. `second` is the right singular vector of the smallest singular value of these rows. `second_singular_value` is
/// this singular value divided by the largest singular value. At a crossing with another curve, both directions are
/// null.
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

  /// Sets F and DF at u: rows 0–5 are the equations of the motions, row 6 is the condition, and row 7 is not set.
  void evaluate(const PlaneVector& u, PlaneVector& F, PlaneMatrix& DF) const {
    steady_equations(body_, u, F, DF);
    const PlaneDual c = condition_.quantity(mechanics::independent<double, 8>(u));
    F[6] = c.value() - condition_.value;
    DF.row(6) = c.derivatives().transpose();
  }

  /// The unit tangent of the curve at u, with a component along `along` that is not negative.
  PlaneVector tangent_at(const PlaneVector& u, const PlaneVector& along) const {
    PlaneVector F;
    PlaneMatrix DF;
    evaluate(u, F, DF);
    return tangent(DF, along);
  }

  /// The unit tangent for a given derivative DF, with a positive component along `along`. At a crossing with another
  /// curve, the tangent is the normalized projection of `along` onto the two null directions.
  static PlaneVector tangent(const PlaneMatrix& DF, const PlaneVector& along) {
    constexpr double crossing = 1e-6;
    const NullDirections null = null_directions(DF);
    const PlaneVector t = null.second_singular_value > crossing ? null.first : null.project(along).normalized();
    return t.dot(along) < 0 ? PlaneVector(-t) : t;
  }

  /// The derivative ∇q·t of the quantity q at u along the tangent t.
  static double slope(Quantity q, const PlaneVector& u, const PlaneVector& tangent) {
    return q(mechanics::independent<double, 8>(u)).derivatives().dot(tangent);
  }

 private:
  IsotropicBody<V> body_;
  Target condition_;
};

}  // namespace pseudorigid::reduced
