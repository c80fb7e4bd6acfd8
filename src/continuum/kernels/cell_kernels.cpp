#include "continuum/kernels/cell_kernels.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "continuum/kernels/kernel_table.h"
#include "continuum/parallel/ghost_values.h"

namespace pseudorigid::continuum {

const mechanics::KernelBuild<KernelTable>& chosen_kernels() {
  static const auto& build = mechanics::choose_build(builds_of_kernels());
  return build;
}

CellKernels::CellKernels(const BallSpace& space, std::unique_ptr<LocalKernels> local)
    : local_(std::move(local)), degree_(space.degree()), n_cells_(space.n_cells()), n_points_(space.nodes_per_cell()) {}

double CellKernels::force(const Vector& x, Vector& f) const {
  const GhostValues of_x(x);
  f = 0.0;
  const double least = local_->add_force(x.begin(), f.begin());
  add_to_owners(f);
  return least;
}

double CellKernels::force_with_reaction(const Vector& x, const Vector& lambda, ConstraintTangent* at_x,
                                        Vector& f) const {
  require_constraint();
  const GhostValues of_x(x);
  f = 0.0;
  const double least = local_->add_force_with_reaction(x.begin(), lambda.begin(), at_x, f.begin());
  add_to_owners(f);
  return least;
}

double CellKernels::constraint(const Vector& x, Vector& g) const {
  require_constraint();
  const GhostValues of_x(x);
  return local_->constraint(x.begin(), g.begin());
}

void CellKernels::constraint_rate(const Vector& x, const Vector& v, Vector& r) const {
  require_constraint();
  const GhostValues of_x(x);
  const GhostValues of_v(v);
  local_->constraint_rate(x.begin(), v.begin(), r.begin());
}

void CellKernels::constraint_curvature(const Vector& x, const Vector& v, Vector& r) const {
  require_constraint();
  const GhostValues of_x(x);
  const GhostValues of_v(v);
  local_->constraint_curvature(x.begin(), v.begin(), r.begin());
}

void CellKernels::add_reaction(const Vector& x, const Vector& lambda, Vector& f) const {
  require_constraint();
  const GhostValues of_x(x);
  local_->add_reaction(x.begin(), lambda.begin(), f.begin());
  add_to_owners(f);
}

void CellKernels::add_reaction_rate(const Vector& x, const Vector& v, const Vector& lambda, Vector& f) const {
  require_constraint();
  const GhostValues of_x(x);
  const GhostValues of_v(v);
  local_->add_reaction_rate(x.begin(), v.begin(), lambda.begin(), f.begin());
  add_to_owners(f);
}

void CellKernels::set_tangent(const Vector& x, ConstraintTangent& tangent) const {
  require_constraint();
  const GhostValues of_x(x);
  local_->set_tangent(x.begin(), tangent);
}

void CellKernels::constraint_rate(const ConstraintTangent& at_x, const Vector& v, Vector& r) const {
  const GhostValues of_v(v);
  local_->constraint_rate(at_x, v.begin(), r.begin());
}

void CellKernels::add_reaction(const ConstraintTangent& at_x, const Vector& lambda, Vector& f) const {
  local_->add_reaction(at_x, lambda.begin(), f.begin());
  add_to_owners(f);
}

void CellKernels::stiffness_product(const StiffnessTangent& tangent, const Vector& u, Vector& f) const {
  const GhostValues of_u(u);
  f = 0.0;
  local_->add_stiffness_product(tangent, u.begin(), f.begin());
  add_to_owners(f);
}

double CellKernels::add_viscous_force(double viscosity, const Vector& x, const Vector& v, Vector& f) const {
  const GhostValues of_x(x);
  const GhostValues of_v(v);
  const double power = local_->add_viscous_force(viscosity, x.begin(), v.begin(), f.begin());
  add_to_owners(f);
  return power;
}

void CellKernels::add_branch_force(const materials::MaxwellBranches& branches, const Vector& x, Vector& f) const {
  const GhostValues of_x(x);
  local_->branches().add_force(branches, x.metrics.data(), x.begin(), f.begin());
  add_to_owners(f);
}

double CellKernels::branch_energy(const materials::MaxwellBranches& branches, const Vector& x) const {
  const GhostValues of_x(x);
  return local_->branches().energy(branches, x.metrics.data(), x.begin());
}

materials::BranchEnergies CellKernels::relax_branches(const materials::MaxwellBranches& branches, double h,
                                                      const Vector& x0, Vector& x) const {
  const GhostValues of_x0(x0), of_x(x);
  return local_->branches().relax(branches, h, x0.begin(), x.begin(), x.metrics.data());
}

void CellKernels::start_branches(std::size_t n_branches, bool relaxed, Vector& x) const {
  constexpr std::size_t n_entries = materials::Symmetric<double>::n_entries;
  x.metrics.assign(n_cells_ * n_branches * n_entries * n_points_, 0.0);
  if (relaxed) {
    const GhostValues of_x(x);
    local_->branches().set_to_strain(n_branches, x.begin(), x.metrics.data());
    return;
  }
  for (std::size_t metric = 0; metric < n_cells_ * n_branches; ++metric)
    for (std::size_t k = 0; k < n_entries; ++k)
      std::fill_n(x.metrics.begin() + static_cast<std::ptrdiff_t>((metric * n_entries + k) * n_points_), n_points_,
                  materials::identity_metric.a[k]);
}

CellIntegrals CellKernels::integrals(const Vector& x, const Vector& v) const {
  const GhostValues of_x(x);
  const GhostValues of_v(v);
  return local_->integrals(x.begin(), v.begin());
}

LeastPlace CellKernels::locate_least_jacobian(const Vector& x) const {
  const GhostValues of_x(x);
  return local_->locate_least_jacobian(x.begin());
}

LeastPlace CellKernels::locate_least(const Vector& x, const FunctionOfF& value) const {
  const GhostValues of_x(x);
  return local_->locate_least(x.begin(), value);
}

LeastPlace CellKernels::locate_least_reserve(const Vector& x) const {
  const GhostValues of_x(x);
  return local_->locate_least_reserve(x.begin());
}

void CellKernels::multiplier_at_nodes(const Vector& lambda, unsigned int cell, std::span<double> values) const {
  local_->multiplier_at_nodes(lambda.begin(), cell, values);
}

double CellKernels::bulk(double lambda, const Vector& g, Vector& b) const {
  require_constraint();
  return local_->bulk(lambda, g.begin(), b.begin());
}

void CellKernels::multiplier_at_points(const Vector& lambda, unsigned int cell, std::span<double> values) const {
  local_->multiplier_at_points(lambda.begin(), cell, values);
}

void CellKernels::constraint_rows(const Vector& x, const UseRows& use) const {
  require_constraint();
  const GhostValues of_x(x);
  local_->constraint_rows(x.begin(), use);
}

void CellKernels::pressure_basis_at_nodes(const UseRows& use) const { local_->pressure_basis_at_nodes(use); }

void CellKernels::require_constraint() const {
  if (degree_ < 2) throw std::invalid_argument("the constraint needs displacements of degree 2 or more");
}

LocalCells local_cells(const BallSpace& space) {
  return {space.reference_cell(), space.cells(), space.reference_positions().begin()};
}

std::unique_ptr<CellKernels> make_cell_kernels(const BallSpace& space, const StoredEnergy& stored) {
  return std::make_unique<CellKernels>(
      space, chosen_kernels().table->make_local_kernels(space.degree(), local_cells(space), stored));
}

}  // namespace pseudorigid::continuum
