#pragma once
/// Matrix-free integrals over the cells of the ball. Let F = ∇x and J = det F, and let ψ_j be the L²-orthonormal basis
/// of P_{k−1} in each cell (polynomials in X). The shape functions are φ_n, the stored energy is W + U
/// (stored_energy.h), and the Kirchhoff pressure is λ_h = Σ λ_j ψ_j. The velocity is v, and the viscosity is η.
///
///   force           f_n = −∫ ∂(W + U)/∂F ∇φ_n dX
///   constraint      g_j = ∫ ψ_j ln J dX
///   rate            (G v)_j = ∫ ψ_j tr(F⁻¹∇v) dX
///   curvature       D²g(v, v)_j = −∫ ψ_j tr((F⁻¹∇v)²) dX
///   reaction        (Gᵀλ)_n = ∫ λ_h F⁻ᵀ ∇φ_n dX
///   rate of it      Σ λ_j D²g_j(v, ·)_n = −∫ λ_h F⁻ᵀ (∇v)ᵀ F⁻ᵀ ∇φ_n dX
///   viscous force   f_n = −∫ 2ηJ d F⁻ᵀ ∇φ_n dX,   d = sym(∇v F⁻¹),   with the power ∫ 2ηJ d:d dX
///
/// Vectors may be distributed over ranks. Each rank integrates over its own cells. The functions update the ghost
/// entries that they read, and add contributions to entries that other ranks own. Functions that read positions or
/// velocities, or that add forces, are therefore collective. Returned sums and minima are over the cells of this rank
/// only.
///
/// The class LocalKernels computes the integrals of one rank. It has one implementation per degree
/// (cell_kernels_impl.h), which evaluates the law at several points per call (point_law.h).

#include <memory>
#include <span>

#include "continuum/kernels/local_kernels.h"
#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

class CellKernels {
 public:
  CellKernels(const BallSpace& space, std::unique_ptr<LocalKernels> local);

  /// f = −∫∂(W + U)/∂F ∇φ. Returns the least of J and of the reserve of the law on this rank. The reserve is positive
  /// if the law admits F (materials/law_limits.h). If the returned value is not positive, f is not valid.
  double force(const Vector& x, Vector& f) const;
  /// Sets f to the force of `force` plus the reaction G(x)ᵀλ, and returns the same value as `force`. Here the reaction
  /// takes a third of the time of a separate call of add_reaction. If `at_x` is not null, it must have double precision
  /// and is set to the tangent at x.
  double force_with_reaction(const Vector& x, const Vector& lambda, ConstraintTangent* at_x, Vector& f) const;
  /// Computes g and returns the least J on this rank. If this value is not positive, g is not valid.
  double constraint(const Vector& x, Vector& g) const;
  /// Sets b_j = ∫ψ_j B′(θ) dX with θ = Σ g_j ψ_j and the bulk term B of the modulus λ (materials/bulk_energy.h).
  /// Returns ∫B(θ) dX over the cells of this rank.
  double bulk(double lambda, const Vector& g, Vector& b) const;
  /// `constraint_rate` sets r = G v, and `constraint_curvature` sets r = D²g(v, v), both at the positions x.
  void constraint_rate(const Vector& x, const Vector& v, Vector& r) const;
  void constraint_curvature(const Vector& x, const Vector& v, Vector& r) const;
  /// Allocates a tangent. Its values are undefined before set_tangent.
  std::unique_ptr<ConstraintTangent> make_tangent(Precision precision) const { return local_->make_tangent(precision); }
  /// `set_tangent` sets `tangent` to G at x. `constraint_rate` sets r = G v, and `add_reaction` computes f ← f + Gᵀλ,
  /// with G of the tangent or at x.
  void set_tangent(const Vector& x, ConstraintTangent& tangent) const;
  void constraint_rate(const ConstraintTangent& at_x, const Vector& v, Vector& r) const;
  void add_reaction(const ConstraintTangent& at_x, const Vector& lambda, Vector& f) const;
  void add_reaction(const Vector& x, const Vector& lambda, Vector& f) const;
  /// f ← f + Σ λ_j D²g_j(v, ·), the rate of Gᵀλ along v at the positions x.
  void add_reaction_rate(const Vector& x, const Vector& v, const Vector& lambda, Vector& f) const;
  /// The stiffness of the cells. `fill(cell, values)` must set values[entry·n_points + point] for the 45 entries of c
  /// (stiffness_tangents.h) at the Gauss points of a cell, with the first local direction as the fastest index.
  std::unique_ptr<StiffnessTangent> make_stiffness(const FillCell& fill) const { return local_->make_stiffness(fill); }
  /// f = K u with the stiffness K of the tangent.
  void stiffness_product(const StiffnessTangent& tangent, const Vector& u, Vector& f) const;
  /// f ← f + viscous force. Returns the power that this force dissipates on this rank.
  double add_viscous_force(double viscosity, const Vector& x, const Vector& v, Vector& f) const;

