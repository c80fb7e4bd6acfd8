#pragma once
/// The finite-element spaces of the ball. Positions x_h ∈ (Q_k)³ have Gauss–Lobatto nodes. The reference positions X
/// are interpolated at the same nodes, with the same degree k. The lumped (diagonal) mass is
///
///   m_n = Σ_cells ρ w_n det(∂X/∂ξ)(ξ_n),   ρ = 1 in internal units.
///
/// The sum runs over the cells that contain node n. ξ_n is the node in such a cell, and w_n is its Gauss–Lobatto
/// weight. On a symmetry plane x_i = 0, the component i of a node does not change. The corresponding entry of the
/// inverse mass is 0.
///
/// Cells, nodes and multipliers are distributed over the ranks of the mesh. `n_cells` and `cell_nodes` refer to the
/// cells of this rank. The local elements of a vector are the entries of the nodes that this rank owns, followed by
/// those of the ghost nodes of its cells.

#include <deal.II/base/partitioner.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "continuum/mesh/ball_mesh.h"
#include "continuum/mesh/reference_cell.h"
#include "continuum/parallel/types.h"

namespace pseudorigid::continuum {

class BallSpace {
 public:
  /// `degree` is k. The constructor is collective. After the nodes of the mesh, vectors have additional nodes, all on
  /// one rank. The coordinates of the first ⌈n_accounts/3⌉ additional nodes are `n_accounts` energies
  /// (body/ball_body.h). The other `n_companions` additional nodes are point masses (mechanics/core/orbit.h).
  BallSpace(BallMesh mesh, int degree, unsigned int n_accounts = 0, unsigned int n_companions = 0);

  const BallMesh& mesh() const { return mesh_; }
  int degree() const { return degree_; }
  const ReferenceCell& reference_cell() const { return reference_; }
  MPI_Comm communicator() const { return mesh_.communicator(); }
  unsigned int n_cells() const { return static_cast<unsigned int>(cell_nodes_.size()); }
  std::size_t n_global_cells() const { return mesh_.triangulation().n_global_active_cells(); }
  unsigned int nodes_per_cell() const { return static_cast<unsigned int>(reference_.n * reference_.n * reference_.n); }
  /// Number of nodes of the mesh that this rank owns.
  unsigned int n_nodes() const { return partitioner_->locally_owned_size() / 3 - n_additional(); }
  /// Number of additional nodes that this rank owns, which follow its nodes of the mesh. All additional nodes are on
  /// one rank. The number is 0 on the other ranks.
  unsigned int n_additional() const { return (account_ ? n_account_nodes() : 0) + (companions_ ? n_companions_ : 0); }
  /// Number of nodes of the mesh on all ranks, without the additional nodes.
  std::size_t n_global_nodes() const { return dof_handler_->n_dofs(); }
  /// Dimension of P_{k−1}, the space of the multiplier in one cell.
  unsigned int n_pressure() const { return degree_ * (degree_ + 1) * (degree_ + 2) / 6; }

  /// Local numbers of the nodes of a cell of this rank, with the first direction as the fastest index. Component c of a
  /// node has the local entry 3·node + c in vectors.
  const std::vector<unsigned int>& cell_nodes(unsigned int cell) const { return cell_nodes_[cell]; }
  const std::vector<std::vector<unsigned int>>& cells() const { return cell_nodes_; }
  /// The numbers of the cells of this rank among those of all ranks (BallMesh::global_number).
  std::vector<std::size_t> cell_numbers() const;
  /// Local entry in vectors of the entry 3·(node of the cell) + component of a cell.
  unsigned int entry_of(unsigned int cell, std::ptrdiff_t of_cell) const {
    return 3 * cell_nodes_[cell][static_cast<std::size_t>(of_cell / 3)] + static_cast<unsigned int>(of_cell % 3);
  }
  const Vector& reference_positions() const { return X_; }  ///< X with ghost nodes; 0 at additional nodes
  const Vector& mass() const { return mass_; }  ///< m_n at each component of own node n; 0 at additional nodes
  /// 1/m_n at each component of node n, or 0 if a symmetry plane fixes the component. At additional nodes the entry is
  /// 1 if the coordinate is used, and otherwise 0.
  const Vector& inverse_mass() const { return inverse_mass_; }
  /// Sets the entries of a nodal field to 0 if a symmetry plane fixes them, or if they belong to unused coordinates.
  void clear_fixed(Vector& f) const;
  const dealii::DoFHandler<3>& dof_handler() const { return *dof_handler_; }
  /// Local index of the coordinate whose velocity is the dissipated energy. The next index is that of the given energy,
  /// followed by an index for the energy that each branch dissipates. The inverse masses of these coordinates are 1.
  /// The result is empty if n_accounts is 0, and on ranks that do not own these coordinates.
  std::optional<unsigned int> account() const { return account_; }
  /// Local index of the first coordinate of the first companion. The other coordinates of the companions follow. The
  /// inverse masses of these coordinates are 1. The result is empty without companions, and on ranks that do not own
  /// these coordinates.
  std::optional<unsigned int> companions() const { return companions_; }
  Vector make_vector() const { return Vector(partitioner_); }
  Vector make_multiplier() const { return Vector(multiplier_partitioner_); }

 private:
  unsigned int n_account_nodes() const { return (n_accounts_ + 2) / 3; }
  void number_nodes();
  void number_multipliers();
  /// Sets X_ to the reference positions of the nodes. Throws std::logic_error if two cells of this rank place a shared
  /// node at positions that differ by more than 1e-13 in a component.
  void place_nodes();
  void lump_mass();

  BallMesh mesh_;
  int degree_;
  ReferenceCell reference_;
  dealii::FE_Q<3> element_;
  std::unique_ptr<dealii::DoFHandler<3>> dof_handler_;
  std::vector<std::vector<unsigned int>> cell_nodes_;
  unsigned int n_accounts_, n_companions_;
  std::optional<unsigned int> account_, companions_;
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner_, multiplier_partitioner_;
  Vector X_, mass_, inverse_mass_;
};

}  // namespace pseudorigid::continuum
