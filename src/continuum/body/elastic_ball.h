#pragma once
/// The incompressible elastic ball as a constrained system of the mechanics core:
///
///   M ẍ = −∫P:∇φ + loads + Gᵀλ,   g_j = ∫ψ_j ln J dX = 0                   (generalized Newton law, Oliva 5.3–5.4)
///
/// with the first Piola–Kirchhoff stress P, the basis functions φ of the displacements in (Q_k)³, J = det F and G = Dg.
/// The functions ψ_j are an L²-orthonormal basis of the multipliers λ_h = Σ λ_j ψ_j. A multiplier is a polynomial in
/// P_{k−1} on each cell and may jump between cells. The field λ_h is the Kirchhoff pressure Jp, with the pressure p
/// inside the body. The constraint balances a uniform pressure on the surface, so this load is not a force of the
/// system. The constraint uses ln J instead of J − 1. Therefore the second variation of the constraint along a
/// displacement u does not contain the square of div u. In addition, a multiple of ln J in the stored energy W changes
/// only the multiplier and not the discrete motion.
///
/// If the stored energy has a projected bulk term B (kernels/stored_energy.h), the ball is nearly incompressible. The
/// energy ∫B(θ_h) dX with θ_h = Σ g_j ψ_j then replaces the condition g = 0 (mechanics::Compliant). λ_h is minus the
/// projection of B′(θ_h). A pressure on the surface is a load.

#include <cmath>
#include <optional>
#include <utility>

#include "continuum/body/ball_body.h"
#include "continuum/constraint/gram_solver.h"
#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {

class ElasticBall : public BallBody {
 public:
  using Multiplier = continuum::Vector;
  struct Workspace {
    GramSolver gram;
    /// Euclidean norm of the residual that is sufficient for the caller of solve_gram. If it is 0, only the relative
    /// bound of GramSolver::solve applies.
    double residual_sought = 0;
    /// Null: contact with the planes. Otherwise springs replace the contact (BallBody::applied_force), and `*held_at`
    /// has the nodal positions at which the springs exert no force.
    const Vector* held_at = nullptr;
    double gram_shift = 0;  ///< σ of solve_gram (GramSolver::solve)

    template <class Visit>
    void visit_memory(Visit&& visit) {
      gram.visit_memory(visit);
    }
  };
  static constexpr int n_constraints = mechanics::dynamic_constraints;

  /// The constructors of BallBody, with a choice of the solver of the Gram systems. If `gram_method` is empty,
  /// fitting_gram_method chooses the solver.
  ElasticBall(const Sector& sector, int degree, int n_refinements, const StoredEnergy& stored,
              const loads::Loads& loads = {}, MPI_Comm communicator = MPI_COMM_SELF,
              std::optional<GramMethod> gram_method = std::nullopt)
      : ElasticBall(BallMesh(sector, n_refinements, communicator), degree, stored, loads, std::nullopt, std::nullopt,
                    gram_method) {}
  ElasticBall(BallMesh mesh, int degree, const StoredEnergy& stored, const loads::Loads& loads = {},
              std::optional<int> n_gravity_points = std::nullopt, std::optional<int> n_contact_points = std::nullopt,
              std::optional<GramMethod> gram_method = std::nullopt)
      : BallBody(std::move(mesh), degree, stored, stored.projected_bulk > 0 ? loads : loads::at_constant_volume(loads),
                 n_gravity_points, n_contact_points),
        gram_method_(gram_method.value_or(fitting_gram_method(space()))),
        multiplier_scale_(std::sqrt(least_over_ranks(kernels().least_cell_volume(), space().communicator()))) {}

  /// All forces without the reactions. Fails if BallBody::judge fails. Collective.
  mechanics::Status force(double t, const Vector& x, const Vector& v, Workspace& workspace, Vector& f) const {
    return applied_force(t, x, v, workspace.held_at, f);
  }
  /// All forces with the reactions Gᵀλ. The call takes less time than separate calls of `force` and `add_reaction`.
  /// Fails if BallBody::judge fails. Collective.
  mechanics::Status force_with_reaction(double t, const Vector& x, const Vector& v, const Multiplier& lambda,
                                        Workspace& workspace, Vector& f) const {
    return complete_force(t, x, v, workspace.gram.force_with_reaction(x, lambda, f), workspace.held_at, f);
  }
  /// Sets g to the constraint at the position x. Fails if BallBody::judge fails for the least det F. Collective.
  mechanics::Status constraint(const Vector& x, Multiplier& g) const { return judge(kernels().constraint(x, g), x); }
  /// `constraint_rate` sets r = G(x) v. `constraint_curvature` sets r = D²g(x)(v, v). Both functions are collective.
  void constraint_rate(const Vector& x, const Vector& v, Multiplier& r) const { kernels().constraint_rate(x, v, r); }
  void constraint_curvature(const Vector& x, const Vector& v, Multiplier& r) const {
    kernels().constraint_curvature(x, v, r);
  }
  /// f ← f + G(x)ᵀλ. With a workspace, the function can use a stored tangent (GramSolver::add_reaction). Collective.
  void add_reaction(const Vector& x, const Multiplier& lambda, Vector& f) const {
    kernels().add_reaction(x, lambda, f);
  }
  void add_reaction(const Vector& x, const Multiplier& lambda, Vector& f, Workspace& workspace) const {
    workspace.gram.add_reaction(x, lambda, f);
  }
  /// f ← f + Σ λ_j D²g_j(x)(v, ·). Collective.
  void add_reaction_rate(const Vector& x, const Vector& v, const Multiplier& lambda, Vector& f) const {
    kernels().add_reaction_rate(x, v, lambda, f);
  }
  /// κ of the energy that replaces the constraint (mechanics::Compliant); infinite if the ball is incompressible.
  double constraint_stiffness() const { return projected_bulk() > 0 ? projected_bulk() : HUGE_VAL; }
  /// b_j = ∫ψ_j B′(θ) dX with θ = Σ g_j ψ_j and the projected bulk term B.
  void constraint_force(const Multiplier& g, Multiplier& b) const { kernels().bulk(projected_bulk(), g, b); }
  /// Solves (G(x1) M⁻¹ G(x0)ᵀ + σ) λ = r with σ = workspace.gram_shift and the accuracy of GramSolver::solve, in which
  /// `enough` is workspace.residual_sought. Fails if GramSolver::solve fails. Collective.
  mechanics::SolveReport solve_gram(const Vector& x1, const Vector& x0, const Multiplier& r, Workspace& workspace,
                                    Multiplier& lambda) const {
    return workspace.gram.solve(x1, x0, r, workspace.residual_sought, workspace.gram_shift, lambda);
  }
  /// |g|_∞ and |Gv|_∞ count as zero up to this value. With this |g|_∞, the mean of ln J over the smallest cell is at
  /// most 1e-13, because the ψ_j are orthonormal in L² on each cell.
  double constraint_tolerance() const { return 1e-13 * multiplier_scale(); }
  /// The square root of the volume of the smallest cell. |g|_∞ / multiplier_scale() is a bound for the absolute value
  /// of the mean of ln J over a cell.
  double multiplier_scale() const { return multiplier_scale_; }

  Multiplier make_multiplier() const { return space().make_multiplier(); }
  Workspace make_workspace() const { return {GramSolver(space(), kernels(), gram_method_), 0}; }

 private:
  GramMethod gram_method_;
  double multiplier_scale_;
};

}  // namespace pseudorigid::continuum
