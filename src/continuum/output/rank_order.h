#pragma once
/// An order of the entries of distributed vectors that does not depend on the number of ranks. Cells are ordered by
/// their place in the hierarchy of the mesh, and nodes by the first of their cells. Checkpoints have this order, so
/// that a run with any number of ranks can read them.

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

class RankOrder {
 public:
  /// The constructor, `collect_field` and `collect_multiplier` are collective. They throw std::length_error in the
  /// cases of gather.h.
  explicit RankOrder(const BallSpace& space);

  /// Collects the whole vector on rank 0 in the order of this class, from the own entries of all ranks. The result is
  /// empty on other ranks.
  std::vector<double> collect_field(std::span<const double> own) const { return collect(own, fields_); }
  std::vector<double> collect_multiplier(std::span<const double> own) const { return collect(own, multipliers_); }
  /// Copies the entries of this rank to `own` from the whole vector, which every rank must have. Throws
  /// std::invalid_argument if the size of `whole` is wrong.
  void take_field(std::span<const double> whole, std::span<double> own) const { take(whole, own, fields_); }
  void take_multiplier(std::span<const double> whole, std::span<double> own) const { take(whole, own, multipliers_); }

  /// The same functions for a position, including its internal metrics, which follow the coordinates cell by cell.
  /// `position_size` is the number of entries of the list that collect_position returns on rank 0. `take_position`
  /// throws std::invalid_argument if the size of `whole` is wrong. Before `take_position`, x must have metrics of the
  /// final size. All three functions are collective.
  std::vector<double> collect_position(const Vector& x) const;
  void take_position(std::span<const double> whole, Vector& x) const;
  std::size_t position_size(const Vector& x) const { return fields_.n_entries + order_of_metrics(x).n_entries; }

  std::size_t field_size() const { return fields_.n_entries; }
  std::size_t multiplier_size() const { return multipliers_.n_entries; }

 private:
  struct Order {
    std::size_t n_entries = 0, block = 1;  ///< numbers of entries of the whole vector and of a block: one node or cell
    std::vector<std::size_t> own;          ///< place of each block of this rank in the whole vector
    std::vector<std::vector<std::size_t>> of_ranks;  ///< the lists `own` of all ranks, on rank 0
  };
  Order order_of_metrics(const Vector& x) const;
  Order make_order(const std::vector<std::size_t>& keys, std::size_t block) const;
  std::vector<double> collect(std::span<const double> own, const Order& order) const;
  void take(std::span<const double> whole, std::span<double> own, const Order& order) const;

  MPI_Comm communicator_;
  Order fields_, multipliers_;
};

/// The layout of the memory of an integration method: the kind and the local size of each part. The function
/// `visit_memory` of the method calls this object with each part. Numbers are equal on all ranks, and vectors are
/// distributed over the ranks.
class MemoryLayout {
 public:
  explicit MemoryLayout(const RankOrder& order) : order_(&order) {}

  void operator()(std::span<double> values) { parts_.push_back({Kind::numbers, values.size()}); }
  void operator()(Vector& x) {
    parts_.push_back({x.size() == order_->field_size() ? Kind::field : Kind::multiplier, x.locally_owned_size()});
  }
  /// Adds a part that is a number, or a value without entries such as the multiplier of a ball without constraint.
  template <class Value>
  void operator()(Value& value) {
    if constexpr (std::is_arithmetic_v<Value>)
      parts_.push_back({Kind::numbers, 1});
    else
      parts_.push_back({Kind::numbers, mechanics::local_values(value).size()});
  }

  /// Returns the memory of all ranks as one list on rank 0, from the own part of each rank. On other ranks the result
  /// contains only the numbers. Collective.
  std::vector<double> collect(std::span<const double> own) const;
  /// Inverse of `collect`: returns the part of this rank from the whole list, which every rank must have. Throws
  /// std::invalid_argument if the size of `whole` is wrong.
  std::vector<double> take(std::span<const double> whole) const;

 private:
  enum class Kind { numbers, field, multiplier };
  struct Part {
    Kind kind;
    std::size_t n_own;
  };
  const RankOrder* order_;
  std::vector<Part> parts_;
};

}  // namespace pseudorigid::continuum
