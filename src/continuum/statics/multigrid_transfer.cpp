#include "continuum/statics/multigrid_transfer.h"

#include <unordered_map>

#include "continuum/mesh/tensor_product.h"
#include "continuum/parallel/ghost_values.h"

namespace pseudorigid::continuum {
namespace {

/// The Lagrange polynomials on `nodes` at `points`: (point, node).
Eigen::MatrixXd lagrange_table(const std::vector<double>& nodes, const std::vector<double>& points) {
  Eigen::MatrixXd table(points.size(), nodes.size());
  for (std::size_t q = 0; q < points.size(); ++q)
    for (std::size_t i = 0; i < nodes.size(); ++i)
      table(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(i)) = lagrange(nodes, i, points[q]);
  return table;
}

/// The quadrature weights of the reference cell.
Eigen::VectorXd unit_weights(const ReferenceCell& ref) {
  Eigen::VectorXd w(ref.n * ref.n * ref.n);
  for (int q = 0; q < w.size(); ++q) w[q] = ref.weight_of_point(q);
  return w;
}

}  // namespace

MultigridTransfer::MultigridTransfer(const BallSpace& finer, const BallSpace& coarser)
    : finer_(finer),
      coarser_(coarser),
      halves_(finer.n_global_cells() > coarser.n_global_cells()),
      gathers_(n_ranks(finer.communicator()) > n_ranks(coarser.communicator())) {
  Vector n_cells_of_node = finer.make_vector();
  for (const auto& nodes : finer.cells())
    for (const unsigned int node : nodes) ++n_cells_of_node.local_element(3 * node);
  add_to_owners(n_cells_of_node);
  const GhostValues of_all(n_cells_of_node);
  const auto partitioner = n_cells_of_node.get_partitioner();
  for (unsigned int i = 0; i < partitioner->locally_owned_size() + partitioner->n_ghost_indices(); i += 3)
    share_.push_back(1 / n_cells_of_node.local_element(i));

  std::unordered_map<std::size_t, unsigned int> cell_of_number;
  for (const std::size_t number : coarser.cell_numbers())
    cell_of_number.emplace(number, static_cast<unsigned int>(cell_of_number.size()));
  for (const std::size_t number : finer.cell_numbers()) {
    const std::size_t child = halves_ ? number % 8 : 0;
    parts_.push_back({cell_of_number.at(halves_ ? number / 8 : number), {child % 2, child / 2 % 2, child / 4}});
  }

  for (std::size_t b = 0; b < 2; ++b) {
    std::vector<double> nodes = finer.reference_cell().nodes;
    if (halves_)
      for (double& xi : nodes) xi = (static_cast<double>(b) + xi) / 2;
    interpolation_[b] = lagrange_table(coarser.reference_cell().nodes, nodes);
  }
}

void MultigridTransfer::complete_sums(Vector& f) const {
  if (gathers_)
    add_over_ranks({f.begin(), f.locally_owned_size()}, finer_.communicator());
  else
    add_to_owners(f);
}

void MultigridTransfer::restrict_to_coarser(const Vector& r, Vector& f) const {
  const std::array<Eigen::MatrixXd, 2> table{interpolation_[0].transpose(), interpolation_[1].transpose()};
  Eigen::VectorXd fine(finer_.nodes_per_cell());
  const GhostValues of_r(r);
  f = 0.0;
  for (unsigned int cell = 0; cell < finer_.n_cells(); ++cell) {
    const auto& [parent, b] = parts_[cell];
    const auto &nodes = finer_.cell_nodes(cell), &to = coarser_.cell_nodes(parent);
    for (unsigned int k = 0; k < 3; ++k) {
      for (std::size_t a = 0; a < nodes.size(); ++a)
        fine[static_cast<Eigen::Index>(a)] = share_[nodes[a]] * r.local_element(3 * nodes[a] + k);
      const Eigen::VectorXd coarse = tensor_product(table[b[0]], table[b[1]], table[b[2]], fine);
      for (std::size_t a = 0; a < to.size(); ++a)
        f.local_element(3 * to[a] + k) += coarse[static_cast<Eigen::Index>(a)];
    }
  }
  complete_sums(f);
  coarser_.clear_fixed(f);
}

void MultigridTransfer::add_interpolated(const Vector& u, Vector& result) const {
  Eigen::VectorXd coarse(coarser_.nodes_per_cell());
  const GhostValues of_u(u);
  for (unsigned int cell = 0; cell < finer_.n_cells(); ++cell) {
    const auto& [parent, b] = parts_[cell];
    const auto &nodes = finer_.cell_nodes(cell), &from = coarser_.cell_nodes(parent);
    for (unsigned int k = 0; k < 3; ++k) {
      for (std::size_t a = 0; a < from.size(); ++a)
        coarse[static_cast<Eigen::Index>(a)] = u.local_element(3 * from[a] + k);
      const Eigen::VectorXd fine =
          tensor_product(interpolation_[b[0]], interpolation_[b[1]], interpolation_[b[2]], coarse);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        result.local_element(3 * nodes[a] + k) += share_[nodes[a]] * fine[static_cast<Eigen::Index>(a)];
    }
  }
  add_to_owners(result);
}

MultigridTransfer::Evaluation MultigridTransfer::evaluation(const std::vector<double>& nodes,
                                                            const std::vector<double>& points) const {
  Evaluation at;
  for (const double xi : points) at.half.push_back(halves_ && xi > 0.5 ? 1 : 0);
  for (std::size_t b = 0; b < 2; ++b) {
    std::vector<double> of_finer = points;
    if (halves_)
      for (double& xi : of_finer) xi = 2 * xi - static_cast<double>(b);
    at.table[b] = lagrange_table(nodes, of_finer);
  }
  return at;
}

template <class Use>
void MultigridTransfer::evaluate(const Evaluation& at, const Part& part, const Eigen::VectorXd& of_finer,
                                 const Use& use) {
  const auto& b = part.b;
  const Eigen::VectorXd values = tensor_product(at.table[b[0]], at.table[b[1]], at.table[b[2]], of_finer);
  const std::size_t n = at.half.size();
  for (std::size_t q = 0; q < n * n * n; ++q)
    if (at.half[q % n] == b[0] && at.half[q / n % n] == b[1] && at.half[q / n / n] == b[2])
      use(q, values[static_cast<Eigen::Index>(q)]);
}

Vector MultigridTransfer::at_coarser_nodes(const Vector& x) const {
  const Evaluation at = evaluation(finer_.reference_cell().nodes, coarser_.reference_cell().nodes);
  Vector result = coarser_.make_vector(), n_values = result;
  Eigen::VectorXd fine(finer_.nodes_per_cell());
  const GhostValues of_x(x);
  for (unsigned int cell = 0; cell < finer_.n_cells(); ++cell) {
    const auto &nodes = finer_.cell_nodes(cell), &to = coarser_.cell_nodes(parts_[cell].cell);
    for (unsigned int k = 0; k < 3; ++k) {
      for (std::size_t a = 0; a < nodes.size(); ++a)
        fine[static_cast<Eigen::Index>(a)] = x.local_element(3 * nodes[a] + k);
      evaluate(at, parts_[cell], fine, [&](std::size_t node, double value) {
        result.local_element(3 * to[node] + k) = value;
        n_values.local_element(3 * to[node] + k) = 1;
      });
    }
  }
  complete_sums(result);
  complete_sums(n_values);
  for (std::size_t i = 0; i < result.locally_owned_size(); ++i) result.begin()[i] /= n_values.begin()[i];
  return result;
}

StiffnessCoefficients MultigridTransfer::at_coarser_points(const StiffnessCoefficients& c) const {
  const ReferenceCell &from = finer_.reference_cell(), &to = coarser_.reference_cell();
  const Evaluation at = evaluation(from.points, to.points);
  // In cells that are twice as large, det(∂X/∂ξ) is eight times as large, and ∂ξ/∂X half as large.
  const Eigen::VectorXd weights = (halves_ ? 2.0 : 1.0) * unit_weights(to),
                        inverse_weights = unit_weights(from).cwiseInverse();
  StiffnessCoefficients result(coarser_.n_cells(),
                               PointCoefficients::Zero(weights.size(), StiffnessTangent::n_entries));
  for (std::size_t cell = 0; cell < c.size(); ++cell) {
    PointCoefficients& of_coarser = result[parts_[cell].cell];
    for (Eigen::Index k = 0; k < of_coarser.cols(); ++k)
      evaluate(at, parts_[cell], c[cell].col(k).cwiseProduct(inverse_weights), [&](std::size_t point, double value) {
        const auto q = static_cast<Eigen::Index>(point);
        of_coarser(q, k) = weights[q] * value;
      });
  }
  if (gathers_)
    for (PointCoefficients& of_cell : result)
      add_over_ranks({of_cell.data(), static_cast<std::size_t>(of_cell.size())}, finer_.communicator());
  return result;
}

}  // namespace pseudorigid::continuum
