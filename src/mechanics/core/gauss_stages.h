#pragma once
/// The stages of one step of Gauss collocation (gauss_16.h) as plain arrays of numbers. These arrays are the arguments
/// of kernels, which are compiled for several instruction sets (kernel_builds.h). The arguments contain no Eigen types,
/// because the alignment of Eigen types depends on the instruction set.
///
/// A quantity has one number for each of the 8 stages. The 8 numbers of a quantity are the lanes of a vector.

#include <array>
#include <cstddef>

#include "mechanics/core/gauss_coefficients.h"
#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

/// Lanes of the sums at the end of a step. With the accelerations a_j of the stages, the step size h, and the weights
/// b_j and nodes c_j of gauss_coefficients.h, the step changes each entry of (q, v) by
///   v += Σ h b_j a_j,   q += h v + Σ h² b_j (1 − c_j) a_j.
/// `velocity` and `position` are the two sums Σ. In `velocity_low` and `position_low`, the rounding errors of the
/// coefficients replace the coefficients. These two may be 0 unless the stages are iterated to round-off. `legendre_6`
/// and `legendre_7` are the Legendre coefficients of orders 6 and 7 of the polynomial through the a_j.
enum GaussSum : std::size_t { velocity, position, legendre_6, legendre_7, velocity_low, position_low };

/// One number for each stage, aligned to 64 bytes for vector instructions.
struct alignas(64) OfStages : std::array<double, gauss::n_stages> {};

/// Coefficients of a step of size h. The c_i, b_j, A = (a_ij) and the Lagrange polynomials ℓ_j are those of
/// gauss_coefficients.h. Column j of a matrix contains the coefficients for all stages i and is one vector.
struct GaussTables {
  using Columns = std::array<OfStages, gauss::n_stages>;
  Columns a{};                       ///< h a_ij
  Columns a_squared{};               ///< h² (A²)_ij
  Columns a_low{}, a_squared_low{};  ///< rounding errors of `a` and `a_squared`
  Columns guess{};                   ///< ℓ_j(1 + r c_i), which extrapolate from the last step of size h/r
  Columns sums{};                    ///< column j: the coefficients of a_j in the sums of GaussSum
  OfStages c{};                      ///< h c_i
  OfStages c_low{};                  ///< rounding errors of `c`
  double h = 0, ratio = 0;           ///< h, and the ratio r of `guess`

  /// Sets h, and all coefficients except `guess`.
  void set_step(double step);
  /// Sets `ratio` to r, and `guess`. The ratio r is the size of this step divided by the size of the last step.
  void set_ratio(double r);
};

/// The problem of one step and its solution. The pointers refer to arrays of the caller.
struct GaussStages {
  int n = 0;            ///< number of entries of q
  double t = 0, h = 0;  ///< start and size of the step
  /// Position q and velocity v at the start of the step, n numbers each.
  const double* q = nullptr;
  const double* v = nullptr;
  /// The coefficients of this step. A caller must call set_step, and also set_ratio if `last` is not null.
  const GaussTables* tables = nullptr;
  const OfStages* last = nullptr;  ///< stages of the last step, for the guess of `a`. If null, `a` contains the guess.
  /// Error of the accelerations at which the iteration ends. If the tolerance is 0, the iteration ends at the round-off
  /// of the accelerations divided by 4096.
  double tolerance = 0;
  double outer_h = 0;  ///< length of the whole step, of which this step may be a part

  OfStages* a = nullptr;        ///< the accelerations at the stages, n quantities; on entry the guess if `last` is null
  OfStages* sums = nullptr;     ///< the sums of GaussSum for each of the n entries, set by the solution
  OfStages* scratch = nullptr;  ///< memory for n_scratch · n quantities
  static constexpr std::size_t n_scratch = 5;

  bool converged = false;
  long n_iterations = 0;  ///< total number of iterations of all solves
  /// Let L be the largest |Legendre coefficient| of order 6 or 7. The solution sets `tail` to L divided by the larger
  /// of `scale` and a bound of the round-off of the accelerations. On entry `scale` is the largest acceleration in the
  /// last step. The first iteration sets `scale` to the largest acceleration.
  double tail = 0, scale = 0;
};

/// A second-order field that is evaluated at all stages. q[k][i] and v[k][i] are entry k of position and velocity at
/// stage i. `evaluate` sets a[k][i] to entry k of the acceleration at stage i. It returns false if the field fails.
struct GaussField {
  virtual bool evaluate(const GaussStages& stages, const OfStages* q, const OfStages* v, OfStages* a) const = 0;

 protected:
  ~GaussField() = default;
};

/// Solves for the stages of a field by calls of `field.evaluate`. Sets stages.converged to true if the iteration
/// converges and the field does not fail, otherwise to false. Throws NoKernels if no build of the iteration can be
/// chosen (kernel_builds.h).
void solve_gauss_stages(const GaussField& field, GaussStages& stages);

}  // namespace pseudorigid::mechanics
