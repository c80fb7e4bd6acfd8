#pragma once
/// Integrals over the cells of the ball, matrix-free. With F = ∇x, J = det F, ψ_j the L²-orthonormal basis of P_{k−1}
/// in each cell (unmapped), φ the shape functions, W + U the stored energy (stored_energy.h) and λ_h = Σ λ_j ψ_j the
/// Kirchhoff pressure:
///
///   force           f_n = −∫ ∂(W + U)/∂F ∇φ_n dX
///   constraint      g_j = ∫ ψ_j ln J dX
///   rate            (G v)_j = ∫ ψ_j tr(F⁻¹∇v) dX
///   curvature       D²g(v, v)_j = −∫ ψ_j tr((F⁻¹∇v)²) dX
///   reaction        (Gᵀλ)_n = ∫ λ_h F⁻ᵀ ∇φ_n dX
///   viscous force   f_n = −∫ 2ηJ d F⁻ᵀ ∇φ_n dX,   d = sym(∇v F⁻¹),   with the power ∫ 2ηJ d:d dX
///
/// Vectors may be distributed: each rank integrates over its own cells, reads ghost entries that the kernels bring up
/// to date, and adds to those of others. Sums and minima over cells are those of the rank.
///
/// The integrals themselves are those of local_kernels.h: one implementation a degree (cell_kernels_impl.h); the law is
/// a function that it calls for the points of a batch (point_law.h).

#include <memory>
#include <span>

#include "continuum/kernels/local_kernels.h"
#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

class CellKernels {
 public:
  CellKernels(const BallSpace& space, std::unique_ptr<LocalKernels> local);

  /// f = −∫∂(W + U)/∂F ∇φ. Returns the least of J and of the law's reserve; if it is not positive, f is not to be
  /// used.
  double force(const Vector& x, Vector& f) const;
  /// The same with the reaction G(x)ᵀλ, which costs a third of a separate evaluation. `at_x`, of double precision,
  /// becomes the tangent at x unless it is null.
  double force_with_reaction(const Vector& x, const Vector& lambda, ConstraintTangent* at_x, Vector& f) const;
  /// g; returns the least J; if it is not positive, g is not to be used.
  double constraint(const Vector& x, Vector& g) const;
  void constraint_rate(const Vector& x, const Vector& v, Vector& r) const;
  void constraint_curvature(const Vector& x, const Vector& v, Vector& r) const;
  /// Empty: for set_tangent.
  std::unique_ptr<ConstraintTangent> make_tangent(Precision precision) const { return local_->make_tangent(precision); }
  void set_tangent(const Vector& x, ConstraintTangent& tangent) const;
  void constraint_rate(const ConstraintTangent& at_x, const Vector& v, Vector& r) const;
  void add_reaction(const ConstraintTangent& at_x, const Vector& lambda, Vector& f) const;
  void add_reaction(const Vector& x, const Vector& lambda, Vector& f) const;
  /// f += the viscous force; returns its power, which dissipation takes.
  double add_viscous_force(double viscosity, const Vector& x, const Vector& v, Vector& f) const;

  CellIntegrals integrals(const Vector& x, const Vector& v) const;
  /// Least det F over the quadrature points of this rank, with its reference position.
  LeastPlace locate_least_jacobian(const Vector& x) const;
  /// The least value of a function of F, given row by row, with its place.
  LeastPlace locate_least(const Vector& x, const FunctionOfF& value) const;
  /// The least reserve of the law, with its place (materials/law_limits.h).
  LeastPlace locate_least_reserve(const Vector& x) const;
  /// λ_h at the nodes of a cell (first direction fastest).
  void multiplier_at_nodes(const Vector& lambda, unsigned int cell, std::span<double> values) const;

  /// Calls `use(cell, rows)` for each cell; rows[j·3n + 3i + c] is the entry of G for function j, node i, component c.
  void constraint_rows(const Vector& x, const UseRows& use) const;
  /// Calls `use(cell, values)` for each cell; values[j·n + i] is ψ_j at the cell's node i.
  void pressure_basis_at_nodes(const UseRows& use) const;

  /// Volume of the sector and of its smallest cell, by the quadrature of the kernels.
  double reference_volume() const { return local_->reference_volume(); }
  double least_cell_volume() const { return local_->least_cell_volume(); }
  /// Bytes held for geometry, indices and basis.
  std::size_t memory() const { return local_->memory(); }

 private:
  /// Q1 with a constant pressure is not stable.
  void require_constraint() const;

  std::unique_ptr<LocalKernels> local_;
  int degree_;
};

/// Data of the kernels of a space.
LocalCells local_cells(const BallSpace& space);

/// Kernels for the degree of the space (1 … 8) and the stored energy. Throws std::invalid_argument for another degree.
/// Degree 1 is for compressible bodies: the functions of the constraint then throw std::invalid_argument.
std::unique_ptr<CellKernels> make_cell_kernels(const BallSpace& space, const StoredEnergy& stored);

}  // namespace pseudorigid::continuum
