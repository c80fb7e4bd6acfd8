#pragma once
/// Linear stability of a relative equilibrium, in the frame in which it is at rest. Small motions y, in coordinates in
/// which the mass is the identity and the constraints hold, satisfy
///
///   ÿ + 2Gẏ + Ky = 0,   G = −Gᵀ,   K = Kᵀ,
///
/// This is a linear Hamiltonian system Wẋ = −Sx in x = (y, ẏ), with the conserved energy ½xᵀSx, S = diag(K, Id), and
/// the symplectic form W = [2G, Id; −Id, 0].
///
/// A symmetry maps the equilibrium to others. Its direction (y, ẏ) belongs to an invariant space N with known rates
/// that do not depend on the equilibrium. The remaining space has fixed momenta, modulo the group that preserves them
/// (Marsden–Weinstein):
///
///   N^W / (N ∩ N^W),   N^W = {x: nᵀWx = 0 for n in N},
///
/// On this space S and W are again well defined. The space has no double zero rate of a symmetry, which round-off would
/// split.
///
/// Time is scaled by the largest frequency of K and G, so that all thresholds are relative.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

/// Directions (y, ẏ) that span N, in columns. They need not be independent.
struct SymmetryDirections {
  Eigen::MatrixXd y, rate;
};

/// The linear system on the reduced space in the scaled time t': dx/dt' = −W⁻¹S x, d/dt = scale · d/dt'.
struct ReducedLinearSystem {
  Eigen::MatrixXd S, W;
  double scale = 1;
};

/// A rate s of the motion, y ~ exp(st), and the sign of its energy ½x̄ᵀSx: −1, 0 or +1. Off the imaginary axis the sign
/// is 0.
struct Rate {
  std::complex<double> s;
  int energy_sign = 0;
};

struct LinearStability {
  std::vector<Rate> rates;
  Eigen::VectorXd second_variation;  ///< eigenvalues of S, increasing: second variation of the energy at fixed momenta
  int n_negative = 0;  ///< number of negative eigenvalues; stable if 0 and no eigenvalue is 0 (Dirichlet's criterion)
  double growth_rate = 0;  ///< largest real part, 0 if it is round-off
  bool stable = true;      ///< spectral stability: no rate has a positive real part
};

/// Real parts below this fraction of the largest rate count as zero. Round-off ε splits colliding rates by √ε, times a
/// condition number.
inline constexpr double zero_growth = 1e-6;
/// Eigenvalues of the second variation are of order 1. Those below this bound count as zero.
inline constexpr double zero_variation = 1e-12;

/// S and W on N^W / (N ∩ N^W), represented on the orthogonal complement of N ∩ N^W in N^W. Directions of N and momenta
/// smaller than `absent` times the largest count as zero.
ReducedLinearSystem reduce(Eigen::MatrixXd K, Eigen::MatrixXd G, const SymmetryDirections& symmetries, double absent);

/// Computes rates, second variation and stability. Fails if the system, which contains second derivatives, is not
/// finite.
Status analyse_stability(const ReducedLinearSystem& system, LinearStability& result);

}  // namespace pseudorigid::mechanics
