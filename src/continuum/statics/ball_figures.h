#pragma once
/// Figures of equilibrium of the finite-element ball, in one octant: steady rotations about axis 3, and the ball at
/// rest under loads (mechanics/equilibria/figures.h). The equations are
///
///   r = f(x) + ν h(x) + Gᵀλ = 0,   g(x) = 0,
///
/// without λ and g for a compressible ball. G is the derivative of the constraint g. f contains the elastic force, the
/// volumetric stabilisation and self-gravity. For a rotation of a compressible ball, f also contains the pressure on
/// the surface. For a rotation with the spin Ω, ν = Ω² and h_n = m_n P x_n. Here m_n is the mass and x_n the position
/// of node n, and P is the projection onto the plane normal to axis 3. For the ball at rest, ν is the factor of the
/// loads h. The planes of the octant exclude rotations of space and of the undeformed ball. These rotations therefore
/// do not make K singular.
///
/// The equations are solved by Newton's iteration. Each step solves K δx − Gᵀδλ = r, Gδx = −g with the tangent K
/// (tangent_problem.h), by GMRES (tangent_solver.h). If
/// the condition of the figure is a ratio of two axes, δν is also unknown, and the condition is w·δx = c with a vector
/// w. K is singular if the family has a fold. Therefore δx is then the sum of two solutions with K + σwwᵀ in place of K
/// and a number σ > 0:
///
///   δx = u₀ + δν u₁,   (K + σwwᵀ)u₀ − Gᵀδλ₀ = r + σcw,   (K + σwwᵀ)u₁ − Gᵀδλ₁ = h,   w·δx = c.
///
/// A factorisation takes about as long as four steps with known factors. With a factorisation, a step with the ν of the
/// condition therefore keeps the tangent of an earlier step. This ends when the residual falls by a factor of less than
/// 5 in a step. With V-cycles, each step has a new tangent. The relative tolerance of its linear equations is then the
/// residual relative to the terms, but at least 1e-8 and at most 1e-5. Newton's iteration still converges quadratically
/// (Dembo, Eisenstat & Steihaug 1982). If the residual is near round-off, a larger tolerance suffices.
///
/// The iteration ends at a figure whose residual is round-off. A step from a residual below 1e-7 that divides it by ten
/// or more leads to round-off, because the convergence is quadratic. Otherwise a further step must show that a small
/// residual does not halve.
///
/// K is also singular at a bifurcation to figures that are not symmetric about axis 3. The search for a spheroid is
/// therefore restricted to positions that are symmetric under the exchange of the axes 1 and 2. These positions exclude
/// the figures that bifurcate with the azimuthal number 2, such as Jacobi's ellipsoids. The search for an ellipsoid is
/// not restricted. It may follow the spheroids to the neighbourhood of the bifurcation
/// (mechanics/equilibria/figure_family.h).

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "continuum/body/compressible_ball.h"
#include "continuum/body/elastic_ball.h"
#include "continuum/parallel/sector_ranks.h"
#include "continuum/statics/shared_octant.h"
#include "continuum/statics/tangent_solver.h"
#include "mechanics/equilibria/figures.h"

namespace pseudorigid::continuum {

/// A state of Newton's iteration.
struct NewtonStep {
  int number;              ///< number of steps before this state
  double drive, residual;  ///< ν, and the residual relative to the terms
  long n_linear_products;  ///< number of products of GMRES in the step to this state
};

/// The ball whose figures are sought.
struct FigureSetup {
  int degree;         ///< degree k of the elements
  int n_refinements;  ///< number of uniform refinements of the four coarse cells of an octant
  StoredEnergy stored;
  loads::Loads loads;
  bool incompressible;
  Drive drive;  ///< a rotation uses only self-gravity and, for a compressible body, the pressure
  mechanics::Figure figure;
  std::function<void(const NewtonStep&)> watch{};  ///< called for each state of Newton's iteration; may be empty
};

/// Numbers of operations since the construction of BallFigures.
struct FigureCounts {
  long newton = 0;           ///< steps of Newton's iteration
  long factorizations = 0;   ///< factorisations of a tangent
  long linear_products = 0;  ///< products of GMRES with a tangent
};

class BallFigures final : public mechanics::FigureEquations {
 public:
  using Figure = mechanics::EquilibriumFigure;

