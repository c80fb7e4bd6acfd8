#pragma once
/// The integrals of cell_kernels.h over the cells of one process. A vector is a pointer to its entries on this process.
/// The entries of the own nodes come first, and then those of ghost nodes. In vectors that a function reads, the
/// entries of ghost nodes must be up to date. In a force, the entries of ghost nodes receive contributions, which the
/// caller must add to the entries of their owners (add_to_owners). This file does not depend on deal.II, so the kernels
/// compile in a few seconds per degree.

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "continuum/kernels/branch_kernels.h"
#include "continuum/kernels/stored_energy.h"
#include "continuum/mesh/reference_cell.h"
#include "continuum/parallel/least_place.h"

namespace pseudorigid::continuum {

/// The cells of this process as the kernels use them. All members must outlive the kernels.
struct LocalCells {
  const ReferenceCell& reference;
  const std::vector<std::vector<unsigned int>>& nodes;  ///< local numbers: [cell][node], first direction fastest
  const double* positions;                              ///< X, entry 3·node + component
};

/// Integrals and extreme values over the cells, for the observables. W, U, J and F are those of cell_kernels.h, ρ is
/// the density, and ẋ is the velocity.
struct CellIntegrals {
  using Matrix = std::array<std::array<double, 3>, 3>;
  double elastic = 0;                                      ///< stored energy of the law, ∫W dX
  double volumetric = 0;                                   ///< energy of the volumetric stabilisation, ∫U dX
  double volume = 0;                                       ///< current volume, ∫J dX
  Matrix F{};                                              ///< ∫F dX
  Matrix X_pulled_back{};                                  ///< ∫ρ X ⊗ (Fᵀẋ) dX
  double squared_log_J = 0;                                ///< integral ∫(ln J)² dX
  double largest_squared_log_J = 0;                        ///< largest (ln J)² at a quadrature point
  double least = std::numeric_limits<double>::infinity();  ///< least value of J and of the law's reserve
};

/// A function that is called as `use(cell, values)` for each cell. The values are valid only during the call.
using UseRows = std::function<void(unsigned int, std::span<const double>)>;

/// A function of the deformation gradient F. Its argument points to the nine entries of F, row by row.
using FunctionOfF = std::function<double(const double* F)>;

/// A function that sets the values of a cell. It is called as `fill(cell, values)`.
using FillCell = std::function<void(unsigned int, std::span<double>)>;

enum class Precision { single_precision, double_precision };

/// The derivative of the constraint at given positions, for many products (constraint_tangents.h). `precision` is that
/// of the stored numbers.
class ConstraintTangent {
 public:
  explicit ConstraintTangent(Precision precision) : precision_(precision) {}
  virtual ~ConstraintTangent() = default;
  Precision precision() const { return precision_; }

 private:
  Precision precision_;
};

/// The stiffness of the cells at given positions, for many products (stiffness_tangents.h).
class StiffnessTangent {
 public:
  static constexpr int n_entries = 45;  ///< entries (row, column) with row ≤ column of a symmetric 9×9 matrix, by rows
  virtual ~StiffnessTangent() = default;
};

class LocalKernels {
 public:
  virtual ~LocalKernels() = default;
  /// Adds the elastic force −∂/∂x ∫(W + U) dX of the stored energy (stored_energy.h) to f. Returns the least value of J
  /// and of `reserve(F)` of the law over all quadrature points of this process. The reserve is positive if the law
  /// admits F (materials/law_limits.h).
  virtual double add_force(const double* x, double* f) const = 0;
  /// Adds the force of `add_force` and the reaction G(x)ᵀλ to f in one pass over the cells. Returns the same value as
  /// `add_force`. If `at_x` is not null, it must have double precision and is set to the tangent at x.
  virtual double add_force_with_reaction(const double* x, const double* lambda, ConstraintTangent* at_x,
                                         double* f) const = 0;
  virtual double constraint(const double* x, double* g) const = 0;
  virtual double bulk(double lambda, const double* g, double* b) const = 0;
  virtual void constraint_rate(const double* x, const double* v, double* r) const = 0;
  virtual void constraint_curvature(const double* x, const double* v, double* r) const = 0;
  virtual void add_reaction(const double* x, const double* lambda, double* f) const = 0;
  virtual void add_reaction_rate(const double* x, const double* v, const double* lambda, double* f) const = 0;
  virtual std::unique_ptr<ConstraintTangent> make_tangent(Precision precision) const = 0;
  virtual void set_tangent(const double* x, ConstraintTangent& tangent) const = 0;
  virtual void constraint_rate(const ConstraintTangent& at_x, const double* v, double* r) const = 0;
  virtual void add_reaction(const ConstraintTangent& at_x, const double* lambda, double* f) const = 0;
  virtual std::unique_ptr<StiffnessTangent> make_stiffness(const FillCell& fill) const = 0;
  virtual void add_stiffness_product(const StiffnessTangent& tangent, const double* u, double* f) const = 0;
  virtual double add_viscous_force(double viscosity, const double* x, const double* v, double* f) const = 0;
  virtual const BranchKernels& branches() const = 0;
  virtual CellIntegrals integrals(const double* x, const double* v) const = 0;
  virtual LeastPlace locate_least_jacobian(const double* x) const = 0;
  virtual LeastPlace locate_least(const double* x, const FunctionOfF& value) const = 0;
  virtual LeastPlace locate_least_reserve(const double* x) const = 0;
  virtual void multiplier_at_nodes(const double* lambda, unsigned int cell, std::span<double> values) const = 0;
  virtual void multiplier_at_points(const double* lambda, unsigned int cell, std::span<double> values) const = 0;
  virtual void constraint_rows(const double* x, const UseRows& use) const = 0;
  virtual void pressure_basis_at_nodes(const UseRows& use) const = 0;
  virtual double reference_volume() const = 0;
  virtual double least_cell_volume() const = 0;
  virtual std::size_t memory() const = 0;
};

/// Makes the kernels of one degree. They use SIMD vectors with few_lanes lanes if there are at most few_lanes cells,
/// and otherwise with native_lanes lanes. Each degree has its own source file.
template <int degree>
std::unique_ptr<LocalKernels> make_local_kernels(const LocalCells& cells, const StoredEnergy& stored);

}  // namespace pseudorigid::continuum
