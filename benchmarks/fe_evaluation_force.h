#pragma once
/// The elastic force f_n = −∫P(F):∇φ_n of the same discretisation by dealii::MatrixFree and dealii::FEEvaluation of the
/// installed library, with the settings that suit it best: geometry stored at the points, unknowns renumbered for its
/// cell loop, which also clears the result, no test of det F. Debian's library has vectors of one number.

#include <memory>

#include "continuum/mesh/ball_mesh.h"
#include "continuum/parallel/types.h"
#include "materials/ciarlet_geymonat.h"

namespace pseudorigid::benchmarks {

/// A smooth deformation of the ball, far from affine and from inversion.
dealii::Point<3> placement(const dealii::Point<3>& X);

class FEEvaluationForce {
 public:
  virtual ~FEEvaluationForce() = default;
  virtual void force(const continuum::Vector& x, continuum::Vector& f) const = 0;
  /// The nodal values of `placement`.
  virtual continuum::Vector placed() const = 0;
};

/// Degree 2 … 8.
std::unique_ptr<FEEvaluationForce> make_fe_evaluation_force(const continuum::BallMesh& mesh, int degree,
                                                            const materials::CiarletGeymonat& law);

}  // namespace pseudorigid::benchmarks