  /// With several `ranks`, the ranks share the cells of a large body with V-cycles (tangent_solver.h). For other
  /// bodies, the first rank solves the equations of the figures, and the others receive the results. The solutions and
  /// the functions of the base class are collective.
  explicit BallFigures(const FigureSetup& setup, SectorRanks ranks = {});
  ~BallFigures() override;
  BallFigures(const BallFigures&) = delete;  // because some members refer to other members
  BallFigures& operator=(const BallFigures&) = delete;

  Figure affine(const Eigen::Vector3d& a, double drive) const override;
  /// The whole octant, which each rank has.
  const BallBody& body() const { return *body_; }
  /// The numbers of operations of this rank.
  const FigureCounts& counts() const { return counts_; }
  const SectorRanks& ranks() const { return ranks_; }
  Drive drive() const { return kind_; }
  const loads::Forcing& forcing() const { return forcing_; }  ///< the sum of the loads
  /// The largest residual, relative to the terms, of a figure that Newton's iteration accepts. It grows with the
  /// round-off of the forces, and so with ρgr and the Lamé modulus over the shear modulus.
  double accepted_residual() const;
  double typical_stiffness() const { return continuum::typical_stiffness(stored_, incompressible_, forcing_); }
  /// `permits_rotation_of_space` is true if rotations of space about the axis do not change the energy.
  /// `permits_rotation_of_ball` is true if rotations of the undeformed ball about the axis do not change the energy.
  bool permits_rotation_of_space(int axis) const;
  bool permits_rotation_of_ball(int axis) const;
  /// True if the figure with this drive ν has rotational symmetry about an axis. A rotation of the ball about this axis
  /// then has the same effect as a rotation of space.
  bool is_symmetric_about(int axis, double drive) const;

  /// True if the figures are symmetric under the exchange of the axes 1 and 2.
  bool is_symmetric_under_exchange() const { return !exchanged_.empty(); }
  /// The image of a displacement under this exchange. Requires is_symmetric_under_exchange().
  Vector exchanged(const Vector& u) const;

  /// The nodal positions and the multiplier of a figure on the whole octant. The multiplier of a compressible ball is
  /// 0.
  Vector positions(const Figure& figure) const;
  Vector multiplier(const Figure& figure) const;
  /// The state of a figure with the positions x, the multiplier `lambda` and the drive ν. x and `lambda` must outlive
  /// the result.
  FigureState state(const Vector& x, const Vector& lambda, double drive) const {
    return state_of(*body_, x, lambda, drive);
  }

 private:
  using Condition = mechanics::FigureCondition;
  /// The terms of the equations at a figure. Components that a plane of the octant fixes are 0.
  struct Terms {
    Vector force, drive, reaction;  ///< f, h and Gᵀλ
    Vector constraint;              ///< g; empty for a compressible ball
    /// Returns the residual r = f + ν h + Gᵀλ.
    Vector residual(double nu) const;
  };

  mechanics::Status newton(const Condition& condition, Figure& figure) const override {
    const mechanics::Status status = solves_here() ? newton_here(condition, figure) : mechanics::Status();
    share(figure);
    return ranks_.of_all(status);
  }
  Figure tangent(const Condition& condition, const Figure& figure, double tolerance) const override {
    Figure result = solves_here() ? tangent_here(condition, figure, tolerance) : figure;
    share(result);
    return result;
  }
  mechanics::Status complete(Figure& figure) const override {
    const mechanics::Status status = solves_here() ? complete_here(figure) : mechanics::Status();
    share(figure);
    return ranks_.of_all(status);
  }
  bool is_admissible(const Eigen::VectorXd& x) const override;
  double error_of_solver() const override { return 1e-4; }
  /// Replaces `figure` by that of the first rank on all ranks. Collective.
  void share(Figure& figure) const;
  /// True if this rank solves equations.
  bool solves_here() const { return shared_ || ranks_.is_first(); }
  /// The work for the functions of the base class, on ranks that solve equations. If the ranks share the body, these
  /// functions and those that they call are collective.
  mechanics::Status newton_here(const Condition& condition, Figure& figure) const;
  Figure tangent_here(const Condition& condition, const Figure& figure, double tolerance) const;
  mechanics::Status complete_here(Figure& figure) const;
  bool is_admissible_here(const Eigen::VectorXd& x) const;

