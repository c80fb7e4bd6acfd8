#pragma once
/// The incompressible elastic ball as a constrained system of the mechanics core:
///
///   M ẍ = −∫P:∇φ + Gᵀλ,   g_j = ∫ψ_j ln J dX = 0                           (generalized Newton law, Oliva 5.3–5.4)
///
/// x_h ∈ (Q_k)³ with a lumped mass, λ_h ∈ discontinuous P_{k−1} is the Kirchhoff pressure Jp. With ln J in place of
/// J − 1 the second variation of the constraint has no (div u)² term, and the discrete motion does not depend on the
/// hydrostatic gauge of W. All in internal units; the system is the computed sector, observables are of the whole ball.

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "continuum/ball_space.h"
#include "continuum/cell_kernels.h"
#include "continuum/gram_solver.h"
#include "mechanics/body_observables.h"
#include "mechanics/constrained_system.h"

namespace pseudorigid::continuum {

class ElasticBall {
 public:
  using Vector = continuum::Vector;
  using Multiplier = continuum::Vector;
  struct Workspace {
    GramSolver gram;
  };
  static constexpr int n_constraints = mechanics::dynamic_constraints;

  /// The sector of the unit ball with degree k = 2 … 6 after n_refinements uniform refinements of the octant's 4 cells,
  /// over the ranks of a communicator.
  ElasticBall(const Sector& sector, int degree, int n_refinements, const materials::AnyLaw& law,
              MPI_Comm communicator = MPI_COMM_SELF, std::optional<GramMethod> gram_method = std::nullopt);

  mechanics::Status force(double t, const Vector& x, const Vector& v, Workspace& workspace, Vector& f) const;
  void apply_inverse_mass(const Vector& f, Vector& a) const;
  mechanics::Status constraint(const Vector& x, Multiplier& g) const;
  void constraint_rate(const Vector& x, const Vector& v, Multiplier& r) const { kernels_->constraint_rate(x, v, r); }
  void constraint_curvature(const Vector& x, const Vector& v, Multiplier& r) const {
    kernels_->constraint_curvature(x, v, r);
  }
  void add_reaction(const Vector& x, const Multiplier& lambda, Vector& f) const {
    kernels_->add_reaction(x, lambda, f);
  }
  mechanics::SolveReport solve_gram(const Vector& x1, const Vector& x0, const Multiplier& r, Workspace& workspace,
                                    Multiplier& lambda) const {
    return workspace.gram.solve(x1, x0, r, lambda);
  }
  /// |g|_∞ and |Gv|_∞ that count as zero: 1e-13 in the scale of ln J (the ψ are L²-orthonormal in their cells).
  double constraint_tolerance() const { return 1e-13 * multiplier_scale(); }
  /// |g|_∞ / multiplier_scale() is a bound for the mean of |ln J| over a cell.
  double multiplier_scale() const;

  Vector make_vector() const { return space_.make_vector(); }
  Multiplier make_multiplier() const { return space_.make_multiplier(); }
  Workspace make_workspace() const { return {GramSolver(space_, *kernels_, gram_method_)}; }

  /// x = A X at every node: positions for A = Q₀, velocities for A = Q̇₀.
  Vector affine_field(const Eigen::Matrix3d& A) const;
  /// Q_M = (∫ρ x Xᵀ dV) E₀⁻¹ of a field x (its rate from a velocity).
  Eigen::Matrix3d mass_moment(const Vector& x) const;

  /// Inertia and volume of the mesh, whole ball: E₀,h = Σ m_n X_n X_nᵀ.
  const Eigen::Matrix3d& E0() const { return E0_; }
  double volume() const { return volume_; }
  const BallSpace& space() const { return space_; }
  const CellKernels& kernels() const { return *kernels_; }

  /// A 3×3 integral over the whole ball from that over the sector: its (i, j) entry is odd under a reflection of
  /// exactly one of x_i and x_j, and then cancels.
  Eigen::Matrix3d whole_ball(const Eigen::Matrix3d& sector_integral) const;
  /// Σ_n m_n a_n b_nᵀ over the whole ball.
  Eigen::Matrix3d nodal_moment(const Vector& a, const Vector& b) const;

 private:
  mechanics::Status judge_jacobian(double least, const Vector& x) const;

  BallSpace space_;
  std::unique_ptr<CellKernels> kernels_;
  GramMethod gram_method_;
  Eigen::Matrix3d E0_;
  double volume_, least_cell_volume_;
};

/// Observables at one state, whole ball, internal units; fails where the force fails.
mechanics::Status observe(const ElasticBall& ball, const mechanics::State<ElasticBall>& state,
                          ElasticBall::Workspace& workspace, const mechanics::ObservableRequest& request,
                          mechanics::ContinuumObservables& observables);

}  // namespace pseudorigid::continuum
