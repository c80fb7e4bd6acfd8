#pragma once
/// The stages of one step of Gauss collocation (gauss_16.h) as plain numbers. Kernels that are compiled for several
/// instruction sets (kernel_builds.h) take these numbers as arguments. The types contain no Eigen types, because their
/// alignment would depend on the instruction set.
///
/// A quantity has one number for each of the 8 stages. The 8 numbers of a quantity are the lanes of a vector.

#include <array>
#include <cstddef>

#include "mechanics/core/gauss_coefficients.h"
#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

/// Lanes of the sums at the end of a step. With the stages a_j of an entry, the size h and the coefficients b_j and
/// c_j, the step is
///   v += Σ h b_j a_j,   q += h v + Σ h² b_j (1 − c_j) a_j.
/// `velocity` and `position` are the two sums. The sums `…_low` have the rounding errors of the coefficients in place
/// of the coefficients. These two sums may be 0 unless the stages are iterated to round-off. `legendre_…` are the
/// Legendre coefficients of orders 6 and 7 of the polynomial through the stages.
enum GaussSum : std::size_t { velocity, position, legendre_6, legendre_7, velocity_low, position_low };

/// One number for each stage, aligned to 64 bytes for vector instructions.
struct alignas(64) OfStages : std::array<double, gauss::n_stages> {};

/// Coefficients of a step of size h, from the c_i, b_j, A = (a_ij) and Lagrange polynomials ℓ_j of
/// gauss_coefficients.h. Column j of a matrix contains the coefficients for all stages i and is one vector.
struct GaussTables {
  using Columns = std::array<OfStages, gauss::n_stages>;
  Columns a{};                       ///< h a_ij
  Columns a_squared{};               ///< h² (A²)_ij
  Columns a_low{}, a_squared_low{};  ///< rounding errors of `a` and `a_squared`
  Columns guess{};                   ///< ℓ_j(1 + r c_i), for a guess from the stages of a step of size h/r
  Columns sums{};                    ///< column j: the coefficients of a_j in the sums of GaussSum
  OfStages c{};                      ///< h c_i
  OfStages c_low{};                  ///< rounding errors of `c`
  double h = 0, ratio = 0;           ///< h, and the ratio r of `guess`

  /// Sets h, and all coefficients except `guess`.
  void set_step(double step);
  /// Sets `ratio` and `guess`. r is the size of this step divided by the size of the last step.
  void set_ratio(double r);
};

/// The problem of one step and its solution. The pointers refer to arrays of the caller.
struct GaussStages {
  int n = 0;            ///< number of entries of q
  double t = 0, h = 0;  ///< start and size of the step
  /// Position q and velocity v at the start of the step, n numbers each.
  const double* q = nullptr;
  const double* v = nullptr;
  const GaussTables* tables = nullptr;
  const OfStages* last = nullptr;  ///< stages of the last step, for the guess of `a`. If null, `a` contains the guess.
  /// Bound of the error of the accelerations at which the iteration ends. If it is 0, the bound is the round-off of the
  /// accelerations divided by 4096.
  double tolerance = 0;
  double outer_h = 0;  ///< length of the whole step, of which this step may be a part

  OfStages* a = nullptr;        ///< the stages, which are accelerations: n quantities, set by the solution
  OfStages* sums = nullptr;     ///< the sums of GaussSum for each of the n entries, set by the solution
  OfStages* scratch = nullptr;  ///< memory for n_scratch · n quantities
  static constexpr std::size_t n_scratch = 5;

  bool converged = false;
  long n_iterations = 0;  ///< total number of iterations of all solves
  /// `tail` is the largest |Legendre coefficient| of order 6 or 7, divided by the larger of `scale` and the round-off
  /// of the accelerations. On entry `scale` is the largest acceleration in the last step. The first iteration sets
  /// `scale` to the largest acceleration.
  double tail = 0, scale = 0;
};

/// A field that is evaluated at all stages: q[k][i] and v[k][i] are entry k at stage i. `evaluate` sets a[k][i] to the
/// acceleration of entry k at stage i, and returns false if the field fails.
struct GaussField {
  virtual bool evaluate(const GaussStages& stages, const OfStages* q, const OfStages* v, OfStages* a) const = 0;

 protected:
  ~GaussField() = default;
};

/// Solves for the stages of any field by calls of `field.evaluate`. Sets stages.converged to true if the iteration
/// converges and the field does not fail, otherwise to false. Throws NoKernels if no build of the iteration can be
/// chosen (kernel_builds.h).
void solve_gauss_stages(const GaussField& field, GaussStages& stages);

}  // namespace pseudorigid::mechanics
