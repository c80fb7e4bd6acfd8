#pragma once
/// Small motions u of the ball about rest or another symmetric equilibrium, computed in one octant. Under the
/// reflection R_j of x_j, a mode can be chosen even or odd,
///
///   u(R_j X) = s_j R_j u(X),   s_j = ±1.
///
/// On the plane x_j = 0, u_j = 0 if s_j = +1, and the other two components are 0 if s_j = −1. If s_j = +1, the plane is
/// a plane of symmetry of the motion. The eight choices of signs are eight problems on the same octant, the parity
/// sectors. Together the sectors have all modes of the ball.
///
/// In each sector, the modes satisfy
///
///   −ω² M u = −K u + Gᵀλ,   G u = 0
///
/// with the mass M, the stiffness K, and the constraint with its multiplier λ. For a shift −s below all ω², let T be
/// the operator for which u = T f solves
///
///   (K + s M) u − Gᵀλ = f,   G u = 0.
///
/// T acts only on displacements and therefore does not have the infinite eigenvalues of the multiplier. The equations
/// are solved by the augmented Lagrangian method with a penalty γ. B = K + s M + γ GᵀG is positive definite. B couples
/// the same unknowns as K, because each entry of λ belongs to one cell. A correction u ← u − B⁻¹γGᵀG u reduces G u by a
/// factor of the order of 1/γ. B is factorised by static condensation: first the unknowns that belong to a single cell
/// (dense, cell by cell), then the unknowns between cells.
///
/// Forces that couple more unknowns than K add a further operator E. If E is a matrix of the unknowns of the surface, B
/// contains it, and these unknowns count as unknowns between cells. Otherwise E is applied without a matrix: the
/// equation (K + E + s M) u − Gᵀλ = f is solved by conjugate gradients, with T without E as the preconditioner.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "continuum/modes/linear_problem.h"
#include "continuum/modes/parity.h"
#include "mechanics/core/status.h"

namespace pseudorigid::continuum {

class ParitySector {
 public:
  /// `problem` must outlive this object.
  ParitySector(const LinearProblem& problem, const Parity& parity);
  ~ParitySector();
  ParitySector(ParitySector&&) noexcept = delete;  // E may refer to the sector

  /// Computes E and factorises B. Call this function before the solutions and products, and before `without_volume`.
  /// Fails if B is not positive definite.
  mechanics::Status factorize();
  std::size_t n_unknowns() const { return n_unknowns_; }
  const Parity& parity() const { return parity_; }
  const BallSpace& space() const { return problem_.space; }

  /// Conversions between nodal fields on the octant and vectors of the unknowns. Entries that are not unknowns are 0.
  Vector field_of(const Eigen::VectorXd& u) const;
  Eigen::VectorXd entries_of(const Vector& field) const;
  /// The number 3·node + component of an unknown.
  unsigned int entry_of(Eigen::Index unknown) const { return entry_of_unknown_[static_cast<std::size_t>(unknown)]; }
  const Eigen::VectorXd& mass() const { return mass_; }  ///< M of each unknown
  /// Returns (K + E + s M) u for each column u.
  Eigen::MatrixXd product(const Eigen::MatrixXd& u) const;
  /// One vector, or any number of vectors as columns. With one vector at compile time, products are faster.
  template <int n>
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, n>;
  /// f ← B⁻¹f for each column of f.
  template <int n>
  void solve_penalized(Columns<n>& f) const;
  /// Returns u minus a displacement with the same G u. The result w therefore has G w = 0.
  Eigen::VectorXd without_volume(const Eigen::VectorXd& u) const;

  /// Sets z = M^½ T M^½ y for each column y, with G u = 0 to about 10⁻⁶ in an eigenvalue problem. Here and in
  /// `respond`, T is defined with K + E in place of K. The operator M^½ T M^½ is symmetric and has the eigenvalues
  /// 1/(ω² + s). `apply`, `respond` and `modes_of` fail if K + E + s M is not positive definite, or if the
  /// conjugate-gradient iteration does not converge.
  mechanics::Status apply(const Eigen::MatrixXd& y, Eigen::MatrixXd& z) const;

