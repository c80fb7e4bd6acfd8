#include "continuum/mesh/ball_space.h"

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_tools.h>

#include <stdexcept>

#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {
namespace {

/// Returns the indices in vectors of the 3 components of every node in `nodes`. `n_nodes` is the number of nodes on all
/// ranks, including the additional nodes.
dealii::IndexSet components_of(const dealii::IndexSet& nodes, unsigned int n_nodes) {
  dealii::IndexSet result(3 * n_nodes);
  for (auto interval = nodes.begin_intervals(); interval != nodes.end_intervals(); ++interval)
    result.add_range(3 * *interval->begin(), 3 * (interval->last() + 1));
  result.compress();
  return result;
}

/// Derivative with respect to ξ_d of nodal values, at node (i[0], i[1], i[2]) of a cell. The function `value` returns
/// the value at a node of the cell.
template <class Value>
double derivative(const ReferenceCell& ref, const Value& value, const std::array<int, 3>& i, int d) {
  double sum = 0;
  auto j = i;
  for (j[d] = 0; j[d] < ref.n; ++j[d])
    sum += ref.differentiate_at_nodes[i[d] * ref.n + j[d]] * value((j[2] * ref.n + j[1]) * ref.n + j[0]);
  return sum;
}

}  // namespace

BallSpace::BallSpace(BallMesh mesh, int degree, unsigned int n_accounts, unsigned int n_companions)
    : mesh_(std::move(mesh)),
      degree_(degree),
      reference_(degree),
      element_(degree),
      n_accounts_(n_accounts),
      n_companions_(n_companions) {
  number_nodes();
  number_multipliers();
  place_nodes();
  lump_mass();
}

void BallSpace::number_nodes() {
  dof_handler_ = std::make_unique<dealii::DoFHandler<3>>(mesh_.triangulation());
  dof_handler_->distribute_dofs(element_);
  const dealii::IndexSet on_own_cells = dealii::DoFTools::extract_locally_active_dofs(*dof_handler_);
  const unsigned int n_mesh = n_global_nodes(), n_all = n_mesh + n_account_nodes() + n_companions_;
  dealii::IndexSet own = components_of(dof_handler_->locally_owned_dofs(), n_all);
  if (dof_handler_->locally_owned_dofs().is_element(n_mesh - 1) && n_all > n_mesh) {
    const auto first = static_cast<unsigned int>(own.n_elements());
    if (n_accounts_ > 0) account_ = first;
    if (n_companions_ > 0) companions_ = first + 3 * n_account_nodes();
    own.add_range(3 * n_mesh, 3 * n_all);
  }
  partitioner_ =
      std::make_shared<dealii::Utilities::MPI::Partitioner>(own, components_of(on_own_cells, n_all), communicator());

  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<3>(degree_);
  std::vector<dealii::types::global_dof_index> indices(element_.dofs_per_cell);
  for (const auto& cell : dof_handler_->active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell->get_dof_indices(indices);
    auto& nodes = cell_nodes_.emplace_back(indices.size());
    for (unsigned int i = 0; i < indices.size(); ++i)
      nodes[i] = partitioner_->global_to_local(3 * indices[hierarchic[i]]) / 3;
  }
}

std::vector<std::size_t> BallSpace::cell_numbers() const {
  std::vector<std::size_t> numbers;
  for (const auto& cell : mesh_.triangulation().active_cell_iterators())
    if (cell->is_locally_owned()) numbers.push_back(mesh_.global_number(cell));
  return numbers;
}

void BallSpace::number_multipliers() {
  const dealii::types::global_dof_index n_own = static_cast<std::size_t>(n_cells()) * n_pressure();
  const dealii::IndexSet own = n_ranks(communicator()) == 1 ? dealii::complete_index_set(n_own)
                                                            : dealii::Utilities::MPI::create_ascending_partitioning(
                                                                  communicator(), n_own)[this_rank(communicator())];
  multiplier_partitioner_ = std::make_shared<dealii::Utilities::MPI::Partitioner>(own, communicator());
}

void BallSpace::place_nodes() {
  X_.reinit(partitioner_);
  std::vector<bool> placed((partitioner_->locally_owned_size() + partitioner_->n_ghost_indices()) / 3, false);
  const int n = reference_.n;
  unsigned int c = 0;
  for (const auto& cell : mesh_.triangulation().active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    for (int i = 0; i < n * n * n; ++i) {
      const dealii::Point<3> xi(reference_.nodes[i % n], reference_.nodes[i / n % n], reference_.nodes[i / n / n]);
      const dealii::Point<3> X = mesh_.position(cell, xi);
      const unsigned int node = cell_nodes_[c][i];
      for (unsigned int d = 0; d < 3; ++d) {
        double& entry = X_.local_element(3 * node + d);
        if (placed[node] && std::abs(entry - X[d]) > 1e-13)
          throw std::logic_error("neighbouring cells place a shared node differently");
        if (!placed[node]) entry = X[d];
      }
      placed[node] = true;
    }
    ++c;
  }
  X_.update_ghost_values();
}

void BallSpace::clear_fixed(Vector& f) const {
  const double* inverse_mass = inverse_mass_.begin();
  double* values = f.begin();
  for (std::size_t i = 0, n = f.locally_owned_size(); i < n; ++i)
    if (inverse_mass[i] == 0) values[i] = 0;
}

void BallSpace::lump_mass() {
  mass_.reinit(partitioner_);
  const int n = reference_.n;
  for (const auto& nodes : cell_nodes_)
    for (int i = 0; i < n * n * n; ++i) {
      const std::array<int, 3> ijk{i % n, i / n % n, i / n / n};
      dealii::Tensor<2, 3> jacobian;
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          jacobian[c][d] = derivative(
              reference_, [&](int node) { return X_.local_element(3 * nodes[node] + c); }, ijk, d);
      const double weight =
          reference_.node_weights[ijk[0]] * reference_.node_weights[ijk[1]] * reference_.node_weights[ijk[2]];
      for (int c = 0; c < 3; ++c) mass_.local_element(3 * nodes[i] + c) += weight * determinant(jacobian);
    }
  mass_.compress(dealii::VectorOperation::add);
  inverse_mass_.reinit(partitioner_);
  for (unsigned int i = 0; i < inverse_mass_.locally_owned_size(); ++i) {
    const bool held = mesh_.sector().reflect[i % 3] && X_.local_element(i) == 0;
    const bool has_mass = mass_.local_element(i) > 0;
    inverse_mass_.local_element(i) = held || !has_mass ? 0 : 1 / mass_.local_element(i);
  }
  if (account_)
    for (unsigned int c = 0; c < n_accounts_; ++c) inverse_mass_.local_element(*account_ + c) = 1;
  if (companions_)
    for (unsigned int c = 0; c < 3 * n_companions_; ++c) inverse_mass_.local_element(*companions_ + c) = 1;
  inverse_mass_.update_ghost_values();
}

}  // namespace pseudorigid::continuum
