#pragma once
/// The energy of vibration of an incompressible elastic ball, and its parts of the degrees n = 2 … 8. The body has the
/// mass M, the centre of mass x_c and the kinetic energy K. About x_c it has the angular momentum J and, in its current
/// shape, the tensor of inertia I. The energy of vibration is
///
///   K − ½ M|ẋ_c|² − ½ J·I⁻¹J + the elastic energy.
///
/// The parts are computed from the displacement u = Rᵀ(x − x_c) − X in the frame of the rotation R of Q_M = R S. Q_M is
/// the mass moment (body_observables.h), and S is symmetric. A spheroidal motion of degree n and order m that keeps the
/// volume has the form ∇×∇×(f(r) Y_nm X), with r = |X| and the spherical harmonic Y_nm. Ritz's method with
/// f = r^{n + 2j}, j = 0 … 4, gives modes φ_mk with the norm ⟨φ_mk, φ_mk⟩ = 1 and the frequencies ω_k for small
/// strains. The part of degree n is
///
///   E_n = ½ Σ_mk (⟨φ_mk, u̇⟩² + ω_k² ⟨φ_mk, u⟩²),     ⟨a, b⟩ = ∫ρ a·b dV.
///
/// With f = r^n the motion is the gradient of a harmonic polynomial of degree n, so that affine motions have degree 2.
/// The low frequencies are those of the sphere (analysis/sphere_frequencies.h). Toroidal motions, higher degrees,
/// changes of the volume and finite strains contribute to the energy of vibration, but not to its parts.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "observables/body_observables.h"

namespace pseudorigid::mechanics {

/// The modes of degree n with f = Σ_j c_j r^{n + 2j}, ordered by increasing squared frequency ω². The units are the
/// radius, the density and the shear modulus of the ball.
struct SpheroidalModes {
  explicit SpheroidalModes(int n);
  Eigen::VectorXd omega_squared;
  Eigen::MatrixXd coefficients;  ///< coefficients c_j of one mode in each column, normalised to ∫|φ|² dV = 1
};

/// The motions ∇×∇×(r^{n + 2j} Y_nm X) of the degrees n = 2 … 8 that have the symmetry of the computed sector of the
/// ball. They are ordered by n, then m, then j.
class SpheroidalMotions {
 public:
  static constexpr int n_powers = 5;  ///< number of powers, j = 0 … n_powers − 1
  /// The largest degree of the motions, which are polynomials in X.
  static constexpr int largest_power = VibrationObservables::last_degree - 1 + 2 * (n_powers - 1);

  /// `reflect[i]` is true if x_i = 0 is a symmetry plane.
  explicit SpheroidalMotions(const std::array<bool, 3>& reflect);
  /// Returns the number of motions.
  Eigen::Index size() const { return static_cast<Eigen::Index>(harmonics_.size()) * n_powers; }
  const std::array<bool, 3>& reflect() const { return reflect_; }
  /// Returns the degree n of each harmonic Y_nm, in the order of the motions. Each harmonic has n_powers motions.
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

/// Computes the energy of vibration of one body, and its parts, from the positions and velocities of nodes or points.
class Vibration {
 public:
  /// Takes the reference positions X of the nodes or points of this rank in the computed sector, and their masses. Each
  /// row of `products` belongs to a motion of `motions`. The matrix maps the values u_1(X_1), u_2(X_1), u_3(X_1),
  /// u_1(X_2), … of a displacement u to the products ⟨motion, u⟩ over the sector.
  Vibration(const SpheroidalMotions& motions, Eigen::Matrix3Xd X, Eigen::VectorXd masses, Eigen::MatrixXd products);

  /// Returns the sums over the nodes of this rank from which `observables` computes its result. The caller must add the
  /// sums of all ranks before it calls `observables`. The positions x and velocities v of the nodes are relative to the
  /// centre of mass and its velocity. Q is the mass moment Q_M, and Qdot its rate.
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
