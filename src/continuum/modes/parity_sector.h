#pragma once
/// Small motions u of the ball about its rest, seen in one octant. Under the reflection of x_j a mode is even or odd,
///
///   u(R_j X) = s_j R_j u(X),   s_j = ±1:
///
/// on the plane x_j = 0 it has u_j = 0 if s_j = +1 (the symmetry of the motion), the other two components = 0 if
/// s_j = −1. The eight choices of signs are eight problems on the same octant, and have all modes of the ball.
///
/// In each, −ω² M u = −K u + Gᵀλ, G u = 0 is inverted about a shift below all ω²: u = T f solves
///
///   (K + s M) u − Gᵀλ = f,   G u = 0.
///
/// The operator on u alone never sees the multiplier's infinite eigenvalues. The solution is by augmented Lagrangian:
/// B = K + s M + γ GᵀG is positive definite and couples no more than K does, the ψ being those of one cell, and
/// u ← u − B⁻¹γGᵀG u reduces G u by a factor of the order of 1/γ. B is factorised after condensation: first the
/// unknowns of one cell alone (dense, cell by cell), then those between cells.
///
/// Self-gravity adds its second variation, which couples all nodes of the surface with one another. On the sphere it is
///
///   uᵀK_g u = ρg [∮(u·n)² dS − Σ_nm (3/(2n + 1)) (∮(u·n) Y_nm dS)²],   g = (4/3)πGρr,   1 in place of 3 for n = 0:
///
/// the first term, a spring at each point, is part of K in B. The second is an attraction of the harmonics that the
/// mesh resolves; those beyond it would soften the surface by 3/(2n + 1) of its springs at most. Conjugate gradients
/// with T of that B as preconditioner solve (K + K_g + s M) u − Gᵀλ = f in some ten iterations, whatever the mesh and
/// the strength of gravity. (The surface integrals of a motion, gravity/surface_gravity.h, err by more: l of a tide by
/// 1e-6 to 1e-5.)

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "continuum/kernels/cell_kernels.h"
#include "continuum/mesh/ball_space.h"
#include "continuum/modes/parity.h"
#include "continuum/modes/rest_stiffness.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

/// Shared by all sectors: space, stiffness and constraint of every cell. The space must be that of an octant.
struct RestProblem {
  /// Self-gravity is that of an incompressible body; its constant G is in internal units, ρ = r = 1.
  RestProblem(const BallSpace& space, const CellKernels& kernels, const StoredEnergy& stored, bool incompressible,
              double gravity_constant = 0);

  const BallSpace& space;
  RestElasticity elasticity;
  bool incompressible;
  double shift;                             ///< s; 0 is for sectors without rigid motions, of a stable ball
  double weight_of_density;                 ///< ρg
  double penalty;                           ///< γ
  std::vector<Eigen::MatrixXd> stiffness;   ///< K + γGᵀG of each cell, with the springs
  std::vector<Eigen::MatrixXd> constraint;  ///< G of each cell
  std::vector<int> n_cells_at_node;

 private:
  void add_springs();
};

class ParitySector {
 public:
  ParitySector(const RestProblem& problem, const Parity& parity);
  ~ParitySector();
  ParitySector(ParitySector&&) noexcept;

  mechanics::Status factorize();
  std::size_t n_unknowns() const { return n_unknowns_; }
  const Parity& parity() const { return parity_; }

  /// z = M^½ T M^½ y, symmetric, with the eigenvalues 1/(ω² + s). Fails if T cannot be applied.
  mechanics::Status apply(std::span<const double> y, std::span<double> z) const;

  /// u = T f for a force on the octant.
  mechanics::Status respond(const Vector& f, Vector& u) const;

  /// ω² and the field of an approximate eigenvector y, after a step of inverse iteration: ω² = uᵀKu / uᵀMu.
  struct Mode {
    double omega_squared;
    Vector u;
  };
  mechanics::Status mode_of(std::span<const double> y, Mode& mode) const;

 private:
  struct Cell;
  struct Interface;
  void number_unknowns();
  void condense(Cell& cell, unsigned int number, Eigen::MatrixXd& coupling) const;
  Eigen::VectorXd gather(const Cell& cell, const Eigen::VectorXd& u) const;
  void scatter_add(const Cell& cell, const Eigen::VectorXd& local, Eigen::VectorXd& u) const;
  void solve_penalized(Eigen::VectorXd& f) const;  ///< f ← B⁻¹f
  /// T f by n_corrections of the divergence, without self-gravity and with it.
  Eigen::VectorXd solve_elastic(Eigen::VectorXd f, int n_corrections) const;
  mechanics::Status solve(const Eigen::VectorXd& f, int n_corrections, double tolerance, Eigen::VectorXd& u) const;
  void find_attraction();
  /// K_g u less the force of the springs.
  Eigen::VectorXd apply_gravity(const Eigen::VectorXd& u) const {
    return -(attraction_.transpose() * (attraction_ * u));
  }
  Vector field_of(const Eigen::VectorXd& u) const;
  Eigen::VectorXd entries_of(const Vector& field) const;

  const RestProblem& problem_;
  Parity parity_;
  std::size_t n_unknowns_ = 0, first_interface_ = 0;
  std::vector<Cell> cells_;
  std::vector<unsigned int> entry_of_unknown_;  ///< 3·node + component
  Eigen::VectorXd mass_, root_mass_;
  Eigen::MatrixXd attraction_;  ///< a row for each harmonic: √(3ρg/(2n + 1)) ∮(u·n) Y_nm dS of the sector's unknowns
  std::unique_ptr<Interface> interface_;
};

}  // namespace pseudorigid::continuum
