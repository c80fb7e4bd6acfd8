#pragma once
/// Integrals over the cells of the ball, matrix-free. With F = ∇x, J = det F, ψ_j the L²-orthonormal basis of P_{k−1}
/// in each cell (unmapped), φ the shape functions and λ_h = Σ λ_j ψ_j the Kirchhoff pressure:
///
///   force           f_n = −∫ P(F) ∇φ_n dX
///   constraint      g_j = ∫ ψ_j ln J dX
///   rate            (G v)_j = ∫ ψ_j tr(F⁻¹∇v) dX
///   curvature       D²g(v, v)_j = −∫ ψ_j tr((F⁻¹∇v)²) dX
///   reaction        (Gᵀλ)_n = ∫ λ_h F⁻ᵀ ∇φ_n dX
///   viscous force   f_n = −∫ 2ηJ d F⁻ᵀ ∇φ_n dX,   d = sym(∇v F⁻¹),   with the power ∫ 2ηJ d:d dX
///
/// Vectors may be distributed: each rank integrates over its own cells, reads ghost entries that the kernels bring up
/// to date, and adds to those of others. Sums and minima over cells are those of the rank.
///
/// One implementation a degree (cell_kernels_impl.h), chosen at run time by make_cell_kernels; the law is a function
/// that it calls for the points of a batch (point_law.h).

#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>
#include <span>

#include "continuum/kernels/least_place.h"
#include "continuum/mesh/ball_space.h"
#include "materials/law_table.h"

namespace pseudorigid::continuum {

/// Integrals over the computed sector that observables are made of.
struct CellIntegrals {
  double elastic = 0;                  ///< ∫W dX
  double volume = 0;                   ///< ∫J dX
  dealii::Tensor<2, 3> F;              ///< ∫F dX
  dealii::Tensor<2, 3> X_pulled_back;  ///< ∫ρ X ⊗ (Fᵀẋ) dX
};

class CellKernels {
 public:
  virtual ~CellKernels() = default;

  /// f = −∫P:∇φ. Returns the least of J and of the law's reserve; where it is not positive, f is not to be used.
  virtual double force(const Vector& x, Vector& f) const = 0;
  /// g; returns the least J; where it is not positive, g is not to be used.
  virtual double constraint(const Vector& x, Vector& g) const = 0;
  virtual void constraint_rate(const Vector& x, const Vector& v, Vector& r) const = 0;
  virtual void constraint_curvature(const Vector& x, const Vector& v, Vector& r) const = 0;
  virtual void add_reaction(const Vector& x, const Vector& lambda, Vector& f) const = 0;
  /// f += the viscous force; returns its power, which dissipation takes.
  virtual double add_viscous_force(double viscosity, const Vector& x, const Vector& v, Vector& f) const = 0;

  virtual CellIntegrals integrals(const Vector& x, const Vector& v) const = 0;
  /// Least det F over the quadrature points of this rank, with its reference position.
  virtual LeastPlace locate_least_jacobian(const Vector& x) const = 0;
  /// Likewise the least value of a function of F, given row by row.
  virtual LeastPlace locate_least(const Vector& x, const std::function<double(const double* F)>& value) const = 0;
  /// Likewise the least reserve of the law (materials/law_limits.h).
  virtual LeastPlace locate_least_reserve(const Vector& x) const = 0;
  /// λ_h at the nodes of a cell (first direction fastest).
  virtual void multiplier_at_nodes(const Vector& lambda, unsigned int cell, std::span<double> values) const = 0;

  /// Calls `use(cell, rows)` for each cell; rows[j·3n + 3i + c] is the entry of G for function j, node i, component c.
  using UseRows = std::function<void(unsigned int, std::span<const double>)>;
  virtual void constraint_rows(const Vector& x, const UseRows& use) const = 0;
  /// Calls `use(cell, values)` for each cell; values[j·n + i] is ψ_j at the cell's node i.
  virtual void pressure_basis_at_nodes(const UseRows& use) const = 0;

  /// Volume of the sector and of its smallest cell, by the quadrature of the kernels.
  virtual double reference_volume() const = 0;
  virtual double least_cell_volume() const = 0;
  /// Bytes held for geometry, indices and basis.
  virtual std::size_t memory() const = 0;
};

/// Kernels for the degree of the space (1 … 8) and the law. Throws std::invalid_argument for another degree. Degree 1
/// is for compressible bodies: with it, what belongs to the constraint throws std::invalid_argument.
std::unique_ptr<CellKernels> make_cell_kernels(const BallSpace& space, const materials::AnyLaw& law);

}  // namespace pseudorigid::continuum
