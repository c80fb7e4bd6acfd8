#pragma once
/// Krylov's iteration for G(q₁)M⁻¹G(q₀)ᵀλ = r by PETSc: conjugate gradients where q₁ = q₀, else GMRES. Options of PETSc
/// with the prefix gram_ override what is chosen here.

#include <petscksp.h>

#include <functional>

#include "continuum/types.h"
#include "mechanics/status.h"

namespace pseudorigid::continuum {

class GramKrylov {
 public:
  using Operator = std::function<void(Vector& result, const Vector& x)>;

  /// For vectors like `like`; `multiply` and `precondition` are called in every iteration.
  GramKrylov(const Vector& like, Operator multiply, Operator precondition);
  ~GramKrylov();
  GramKrylov(const GramKrylov&) = delete;
  GramKrylov& operator=(const GramKrylov&) = delete;

  /// λ with |S λ − r| ≤ reduction · |r|. Fails if that is not reached in 200 iterations.
  mechanics::SolveReport solve(bool symmetric, const Vector& r, double reduction, Vector& lambda);

 private:
  struct Bound {
    Operator apply;
    Vector in, out;
  };
  static PetscErrorCode multiply(Mat matrix, Vec in, Vec out);
  static PetscErrorCode precondition(PC preconditioner, Vec in, Vec out);
  static PetscErrorCode apply(Bound& bound, Vec in, Vec out);
  void make(KSP& solver, KSPType type);

  Bound multiply_, precondition_;
  Mat matrix_ = nullptr;
  KSP symmetric_ = nullptr, mixed_ = nullptr;
  Vec r_ = nullptr, lambda_ = nullptr;
};

}  // namespace pseudorigid::continuum
