#include "continuum/output/rank_order.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "continuum/parallel/gather.h"

namespace pseudorigid::continuum {
namespace {

constexpr std::size_t not_seen = std::numeric_limits<std::size_t>::max();

}  // namespace

RankOrder::RankOrder(const BallSpace& space) : communicator_(space.communicator()) {
  const auto& dofs = space.dof_handler();
  const auto& own_nodes = dofs.locally_owned_dofs();
  const std::size_t nodes_per_cell = space.nodes_per_cell();
  std::vector<std::size_t> node_keys(space.n_nodes(), not_seen), cell_keys;
  std::vector<dealii::types::global_dof_index> nodes(nodes_per_cell);
  // The first cell of a node of this rank may belong to another rank, so the loop includes ghost cells.
  for (const auto& cell : dofs.active_cell_iterators()) {
    if (cell->is_artificial()) continue;
    const std::size_t number = space.mesh().global_number(cell);
    if (cell->is_locally_owned()) cell_keys.push_back(number);
    cell->get_dof_indices(nodes);
    for (std::size_t i = 0; i < nodes_per_cell; ++i)
      if (own_nodes.is_element(nodes[i])) {
        std::size_t& key = node_keys[own_nodes.index_within_set(nodes[i])];
        key = std::min(key, number * nodes_per_cell + i);
      }
  }
  // The additional nodes come after all nodes of the mesh, as in vectors.
  node_keys.resize(node_keys.size() + space.n_additional(), not_seen);
  fields_ = make_order(node_keys, 3);
  multipliers_ = make_order(cell_keys, space.n_pressure());
}

RankOrder::Order RankOrder::make_order(const std::vector<std::size_t>& keys, std::size_t block) const {
  Order order;
  order.block = block;
  const auto keys_of_ranks = gather(communicator_, keys);
  std::vector<std::pair<std::size_t, std::pair<std::size_t, std::size_t>>> sorted;  // key, (rank, number on this rank)
  for (std::size_t rank = 0; rank < keys_of_ranks.size(); ++rank)
    for (std::size_t i = 0; i < keys_of_ranks[rank].size(); ++i) sorted.push_back({keys_of_ranks[rank][i], {rank, i}});
  std::sort(sorted.begin(), sorted.end());
  order.of_ranks.resize(keys_of_ranks.size());
  for (std::size_t rank = 0; rank < keys_of_ranks.size(); ++rank)
    order.of_ranks[rank].resize(keys_of_ranks[rank].size());
  for (std::size_t place = 0; place < sorted.size(); ++place)
    order.of_ranks[sorted[place].second.first][sorted[place].second.second] = place;
  order.own = scatter(communicator_, order.of_ranks);
  order.n_entries = block * dealii::Utilities::MPI::sum(keys.size(), communicator_);
  return order;
}

/// Returns the order of the internal metrics of x. All metrics of a cell form a block, and the blocks have the order of
/// the cells. Collective.
RankOrder::Order RankOrder::order_of_metrics(const Vector& x) const {
  Order order = multipliers_;
  const std::size_t n_own_cells = order.own.size(), n_cells = multipliers_.n_entries / multipliers_.block;
  order.block = dealii::Utilities::MPI::max(n_own_cells > 0 ? x.metrics.size() / n_own_cells : 0, communicator_);
  order.n_entries = order.block * n_cells;
  return order;
}

std::vector<double> RankOrder::collect_position(const Vector& x) const {
  std::vector<double> whole = collect_field({x.begin(), x.locally_owned_size()});
  const std::vector<double> metrics = collect(x.metrics, order_of_metrics(x));
  whole.insert(whole.end(), metrics.begin(), metrics.end());
  return whole;
}

void RankOrder::take_position(std::span<const double> whole, Vector& x) const {
  const Order order = order_of_metrics(x);
  if (whole.size() != fields_.n_entries + order.n_entries)
    throw std::invalid_argument("a saved vector has another size");
  take_field(whole.first(fields_.n_entries), {x.begin(), x.locally_owned_size()});
  take(whole.subspan(fields_.n_entries), x.metrics, order);
}

std::vector<double> RankOrder::collect(std::span<const double> own, const Order& order) const {
  if (order.n_entries == 0) return {};
  const auto of_ranks = gather(communicator_, std::vector<double>(own.begin(), own.end()));
  std::vector<double> whole(of_ranks.empty() ? 0 : order.n_entries);
  for (std::size_t rank = 0; rank < of_ranks.size(); ++rank)
    for (std::size_t i = 0; i < order.of_ranks[rank].size(); ++i)
      std::copy_n(&of_ranks[rank][order.block * i], order.block, &whole[order.block * order.of_ranks[rank][i]]);
  return whole;
}

void RankOrder::take(std::span<const double> whole, std::span<double> own, const Order& order) const {
  if (whole.size() != order.n_entries) throw std::invalid_argument("a saved vector has another size");
  if (order.n_entries == 0) return;
  for (std::size_t i = 0; i < order.own.size(); ++i)
    std::copy_n(&whole[order.block * order.own[i]], order.block, &own[order.block * i]);
}

std::vector<double> MemoryLayout::collect(std::span<const double> own) const {
  std::vector<double> whole;
  for (const Part& part : parts_) {
    const auto values = own.first(part.n_own);
    own = own.subspan(part.n_own);
    const std::vector<double> collected = part.kind == Kind::field ? order_->collect_field(values)
                                          : part.kind == Kind::multiplier
                                              ? order_->collect_multiplier(values)
                                              : std::vector<double>(values.begin(), values.end());
    whole.insert(whole.end(), collected.begin(), collected.end());
  }
  return whole;
}

std::vector<double> MemoryLayout::take(std::span<const double> whole) const {
  std::vector<double> own;
  for (const Part& part : parts_) {
    const std::size_t n = part.kind == Kind::field        ? order_->field_size()
                          : part.kind == Kind::multiplier ? order_->multiplier_size()
                                                          : part.n_own;
    if (whole.size() < n) throw std::invalid_argument("a saved memory has another size");
    const auto values = whole.first(n);
    whole = whole.subspan(n);
    const std::size_t begin = own.size();
    own.resize(begin + part.n_own);
    const std::span<double> place = std::span<double>(own).subspan(begin);
    if (part.kind == Kind::field)
      order_->take_field(values, place);
    else if (part.kind == Kind::multiplier)
      order_->take_multiplier(values, place);
    else
      std::copy(values.begin(), values.end(), place.begin());
  }
  if (!whole.empty()) throw std::invalid_argument("a saved memory has another size");
  return own;
}

}  // namespace pseudorigid::continuum
