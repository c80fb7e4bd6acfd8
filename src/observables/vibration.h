#pragma once
/// The energy of vibration of an incompressible elastic ball, and its parts of the degrees n = 2 … 8. The body has the
/// mass M, the centre of mass x_c and the kinetic energy K. About x_c it has the angular momentum J and, in its current
/// shape, the moment of inertia I. The energy of vibration is
///
///   K − ½ M|ẋ_c|² − ½ J·I⁻¹J + the elastic energy.
///
/// The parts belong to the displacement u = Rᵀ(x − x_c) − X in the frame of the rotation R of Q_M = R S. Q_M is the
/// mass moment (body_observables.h), and S is symmetric. A spheroidal motion of degree n that keeps the volume has the
/// form ∇×∇×(f(r) Y_nm X). The motions with f = r^{n + 2j}, j = 0 … 4, have modes φ_k with frequencies ω_k (Ritz's
/// method, for small strains), and the part of degree n is
///
///   E_n = ½ Σ_mk ⟨φ_k, u̇⟩² + ω_k² ⟨φ_k, u⟩²,     ⟨a, b⟩ = ∫ρ a·b dV.
///
/// f = r^n gives the gradient of a harmonic polynomial, so that affine motions have degree 2. The low frequencies are
/// those of the sphere (analysis/sphere_frequencies.h). Toroidal motions, higher degrees, changes of the volume and
/// finite strains are in the energy of vibration, but not in its parts.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "observables/body_observables.h"

namespace pseudorigid::mechanics {

/// The modes of degree n with f = Σ_j c_j r^{n + 2j}, ordered by increasing ω². Units are the radius, density and shear
/// modulus of the ball.
struct SpheroidalModes {
  explicit SpheroidalModes(int n);
  Eigen::VectorXd omega_squared;
  Eigen::MatrixXd coefficients;  ///< c_j of a mode in each column, for ∫|φ|² dV = 1
};

/// The motions ∇×∇×(r^{n + 2j} Y_nm X) that have the symmetry of the computed sector of the ball, for all degrees n of
/// the columns. The order is by n, then m, then j.
class SpheroidalMotions {
 public:
  static constexpr int n_powers = 5;  ///< number of powers, j = 0 … n_powers − 1
  /// The largest degree of a motion as a polynomial in X.
  static constexpr int largest_power = VibrationObservables::last_degree - 1 + 2 * (n_powers - 1);

  /// `reflect[i]` is true if x_i = 0 is a symmetry plane.
  explicit SpheroidalMotions(const std::array<bool, 3>& reflect);
  Eigen::Index size() const { return static_cast<Eigen::Index>(harmonics_.size()) * n_powers; }
  const std::array<bool, 3>& reflect() const { return reflect_; }
  /// Returns the degree n of each harmonic Y_nm. A harmonic has n_powers motions.
  std::vector<int> degrees() const;
  /// Returns the motions at the point X of the reference ball, one in each of size() rows.
  Eigen::MatrixX3d at(const Eigen::Vector3d& X) const;

 private:
  struct Harmonic {
    int n, m;
  };
  std::array<bool, 3> reflect_;
  std::vector<Harmonic> harmonics_;
};

/// Computes the energy of vibration of one body and its parts from positions and velocities of its nodes.
class Vibration {
 public:
  /// A body with the reference positions X of nodes or points and their masses, in the computed sector. The matrix
  /// `products` maps the values u_1(X_1), u_2(X_1), … of a displacement u to the products ⟨motion, u⟩ over the sector.
  Vibration(const SpheroidalMotions& motions, Eigen::Matrix3Xd X, Eigen::VectorXd masses, Eigen::MatrixXd products);

  /// Returns the sums over the nodes of this rank from which `observables` computes its result. The positions x and
  /// velocities v are relative to the centre of mass. Q is the mass moment Q_M, and Qdot its rate. The caller adds the
  /// sums of all ranks before it calls `observables`.
  Eigen::VectorXd sums(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& v, const Eigen::Matrix3d& Q,
                       const Eigen::Matrix3d& Qdot) const;
  /// Returns the observables of the whole body, from the sums over all nodes and the elastic energy of the whole body.
  VibrationObservables observables(const Eigen::VectorXd& sums, double elastic) const;

 private:
  std::array<bool, 3> reflect_;
  std::vector<int> degrees_;
  Eigen::Matrix3Xd X_;
  Eigen::VectorXd masses_;
  Eigen::MatrixXd products_;
  std::vector<SpheroidalModes> modes_;
};

}  // namespace pseudorigid::mechanics
