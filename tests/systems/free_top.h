#pragma once
/// The free rigid body in closed form (Jacobi; Landau, Lifshitz, Mechanics, § 37), moments I₁ < I₂ < I₃, energy K and
/// |p| = L with L² > 2KI₂, the vector p along the third axis of space:
///
///   Ω = (a₁ cn u, a₂ sn u, a₃ dn u),   u = νt,   k² = (I₂−I₁)(2KI₃−L²)/((I₃−I₂)(L²−2KI₁)),
///   a₁² = (2KI₃−L²)/(I₁(I₃−I₁)),   a₂² = (2KI₃−L²)/(I₂(I₃−I₂)),   a₃² = (L²−2KI₁)/(I₃(I₃−I₁)),
///   ν² = (I₃−I₂)(L²−2KI₁)/(I₁I₂I₃),
///   R = R_z(φ)R_x(θ)R_z(ψ),   R⁻¹e_z = AΩ/L,   φ̇ = L(I₁Ω₁²+I₂Ω₂²)/(I₁²Ω₁²+I₂²Ω₂²), so that
///   φ = Lt/I₃ + (L/I₃)(2KI₃−L²)/(Dν) Π(n; am u, k),   D = L²−I₃²a₃²,   n = −I₃²a₃²k²/D.
///
/// Evaluated in extended precision; whole periods are taken out of u first.

#include <Eigen/Dense>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <numbers>

namespace pseudorigid::testing {

class FreeTop {
  using Real = long double;

 public:
  struct Motion {
    Eigen::Matrix3d R;
    Eigen::Vector3d Omega;
  };

  FreeTop(const Eigen::Vector3d& moments, double energy, double momentum)
      : I1(moments(0)), I2(moments(1)), I3(moments(2)), L(momentum) {
    const Real low = 2 * Real(energy) * I3 - L * L, high = L * L - 2 * Real(energy) * I1;
    a1 = std::sqrt(low / (I1 * (I3 - I1)));
    a2 = std::sqrt(low / (I2 * (I3 - I2)));
    a3 = std::sqrt(high / (I3 * (I3 - I1)));
    nu = std::sqrt((I3 - I2) * high / (I1 * I2 * I3));
    k = std::sqrt((I2 - I1) * low / ((I3 - I2) * high));
    quarter = boost::math::ellint_1(k);
    const Real D = L * L - I3 * I3 * a3 * a3;
    n = -I3 * I3 * a3 * a3 * k * k / D;
    factor = L / I3 * low / (D * nu);
  }

  double period() const { return static_cast<double>(4 * quarter / nu); }

  Motion at(double t) const {
    const Real turns = std::floor(nu * t / (4 * quarter)), u = nu * t - 4 * quarter * turns;
    Real cn = 0, dn = 0;
    const Real sn = boost::math::jacobi_elliptic(k, u, &cn, &dn);
    Real am = std::atan2(sn, cn);
    if (am < 0) am += 2 * std::numbers::pi_v<Real>;
    const Real Pi = 4 * turns * boost::math::ellint_3(k, n) + boost::math::ellint_3(k, n, am);
    const Real phi = L * t / I3 + factor * Pi;

    const Real W1 = a1 * cn, W2 = a2 * sn, W3 = a3 * dn;
    const Real sin_theta_sin_psi = I1 * W1 / L, sin_theta_cos_psi = I2 * W2 / L, cos_theta = I3 * W3 / L;
    const Real sin_theta = std::hypot(sin_theta_sin_psi, sin_theta_cos_psi);
    const Eigen::Matrix<Real, 3, 3> R = about_z(std::cos(phi), std::sin(phi)) * about_x(cos_theta, sin_theta) *
                                        about_z(sin_theta_cos_psi / sin_theta, sin_theta_sin_psi / sin_theta);
    return {R.cast<double>(), Eigen::Matrix<Real, 3, 1>(W1, W2, W3).cast<double>()};
  }

 private:
  static Eigen::Matrix<Real, 3, 3> about_z(Real c, Real s) {
    return (Eigen::Matrix<Real, 3, 3>() << c, -s, 0, s, c, 0, 0, 0, 1).finished();
  }
  static Eigen::Matrix<Real, 3, 3> about_x(Real c, Real s) {
    return (Eigen::Matrix<Real, 3, 3>() << 1, 0, 0, 0, c, -s, 0, s, c).finished();
  }

  Real I1, I2, I3, L, a1, a2, a3, nu, k, quarter, n, factor;
};

}  // namespace pseudorigid::testing
