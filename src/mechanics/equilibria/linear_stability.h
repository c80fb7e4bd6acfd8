#pragma once
/// Linear stability of a relative equilibrium, in the frame in which it stands still. Small motions y, in coordinates
/// in which the mass is the identity and constraints are kept, obey
///
///   ÿ + 2Gẏ + Ky = 0,   G = −Gᵀ,   K = Kᵀ,
///
/// a linear Hamiltonian system in x = (y, ẏ):  Wẋ = −Sx with the conserved energy ½xᵀSx, S = diag(K, Id), and the
/// symplectic form W = [2G, Id; −Id, 0].
///
/// A symmetry takes the equilibrium to others, and its direction (y, ẏ) belongs to an invariant space N whose rates are
/// known and do not depend on the equilibrium. The remainder is the space of fixed momenta modulo the group that keeps
/// them (Marsden–Weinstein),
///
///   N^W / (N ∩ N^W),   N^W = {x: nᵀWx = 0 for n in N},
///
/// on which S and W are again well defined: no double zero of a symmetry is left that round-off would split.
///
/// Time is scaled by the largest frequency of K and G, so that all thresholds are relative.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "mechanics/core/status.h"

namespace pseudorigid::mechanics {

/// Directions (y, ẏ) of N, a column each. They need not be independent.
struct SymmetryDirections {
  Eigen::MatrixXd y, rate;
};

/// The linear system on the reduced space, in the scaled time: x' = −W⁻¹S x, d/dt = scale · d/dt'.
struct ReducedLinearSystem {
  Eigen::MatrixXd S, W;
  double scale = 1;
};

/// A rate s of the motion, y ~ exp(st), and the sign of its energy ½x̄ᵀSx: −1, 0, +1 (0 off the imaginary axis).
struct Rate {
  std::complex<double> s;
  int energy_sign = 0;
};

struct LinearStability {
  std::vector<Rate> rates;
  Eigen::VectorXd second_variation;  ///< eigenvalues of S, rising: of the energy at fixed momenta
  int n_negative = 0;                ///< how many of them are negative; 0 and none zero: stable (Dirichlet's criterion)
  double growth_rate = 0;            ///< largest real part, 0 if it is round-off
  bool stable = true;                ///< spectrally: no rate with positive real part
};

/// Real parts below this part of the largest rate count as zero: colliding rates are split by √ε, times a condition.
inline constexpr double zero_growth = 1e-6;
/// Eigenvalues of the second variation (of order 1) below this count as zero.
inline constexpr double zero_variation = 1e-12;

/// S and W on N^W / (N ∩ N^W), represented on the orthogonal complement of N ∩ N^W in N^W. Directions of N, and
/// momenta, below `absent` of the largest count as absent.
ReducedLinearSystem reduce(Eigen::MatrixXd K, Eigen::MatrixXd G, const SymmetryDirections& symmetries, double absent);

/// Rates, second variation and stability. Fails if the system, that is the second derivative, is not finite.
Status analyse_stability(const ReducedLinearSystem& system, LinearStability& result);

}  // namespace pseudorigid::mechanics
