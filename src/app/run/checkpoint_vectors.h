#pragma once
/// Transfer of the positions q, the velocities v and the method's memory between a run and its checkpoint. A checkpoint
/// contains the complete vectors, in an order that does not depend on the number of ranks. If a model distributes its
/// vectors, each rank has only a part of their entries.

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

/// True if the vectors of the model are distributed over the ranks. Only such a model has the function rank_order().
template <class Model>
inline constexpr bool is_distributed = requires(const Model& model) {
  model.rank_order();
};

/// Copies the memory that a method carries from step to step into the workspace of the method. Does nothing if `memory`
/// is empty. Throws std::invalid_argument if the memory belongs to another method.
template <class Workspace>
void give_memory(Workspace& workspace, std::span<const double> memory) {
  if (!memory.empty() && !mechanics::restore_memory(workspace, memory))
    throw std::invalid_argument("memory of another method");
}

/// Transfer for a model whose vectors are complete on one process. The functions are those of the transfer for
/// distributed vectors below.
template <class Model>
class CheckpointVectors {
  using State = typename Model::State;

 public:
  explicit CheckpointVectors(const Model&) {}

  /// Reads t, q and v into `state`, and all other data into `snapshot`. The names of the entries begin with `prefix`.
  /// Throws UserError if an entry is missing or has the wrong size.
  void take(const io::Checkpoint& file, State& state, Snapshot& snapshot, const std::string& prefix = "") {
    from_checkpoint(file, snapshot, prefix);
    state.t = snapshot.t;
    const auto copy = [&](const char* name, std::span<double> own) {
      std::ranges::copy(file.get_doubles(prefix + name, own.size()), own.begin());
    };
    copy("q", mechanics::local_values(state.q));
    copy("v", mechanics::local_values(state.v));
    snapshot.memory = file.get_doubles(prefix + "memory");
  }
  /// Copies the memory of the snapshot into the workspace of its method. Throws std::invalid_argument if the memory
  /// belongs to another method.
  template <class Workspace>
  void restore_memory(Workspace& workspace, Snapshot& snapshot) {
    give_memory(workspace, snapshot.memory);
  }
  void take_own_memory(Snapshot&) const {}  ///< does nothing: the memory is already that of this process
  /// Returns copies of q and v, and the memory of the snapshot.
  SavedVectors collect(State& state, const Snapshot& snapshot) const {
    const auto q = mechanics::local_values(state.q), v = mechanics::local_values(state.v);
    return {{q.begin(), q.end()}, {v.begin(), v.end()}, snapshot.memory};
  }
};

/// Transfer for a model whose vectors are distributed over the ranks.
template <class Model>
requires is_distributed<Model>
class CheckpointVectors<Model> {
  using State = typename Model::State;

 public:
  explicit CheckpointVectors(const Model& model) : order_(model.rank_order()) {}

  /// Reads the snapshot, q and v of this rank, and the memory of all ranks. The workspace of the method determines the
  /// part of the memory that belongs to this rank. This workspace is made later, so `restore_memory` selects the part.
  /// Throws UserError if an entry is missing or has the wrong size.
  void take(const io::Checkpoint& file, State& state, Snapshot& snapshot, const std::string& prefix = "") {
    from_checkpoint(file, snapshot, prefix);
    state.t = snapshot.t;
    order_.take_position(file.get_doubles(prefix + "q", order_.position_size(state.q)), state.q);
    order_.take_field(file.get_doubles(prefix + "v", order_.field_size()), mechanics::local_values(state.v));
    snapshot.memory = file.get_doubles(prefix + "memory");
    memory_is_whole_ = true;
  }
  /// Copies the memory of this rank into the workspace of its method. If the snapshot has the memory of all ranks,
  /// selects the part of this rank first. Throws std::invalid_argument if the memory belongs to another method.
  template <class Workspace>
  void restore_memory(Workspace& workspace, Snapshot& snapshot) {
    layout_.emplace(order_);
    workspace.visit_memory(*layout_);
    if (std::exchange(memory_is_whole_, false)) take_own_memory(snapshot);
    give_memory(workspace, snapshot.memory);
  }
  /// Replaces the memory of all ranks by that of this rank. Requires an earlier call of `restore_memory`.
  void take_own_memory(Snapshot& snapshot) const {
    if (!snapshot.memory.empty()) snapshot.memory = layout_->take(snapshot.memory);
  }
  /// Returns the complete vectors on the first rank, which writes the checkpoint. On the other ranks they are empty.
  /// Collective: all ranks must call this function.
  SavedVectors collect(State& state, const Snapshot& snapshot) const {
    return {order_.collect_position(state.q), order_.collect_field(mechanics::local_values(state.v)),
            snapshot.memory.empty() ? std::vector<double>() : layout_->collect(snapshot.memory)};
  }

 private:
  decltype(std::declval<const Model&>().rank_order()) order_;
  std::optional<typename Model::MemoryLayout> layout_;  ///< distribution of the method's memory over the ranks
  bool memory_is_whole_ = false;                        ///< true if the snapshot contains the memory of all ranks
};

}  // namespace pseudorigid::app