  /// Sets u = T f for each column f. Several columns take much less time than as many calls, because each factor is
  /// then read once. Fails in the same cases as `apply`.
  mechanics::Status respond(const Eigen::MatrixXd& f, Eigen::MatrixXd& u) const;

  /// Solves (K + E + s M) u − Gᵀλ = f, G u = h. Unlike `respond`, this function does not need a positive definite K + E
  /// + s M. With the residual r of the first equation, each step of the augmented Lagrangian method solves
  ///
  ///   (B + E) δ = r + γGᵀ(h − G u),   u ← u + δ,   λ ← λ + γ(h − G u).
  ///
  /// The error of G u falls by a factor of the order of γ/μ in each step, with the shear modulus μ
  /// (LinearProblem::set_shift). If there is an E that B does not contain, GMRES solves for δ with the preconditioner
  /// B⁻¹, up to `tolerance` relative to B⁻¹ times the right side. The steps end when δ is at most `tolerance` times u,
  /// or after 8 steps. `lambda` is empty for a compressible body. Fails if GMRES does not converge.
  mechanics::SolveReport solve(const Eigen::VectorXd& f, const Eigen::VectorXd& h, double tolerance, Eigen::VectorXd& u,
                               Eigen::VectorXd& lambda) const;

  /// Modes u as columns, with their ω². `modes_of` makes one step of inverse iteration from each column y, an
  /// approximate eigenvector of `apply`, which gives u. The result ω² is uᵀ(K + E)u / uᵀMu.
  struct Modes {
    Eigen::VectorXd omega_squared;
    Eigen::MatrixXd u;
  };
  mechanics::Status modes_of(const Eigen::MatrixXd& y, Modes& modes) const;

 private:
  struct Cell;
  struct Interface;
  void number_unknowns();
  bool condense(Cell& cell, unsigned int number, Eigen::MatrixXd& coupling) const;
  template <int n>
  void scatter_add(const Cell& cell, const Columns<n>& local, Columns<n>& u) const;
  template <int n>
  Columns<n> constraint_of(const Columns<n>& u) const;  ///< G u
  template <int n>
  Columns<n> reaction_of(const Columns<n>& lambda) const;  ///< Gᵀλ
  /// `solve_cells` returns T f without an E that B does not contain. `solve_definite` sets u to T f with E.
  /// n_corrections is the number of corrections of G u. `tolerance` is the relative tolerance of the conjugate
  /// gradients in the energy norm. `solve_definite` fails in the same cases as `apply`.
  template <int n>
  Columns<n> solve_cells(Columns<n> f, int n_corrections) const;
  mechanics::Status solve_definite(const Eigen::VectorXd& f, int n_corrections, double tolerance,
                                   Eigen::VectorXd& u) const;
  /// `solve_definite` for each column of f.
  mechanics::Status solve_all(const Eigen::MatrixXd& f, int n_corrections, double tolerance, Eigen::MatrixXd& u) const;
  Eigen::VectorXd with_volume(const Eigen::VectorXd& h) const;  ///< some u with G u = h; 0 for a compressible body

  /// True if there is an E that B does not contain.
  bool iterates() const { return static_cast<bool>(beyond_cells_.product); }

  const LinearProblem& problem_;
  Parity parity_;
  std::size_t n_unknowns_ = 0, first_interface_ = 0;  ///< first_interface_: the first unknown between cells
  std::vector<Cell> cells_;
  std::vector<unsigned int> entry_of_unknown_;  ///< 3·node + component of each unknown
  Eigen::VectorXd mass_, root_mass_;
  Eigen::VectorXd diagonal_;  ///< (s + LinearProblem::of_mass) M of each unknown
  BeyondCells beyond_cells_;  ///< E
  std::unique_ptr<Interface> interface_;
};

}  // namespace pseudorigid::continuum
