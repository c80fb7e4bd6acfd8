#pragma once
/// The Kepler motion s̈ = −k s/|s|³ on any conic, during a time h. The vectors s and ṡ are the position and the
/// velocity at the start. With the universal anomaly X (Danby, Fundamentals of Celestial Mechanics, 6.9), r = |s|, η =
/// s·ṡ, β = 2k/r − |ṡ|² and the functions
///
///   G_n(X) = Xⁿ c_n(βX²),   c_n(z) = 1/n! − z/(n + 2)! + z²/(n + 4)! − …,
///
/// the time is h = r G₁ + η G₂ + k G₃. The derivative of the time with respect to X is r(X) = r + η G₁ + (k − βr) G₂,
/// the distance |s| at the end. The increments of the motion are
///
///   Δs = −(k G₂/r) s + (h − k G₃) ṡ,   Δṡ = −(k G₁/(r r(X))) s − (k G₂/r(X)) ṡ.

#include <Eigen/Core>
#include <cmath>

namespace pseudorigid::mechanics {

/// The functions G₁, G₂ and G₃ at X. The series is evaluated at X/2ⁿ, with n such that it converges fast. Formulas for
/// the double argument then give the values at X: G₃(2X) = 2(G₃ + G₁G₂), G₂(2X) = 2G₁², G₁(2X) = 2G₀G₁, with G₀ = 1 −
/// βG₂.
struct UniversalFunctions {
  double G1, G2, G3;

  UniversalFunctions(double beta, double X) {
    constexpr double small = 0.1;  // largest |βX²| for the series; eight terms then have an error below round-off
    constexpr int n_terms = 8, most_halvings = 60;
    int n_halvings = 0;
    for (; std::abs(beta) * X * X > small && n_halvings < most_halvings; ++n_halvings) X /= 2;
    const double z = beta * X * X;
    double c2 = 0, c3 = 0;
    for (int n = n_terms - 1; n >= 0; --n) {
      c2 = (1 - z * c2) / ((2 * n + 1) * (2 * n + 2));
      c3 = (1 - z * c3) / ((2 * n + 2) * (2 * n + 3));
    }
    G2 = X * X * c2;
    G3 = X * X * X * c3;
    G1 = X - beta * G3;
    for (int i = 0; i < n_halvings; ++i) {
      G3 = 2 * (G3 + G1 * G2);
      const double G0 = 1 - beta * G2;
      G2 = 2 * G1 * G1;
      G1 = 2 * G0 * G1;
    }
  }
};

/// The increments Δs and Δṡ.
struct KeplerIncrements {
  Eigen::Vector3d s, sdot;
};

/// Returns Δs and Δṡ after the time h, which may be negative. The increments are not finite if s = 0 or an argument is
/// not finite.
KeplerIncrements kepler_increments(double k, const Eigen::Vector3d& s, const Eigen::Vector3d& sdot, double h);

}  // namespace pseudorigid::mechanics
