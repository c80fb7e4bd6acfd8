#pragma once
/// An order of the entries of distributed vectors that does not depend on the ranks: nodes by the first cell that has
/// them, cells by their place in the hierarchy of the mesh. Data saved in it can be read by any number of
/// ranks.

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "continuum/mesh/ball_space.h"

namespace pseudorigid::continuum {

class RankOrder {
 public:
  /// Collective, as `collect` is.
  explicit RankOrder(const BallSpace& space);

  /// The whole vector on rank 0 in this order, from every rank's own entries; empty on the others.
  std::vector<double> collect_field(std::span<const double> own) const { return collect(own, fields_); }
  std::vector<double> collect_multiplier(std::span<const double> own) const { return collect(own, multipliers_); }
  /// A rank's own entries out of the whole vector. std::invalid_argument if its size is another.
  void take_field(std::span<const double> whole, std::span<double> own) const { take(whole, own, fields_); }
  void take_multiplier(std::span<const double> whole, std::span<double> own) const { take(whole, own, multipliers_); }

  std::size_t field_size() const { return fields_.n_entries; }
  std::size_t multiplier_size() const { return multipliers_.n_entries; }

 private:
  struct Order {
    std::size_t n_entries = 0, block = 1;            ///< entries of the whole vector; entries that stay together
    std::vector<std::size_t> own;                    ///< place of each of the rank's own blocks in the whole
    std::vector<std::vector<std::size_t>> of_ranks;  ///< the lists of all ranks, on rank 0
  };
  Order make_order(const std::vector<std::size_t>& keys, std::size_t block) const;
  std::vector<double> collect(std::span<const double> own, const Order& order) const;
  void take(std::span<const double> whole, std::span<double> own, const Order& order) const;

  MPI_Comm communicator_;
  Order fields_, multipliers_;
};

/// Kinds of the parts of a method's memory, found by `visit_memory`: its numbers are the same on every rank, its
/// vectors are distributed.
class MemoryLayout {
 public:
  explicit MemoryLayout(const RankOrder& order) : order_(&order) {}

  void operator()(std::span<double> values) { parts_.push_back({Kind::numbers, values.size()}); }
  void operator()(Vector& x) {
    parts_.push_back({x.size() == order_->field_size() ? Kind::field : Kind::multiplier, x.locally_owned_size()});
  }
  /// A number, or an empty part: the multiplier of a ball without constraint.
  template <class Value>
  void operator()(Value& value) {
    if constexpr (std::is_arithmetic_v<Value>)
      parts_.push_back({Kind::numbers, 1});
    else
      parts_.push_back({Kind::numbers, mechanics::local_values(value).size()});
  }

  /// The memory of all ranks as one list on rank 0, from every rank's own. Collective.
  std::vector<double> collect(std::span<const double> own) const;
  /// Inverse of collect: this rank's part of the whole list. std::invalid_argument if the size does not fit.
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
