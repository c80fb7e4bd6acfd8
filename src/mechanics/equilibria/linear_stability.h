#pragma once
/// Linear stability of a relative equilibrium, in the frame in which the equilibrium is at rest. Small motions y, in
/// coordinates in which the mass is the identity and the constraints hold, satisfy
///
///   ÿ + 2Gẏ + Ky = 0,   G = −Gᵀ,   K = Kᵀ,
///
/// with the gyroscopic matrix G and the stiffness K. The equation is a linear Hamiltonian system Wẋ = −Sx in x = (y,
/// ẏ). The system has the conserved energy ½xᵀSx, S = diag(K, Id), and the symplectic form W = [2G, Id; −Id, 0].
///
/// A symmetry maps the equilibrium to other equilibria. The space N that is spanned by the directions (y, ẏ) of all
/// symmetries is invariant. The rates of the motions in N are known and do not depend on the equilibrium. The other
/// motions are those with fixed momenta, modulo the group that preserves these momenta (Marsden–Weinstein). They form
/// the reduced space
///
///   N^W / (N ∩ N^W),   N^W = {x: nᵀWx = 0 for n in N}.
///
/// S and W are well defined on the reduced space. A symmetry causes a double rate zero, which round-off would split
/// into two small rates. The reduced space does not contain the motions with these rates.
///
/// The unit of scaled time is 1/√max(|K|, |G|²). This root is about the largest frequency, so all thresholds are
/// relative to it.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

/// Directions (y, ẏ) that span N. The columns of `y` and `rate` are the y and the ẏ, in unscaled time. The directions
/// may be linearly dependent.
struct SymmetryDirections {
  Eigen::MatrixXd y, rate;
};

/// The linear system dx/dt' = −W⁻¹S x on the reduced space, with the scaled time t' = scale · t.
struct ReducedLinearSystem {
  Eigen::MatrixXd S, W;
  double scale = 1;
};

/// A rate s of a motion y ~ exp(st) in unscaled time t, and the sign −1, 0 or +1 of its energy ½x̄ᵀSx. The sign is 0 if
/// the energy is round-off, as for every s that is not imaginary.
struct Rate {
  std::complex<double> s;
  int energy_sign = 0;
};

struct LinearStability {
  std::vector<Rate> rates;  ///< rates on the reduced space, ordered by Im s and then by Re s
  /// Eigenvalues of S in scaled time, increasing: second variation of the energy at fixed momenta.
  Eigen::VectorXd second_variation;
  int n_negative = 0;  ///< number of negative eigenvalues of S; if all are positive, the motion is stable (Dirichlet)
  double growth_rate = 0;  ///< largest real part of a rate in unscaled time, or 0 if `stable` is true
  bool stable = true;      ///< spectral stability: no rate has a positive real part above round-off
};

/// Real parts of at most this fraction of the largest |rate| count as zero. The energy of a rate with the eigenvector x
/// counts as zero if |x̄ᵀSx|/|x|² is below this number. The number is this large because round-off ε splits colliding
/// rates by √ε, times a condition number.
inline constexpr double zero_growth = 1e-6;
/// Eigenvalues of S with a smaller absolute value than this bound count as zero. In scaled time, the eigenvalues are of
/// order 1.
inline constexpr double zero_variation = 1e-12;

/// Returns S and W in scaled time on the reduced space. K and G are those of the opening equation, in unscaled time.
/// The antisymmetric part of K is removed. The reduced space is represented by the orthogonal complement of N ∩ N^W in
/// N^W. Singular values count as zero if they are at most `absent` times the largest singular value of the same matrix.
/// If `symmetries` has no columns, N is zero.
ReducedLinearSystem reduce(Eigen::MatrixXd K, Eigen::MatrixXd G, const SymmetryDirections& symmetries, double absent);

/// Sets the rates, the second variation and the stability in `result`. If the reduced space is zero, there are no rates
/// and the result is stable. Fails if the system is not finite or if the eigenvalues do not converge.
Status analyse_stability(const ReducedLinearSystem& system, LinearStability& result);

}  // namespace pseudorigid::mechanics
