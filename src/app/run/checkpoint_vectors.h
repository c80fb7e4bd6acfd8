#pragma once
/// The vectors of a model's run on their way to a checkpoint and back: q, v and the method's memory. A checkpoint holds
/// whole vectors in an order that does not depend on the ranks; a rank holds its own entries.

#include <algorithm>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "app/run/model_checkpoint.h"
#include "io/checkpoint.h"
#include "mechanics/core/memory.h"

namespace pseudorigid::app {

template <class Model>
inline constexpr bool is_distributed = requires(const Model& model) {
  model.rank_order();
};

/// Gives a method the memory that it carried from step to step; std::invalid_argument if the memory is that of
/// another method.
template <class Workspace>
void give_memory(Workspace& workspace, std::span<const double> memory) {
  if (!memory.empty() && !mechanics::restore_memory(workspace, memory))
    throw std::invalid_argument("memory of another method");
}

/// For a model whose vectors are complete on one process.
template <class Model>
class CheckpointVectors {
  using State = typename Model::State;

 public:
  explicit CheckpointVectors(const Model&) {}

  void take(const io::Checkpoint& file, State& state, Snapshot& snapshot) {
    const auto copy = [&](const char* name, std::span<double> own) {
      std::ranges::copy(file.get_doubles(name, own.size()), own.begin());
    };
    copy("q", mechanics::local_values(state.q));
    copy("v", mechanics::local_values(state.v));
    snapshot.memory = file.get_doubles("memory");
  }
  template <class Workspace>
  void restore_memory(Workspace& workspace, Snapshot& snapshot) {
    give_memory(workspace, snapshot.memory);
  }
  SavedVectors collect(State& state, const Snapshot& snapshot) const {
    const auto q = mechanics::local_values(state.q), v = mechanics::local_values(state.v);
    return {{q.begin(), q.end()}, {v.begin(), v.end()}, snapshot.memory};
  }
};

/// For a model whose vectors are distributed over ranks.
template <class Model>
requires is_distributed<Model>
class CheckpointVectors<Model> {
  using State = typename Model::State;

 public:
  explicit CheckpointVectors(const Model& model) : order_(model.rank_order()) {}

  /// The memory remains undivided until the method has its workspace, which alone can divide it.
  void take(const io::Checkpoint& file, State& state, Snapshot& snapshot) {
    const auto take_own = [&](const char* name, std::span<double> own) {
      order_.take_field(file.get_doubles(name, order_.field_size()), own);
    };
    take_own("q", mechanics::local_values(state.q));
    take_own("v", mechanics::local_values(state.v));
    snapshot.memory = file.get_doubles("memory");
    memory_is_whole_ = true;
  }
  template <class Workspace>
  void restore_memory(Workspace& workspace, Snapshot& snapshot) {
    layout_.emplace(order_);
    workspace.visit_memory(*layout_);
    if (std::exchange(memory_is_whole_, false) && !snapshot.memory.empty())
      snapshot.memory = layout_->take(snapshot.memory);
    give_memory(workspace, snapshot.memory);
  }
  /// Collective. The list is whole on the rank that writes.
  SavedVectors collect(State& state, const Snapshot& snapshot) const {
    return {order_.collect_field(mechanics::local_values(state.q)),
            order_.collect_field(mechanics::local_values(state.v)),
            snapshot.memory.empty() ? std::vector<double>() : layout_->collect(snapshot.memory)};
  }

 private:
  decltype(std::declval<const Model&>().rank_order()) order_;
  std::optional<typename Model::MemoryLayout> layout_;  ///< of the method's memory
  bool memory_is_whole_ = false;                        ///< the snapshot's, as it stands in the checkpoint
};

}  // namespace pseudorigid::app
