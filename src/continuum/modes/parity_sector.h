#pragma once
/// Small motions u of the ball about rest, computed in one octant. Under the reflection R_j of x_j, a mode is even or
/// odd,
///
///   u(R_j X) = s_j R_j u(X),   s_j = ±1.
///
/// On the plane x_j = 0, u_j = 0 if s_j = +1, and the other two components are 0 if s_j = −1. The motion has the plane
/// as a plane of symmetry if s_j = +1. The eight choices of signs are eight problems on the same octant, the sectors.
/// Together the sectors have all modes of the ball.
///
/// In each sector, the modes satisfy
///
///   −ω² M u = −K u + Gᵀλ,   G u = 0
///
/// with the mass M, the stiffness K, and the constraint with its multiplier λ. This problem is inverted about a shift
/// −s below all ω²: u = T f solves
///
///   (K + s M) u − Gᵀλ = f,   G u = 0.
///
/// T acts on u alone and therefore does not have the infinite eigenvalues of the multiplier. The equations are solved
/// by the augmented Lagrangian method with a penalty γ. B = K + s M + γ GᵀG is positive definite. B couples the same
/// unknowns as K, because each entry of λ belongs to one cell. A correction u ← u − B⁻¹γGᵀG u reduces G u by a factor
/// of the order of 1/γ. B is factorised after condensation: first the unknowns of a single cell (dense, cell by cell),
/// then the unknowns between cells.
///
/// Self-gravity adds its second variation, which couples all nodes of the surface. On the sphere, the second variation
/// is
///
///   uᵀK_g u = ρg [∮(u·e)² dS − Σ_nm c_n (∮(u·e) Y_nm dS)²],   g = (4/3)πGρr,   c_0 = 1, c_n = 3/(2n + 1) for n > 0.
///
/// e is the outward normal, the Y_nm are the orthonormal spherical harmonics, and G in the formula for g is Newton's
/// constant. The first term is a spring at each point, and K in B contains these springs. The second term is an
/// attraction of the harmonics that the mesh resolves. Harmonics of higher degree n would soften the springs of the
/// surface by a fraction of at most 3/(2n + 1). The equation (K + K_g + s M) u − Gᵀλ = f is solved by conjugate
/// gradients with T of this B as the preconditioner. About ten iterations are sufficient for every mesh and strength of
/// gravity. The surface integrals of a motion (gravity/surface_gravity.h) have larger errors: 1e-6 to 1e-5 in the Love
/// number l of a tide.

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

/// Data that all sectors share: the space, and the stiffness and the constraint of every cell.
struct RestProblem {
  /// `space` must be that of an octant in one process. The self-gravity K_g (top of this file) is that of an
  /// incompressible body. `gravity_constant` is Newton's constant in internal units, in which ρ = r = 1.
  RestProblem(const BallSpace& space, const CellKernels& kernels, const StoredEnergy& stored, bool incompressible,
              double gravity_constant = 0);

  const BallSpace& space;
  RestElasticity elasticity;
  bool incompressible;
  double shift;                             ///< s; may be set to 0 for sectors of a stable ball without rigid motions
  double weight_of_density;                 ///< product ρg of density and gravity at the surface
  double penalty;                           ///< penalty γ of the augmented Lagrangian; 0 for a compressible body
  std::vector<Eigen::MatrixXd> stiffness;   ///< K + γGᵀG of each cell, with the springs of self-gravity
  std::vector<Eigen::MatrixXd> constraint;  ///< G of each cell; empty for a compressible body
  std::vector<int> n_cells_at_node;         ///< number of cells that contain each node

 private:
  void add_springs();
};

class ParitySector {
 public:
  ParitySector(const RestProblem& problem, const Parity& parity);
  ~ParitySector();
  ParitySector(ParitySector&&) noexcept;

  /// Factorises B. Call this function before `apply`, `respond` and `mode_of`. Fails if B is not positive definite.
  mechanics::Status factorize();
  std::size_t n_unknowns() const { return n_unknowns_; }
  const Parity& parity() const { return parity_; }

  /// z = M^½ T M^½ y. This operator is symmetric and has the eigenvalues 1/(ω² + s). `apply`, `respond` and `mode_of`
  /// fail if the ball with self-gravity is unstable, or if the conjugate gradients do not converge.
  mechanics::Status apply(std::span<const double> y, std::span<double> z) const;

  /// Sets u = T f for a force f on the octant. Fails in the same cases as `apply`.
  mechanics::Status respond(const Vector& f, Vector& u) const;

  /// A mode with its ω². `mode_of` makes one step of inverse iteration from an approximate eigenvector y of `apply`. It
  /// then computes ω² = uᵀ(K + K_g)u / uᵀMu.
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
  /// T f without self-gravity (`solve_elastic`) and with self-gravity (`solve`). n_corrections is the number of
  /// corrections of G u. `tolerance` is the relative tolerance of the conjugate gradients in the energy norm. `solve`
  /// fails in the same cases as `apply`.
  Eigen::VectorXd solve_elastic(Eigen::VectorXd f, int n_corrections) const;
  mechanics::Status solve(const Eigen::VectorXd& f, int n_corrections, double tolerance, Eigen::VectorXd& u) const;
  void find_attraction();
  /// The second term of K_g u, the attraction. B contains the first term.
  Eigen::VectorXd apply_gravity(const Eigen::VectorXd& u) const {
    return -(attraction_.transpose() * (attraction_ * u));
  }
  Vector field_of(const Eigen::VectorXd& u) const;
  Eigen::VectorXd entries_of(const Vector& field) const;

  const RestProblem& problem_;
  Parity parity_;
  std::size_t n_unknowns_ = 0, first_interface_ = 0;  ///< first_interface_: the first unknown between cells
  std::vector<Cell> cells_;
  std::vector<unsigned int> entry_of_unknown_;  ///< 3·node + component of each unknown
  Eigen::VectorXd mass_, root_mass_;
  Eigen::MatrixXd attraction_;  ///< the second term of uᵀK_g u on the octant is −|attraction_ u|²
  std::unique_ptr<Interface> interface_;
};

}  // namespace pseudorigid::continuum
