#pragma once
/// The elastic force f_n = −∫P(F):∇φ_n of the same discretisation by dealii::MatrixFree and dealii::FEEvaluation, with
/// the geometry stored at the points, unknowns renumbered for the cell loop, which also clears the result, and no test
/// of det F. There are two of them:
///
///   installed     the installed library. Debian's has vectors of one number.
///   equal width   the templates of the same library, compiled with the widest vectors of this processor
///                 (fe_face_evaluation.cpp). The renumbering is that for vectors of one number.

#include <deal.II/grid/tria.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <cmath>
#include <functional>
#include <memory>

#include "materials/ciarlet_geymonat.h"

namespace pseudorigid::benchmarks {

/// A smooth deformation of the ball, far from affine and from inversion.
inline dealii::Point<3> placement(const dealii::Point<3>& X) {
  return {X[0] + 0.1 * std::sin(2 * X[1]), X[1] + 0.1 * X[0] * X[2], X[2] + 0.1 * std::cos(X[0] + 2 * X[1])};
}

class FEEvaluationForce {
 public:
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  virtual ~FEEvaluationForce() = default;
  virtual void force(const Vector& x, Vector& f) const = 0;
  virtual int n_lanes() const = 0;  ///< numbers of a vector
  /// The nodal values of `placement`.
  virtual Vector placed() const = 0;
};

using CellIterator = dealii::Triangulation<3>::cell_iterator;
using Placement = std::function<dealii::Point<3>(const CellIterator& cell, const dealii::Point<3>& xi)>;

/// Degree 2 … 8, with the vectors of the installed library. `position` is that of the point xi of the unit cell.
std::unique_ptr<FEEvaluationForce> make_installed_fe_evaluation(const dealii::Triangulation<3>& triangulation,
                                                                const Placement& position, int degree,
                                                                const materials::CiarletGeymonat& law);
/// The same with the widest vectors of this processor. It is in a shared library of its own, because its types of
/// deal.II have the same names as those of the installed library and other sizes.
[[gnu::visibility("default")]] std::unique_ptr<FEEvaluationForce> make_wide_fe_evaluation(
    const dealii::Triangulation<3>& triangulation, const Placement& position, int degree,
    const materials::CiarletGeymonat& law);

}  // namespace pseudorigid::benchmarks
