#pragma once
/// The stages of one step of Gauss collocation (gauss_16.h) as plain numbers. They cross the interface to kernels that
/// are compiled for several sets of instructions (core/kernel_builds.h), so there is no Eigen type here.
///
/// A quantity of all stages is 8 numbers side by side: the lanes of a vector.

#include <array>
#include <cstddef>

#include "mechanics/core/gauss_coefficients.h"
#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

/// Lanes of the sums at the end of a step. With the stages a_j of an entry the step is
///   v += Σ h b_j a_j,   q += h v + Σ h² b_j (1 − c_j) a_j.
/// `velocity` and `position` are the two sums; `…_low` are the same sums with the rounding errors of the coefficients,
/// which may be 0 unless the stages are iterated to round-off. `legendre_…` are the Legendre coefficients of order 6
/// and 7 of the polynomial through the stages.
enum GaussSum : std::size_t { velocity, position, legendre_6, legendre_7, velocity_low, position_low };

/// A number of each stage.
struct alignas(64) OfStages : std::array<double, gauss::n_stages> {};

/// Coefficients of a step of size h. Column j of a matrix, for all stages i, is one vector.
struct GaussTables {
  using Columns = std::array<OfStages, gauss::n_stages>;
  Columns a{};                       ///< h a_ij
  Columns a_squared{};               ///< h² (A²)_ij
  Columns a_low{}, a_squared_low{};  ///< rounding errors of these
  Columns guess{};                   ///< ℓ_j(1 + r c_i): from the stages of a step of size h/r
  Columns sums{};                    ///< sums of a_j, in the order of GaussSum
  OfStages c{};                      ///< h c_i
  OfStages c_low{};
  double h = 0, ratio = 0;

  void set_step(double step);
  void set_ratio(double r);
};

struct GaussStages {
  int n = 0;            ///< entries of q
  double t = 0, h = 0;  ///< start and size of the step
  const double* q = nullptr;
  const double* v = nullptr;
  const GaussTables* tables = nullptr;
  const OfStages* last = nullptr;  ///< stages of the last step, which give the guess. If null, `a` is the guess.
  /// The stages are iterated until the error of the accelerations is below it; if 0, below round-off / 4096.
  double tolerance = 0;
  double outer_h = 0;  ///< length of the step that contains this part

  OfStages* a = nullptr;        ///< the stages
  OfStages* sums = nullptr;     ///< of GaussSum
  OfStages* scratch = nullptr;  ///< n_scratch n of them
  static constexpr std::size_t n_scratch = 5;

  bool converged = false;
  long n_iterations = 0;  ///< added to
  /// |Legendre coefficient of order 6 or 7| over the largest acceleration, and this.
  double tail = 0, scale = 0;
};

/// A field that is evaluated at all stages: q[k][i] and v[k][i] are entry k at stage i. The value is false if the field
/// fails.
struct GaussField {
  virtual bool evaluate(const GaussStages& stages, const OfStages* q, const OfStages* v, OfStages* a) const = 0;

 protected:
  ~GaussField() = default;
};

/// Solves for the stages of any field, which is called stage after stage.
void solve_gauss_stages(const GaussField& field, GaussStages& stages);

}  // namespace pseudorigid::mechanics