  mechanics::Status terms(const Figure& figure, Terms& terms) const;
  /// A tangent K with its factors. It has copies of the fields to which the tangent refers.
  struct Factors;
  /// Solves K δx − Gᵀδλ = f, G δx = h at a figure, for each pair of right sides (f, h). Sets `changes` to the
  /// solutions, with δν = 0. For a spheroid, each δx is then symmetrized (`symmetrize`). Fails if K cannot be
  /// factorised or GMRES does not converge. If `held` is not null, K contains the term σwwᵀ of `held`. Otherwise, and
  /// if reuses_factors_ is true, K and G are those of the last call without `held`. The tolerance is relative.
  mechanics::Status solve_linear(const Figure& figure, const HeldDirection* held, double tolerance,
                                 const std::vector<std::pair<Vector, Vector>>& right_sides,
                                 std::vector<Figure>& changes) const;
  /// Sets `change` to the solution (δx, δλ, δν) of K δx − δν h − Gᵀδλ = f, G δx = minus_g and w·δx = c. The vector w is
  /// that of a condition on the ratio of axes, and `drive` is h.
  mechanics::Status solve_with_condition(const Condition& condition, const Figure& figure, const Vector& f,
                                         const Vector& minus_g, const Vector& drive, double c, double tolerance,
                                         Figure& change) const;
  /// Sets `step` to the step of Newton's iteration from `figure`, whose terms are `now`. The tolerance is that of the
  /// linear equations.
  mechanics::Status step(const Condition& condition, const Figure& figure, const Terms& now, double tolerance,
                         Figure& step) const;
  /// Returns the vector w with w·x = a_k − b a₁ for each field x, whose affine part is A = diag(a). The axis k and the
  /// ratio b = exp(value) are those of the condition. The result also contains σ (`stiffness`).
  HeldDirection axis_direction(const Condition& condition) const;
  /// The largest entry of the terms f, ν h and Gᵀλ, or a typical elastic force on a node if this force is larger.
  double scale_of(const Figure& figure, const Terms& terms) const;
  FigureState state_of(const BallBody& body, const Vector& x, const Vector& lambda, double drive) const {
    return {body, stored_, forcing_, incompressible_, kind_, x, lambda, drive};
  }
  /// The body on which this rank solves equations, and its vectors for the entries of a figure.
  const BallBody& solved() const { return shared_ ? shared_->body() : *body_; }
  Vector field(const Eigen::VectorXd& x) const;
  Vector multiplier(const Eigen::VectorXd& lambda) const;
  /// The change of a figure with these vectors of the body.
  Figure change(const Vector& u, const Vector& lambda) const;
  /// For a spheroid, replaces the displacement u by the mean of u and its image under the exchange of the axes 1 and 2.
  /// For an ellipsoid, does nothing.
  void symmetrize(Eigen::VectorXd& u) const;
  void find_exchanged_nodes();

  StoredEnergy stored_;
  bool incompressible_;
  Drive kind_;
  int n_refinements_;
  std::function<void(const NewtonStep&)> watch_;
  SectorRanks ranks_;
  std::shared_ptr<const BallBody> body_;        ///< shared, because BallBody has no virtual destructor
  std::unique_ptr<const SharedOctant> shared_;  ///< null if the ranks do not share the body
  loads::Forcing forcing_;
  std::vector<unsigned int> exchanged_;  ///< the node at (X_2, X_1, X_3) for the node at X; empty for an ellipsoid
  mutable FigureCounts counts_;
  mutable std::unique_ptr<Factors> factors_;  ///< of the last tangent without a held direction; null if there is none
  mutable bool reuses_factors_ = false;
};

}  // namespace pseudorigid::continuum