  /// f ← f − ∫ΣP_b:∇φ with the stresses P_b of viscoelastic branches at the internal metrics x.metrics
  /// (materials/maxwell_branch.h).
  void add_branch_force(const materials::MaxwellBranches& branches, const Vector& x, Vector& f) const;
  /// The energy ∫ΣW_b dX that the branches store on this rank, with the stored energies W_b of the branches.
  double branch_energy(const materials::MaxwellBranches& branches, const Vector& x) const;
  /// Replaces the metrics of x by their values after the time h. During this time the strain is constant: it is
  /// materials::mean_strain of the positions x0 and x. Returns the energy that each branch loses on this rank.
  materials::BranchEnergies relax_branches(const materials::MaxwellBranches& branches, double h, const Vector& x0,
                                           Vector& x) const;
  /// Allocates the metrics of x. Sets them to Ĉ = J^{−2/3} FᵀF at x if `relaxed` is true, and to the identity
  /// otherwise.
  void start_branches(std::size_t n_branches, bool relaxed, Vector& x) const;

  /// The integrals and extreme values over the cells of this rank, at the positions x and the velocity v.
  CellIntegrals integrals(const Vector& x, const Vector& v) const;
  /// Least det F over the quadrature points of this rank, with its reference position.
  LeastPlace locate_least_jacobian(const Vector& x) const;
  /// Least result of the function `value` over the quadrature points of this rank, with its place. The argument of
  /// `value` contains the entries of F row by row.
  LeastPlace locate_least(const Vector& x, const FunctionOfF& value) const;
  /// Least reserve of the law over the quadrature points of this rank, with its place (materials/law_limits.h). The
  /// value is infinite for a law without limits.
  LeastPlace locate_least_reserve(const Vector& x) const;
  /// Sets `values` to λ_h at the nodes of a cell. In `values`, the first local direction is the fastest index.
  void multiplier_at_nodes(const Vector& lambda, unsigned int cell, std::span<double> values) const;
  /// Sets `values` to λ_h at the Gauss points of a cell. In `values`, the first local direction is the fastest index.
  void multiplier_at_points(const Vector& lambda, unsigned int cell, std::span<double> values) const;

  /// Calls `use(cell, rows)` for each cell. For a cell with n nodes, rows[j·3n + 3i + c] is the entry of G for the
  /// function ψ_j, node i and component c.
  void constraint_rows(const Vector& x, const UseRows& use) const;
  /// Calls `use(cell, values)` for each cell. For a cell with n nodes, values[j·n + i] is ψ_j at node i.
  void pressure_basis_at_nodes(const UseRows& use) const;

  /// Reference volume of the cells of this rank, and of the smallest of these cells, by the quadrature of the kernels.
  double reference_volume() const { return local_->reference_volume(); }
  double least_cell_volume() const { return local_->least_cell_volume(); }
  /// Memory in bytes for the geometry, the indices of the nodes, and the basis ψ_j on this rank.
  std::size_t memory() const { return local_->memory(); }

 private:
  /// Throws std::invalid_argument for degree 1, because Q1 with a constant pressure is not stable.
  void require_constraint() const;

  std::unique_ptr<LocalKernels> local_;
  int degree_;
  std::size_t n_cells_, n_points_;  ///< numbers of cells of this rank and of Gauss points of a cell
};

/// The reference cell, the nodes of the cells and the reference positions, for the kernels.
LocalCells local_cells(const BallSpace& space);

/// Kernels for the degree of the space (1 … 8) and the stored energy. Throws std::invalid_argument for another degree,
/// and mechanics::NoKernels if chosen_kernels() throws it. Degree 1 is for compressible bodies only. With degree 1, the
/// functions that compute the constraint or its derivative from positions throw std::invalid_argument.
std::unique_ptr<CellKernels> make_cell_kernels(const BallSpace& space, const StoredEnergy& stored);

}  // namespace pseudorigid::continuum
