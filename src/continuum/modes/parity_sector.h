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
/// Self-gravity adds its second variation K_g = D²Ê at rest, which couples all nodes of the surface with one another.
/// On the sphere and a surface displacement u·n of degree n it is ρg (1 − 3/(2n + 1)) ∮(u·n)² dS, g = (4/3)πGρr: the
/// first term, a spring at each point, is part of K in B, and conjugate gradients with T of that B as preconditioner
/// solve (K + K_g + s M) u − Gᵀλ = f in some ten iterations, whatever the mesh and the strength of gravity.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "continuum/body/surface_gravity_forces.h"
#include "continuum/kernels/cell_kernels.h"
#include "continuum/mesh/ball_space.h"
#include "continuum/modes/rest_stiffness.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

struct Parity {
  std::array<int, 3> sign{1, 1, 1};

  /// Whether a component is 0 on the plane x_j = 0.
  bool holds(int component, int plane) const { return (component == plane) == (sign[plane] > 0); }
  /// "++-"
  std::string name() const;
};

/// Bits of the number are the negative signs: 0 is the symmetric motion.
Parity parity_of_sector(int number);

/// Shared by all sectors: space, stiffness and constraint of every cell. The space must be that of an octant.
struct RestProblem {
  /// Self-gravity is that of an incompressible body.
  RestProblem(const BallSpace& space, const CellKernels& kernels, const StoredEnergy& stored, bool incompressible,
              std::optional<SurfaceGravityForces> gravity = std::nullopt);

  const BallSpace& space;
  RestElasticity elasticity;
  bool incompressible;
  double shift;                             ///< s; 0 is for sectors without rigid motions, of a stable ball
  double penalty;                           ///< γ
  std::vector<Eigen::MatrixXd> stiffness;   ///< K + γGᵀG of each cell, with the springs
  std::vector<Eigen::MatrixXd> constraint;  ///< G of each cell
  std::vector<int> n_cells_at_node;
  std::optional<SurfaceGravityForces> gravity;

  /// The springs at the points of the surface: √(ρgw) n, w the weight of the point's area.
  struct Spring {
    FacePoint point;
    Eigen::Vector3d root_stiffness;
  };
  std::vector<Spring> springs;

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
  mechanics::Status solve(const Eigen::VectorXd& f, int n_corrections, Eigen::VectorXd& u) const;
  /// K_g u less the force of the springs.
  Eigen::VectorXd apply_gravity(const Eigen::VectorXd& u) const;
  Vector field_of(const Eigen::VectorXd& u) const;

  const RestProblem& problem_;
  Parity parity_;
  std::size_t n_unknowns_ = 0, first_interface_ = 0;
  std::vector<Cell> cells_;
  std::vector<unsigned int> entry_of_unknown_;  ///< 3·node + component
  Eigen::VectorXd mass_, root_mass_;
  std::unique_ptr<Interface> interface_;
};

}  // namespace pseudorigid::continuum
