#pragma once
/// Transfer of the positions q, the velocities v and the method's memory between a run and its checkpoint. The memory
/// contains the numbers that a method stores from step to step (mechanics/core/memory.h). A checkpoint contains the
/// complete vectors, in an order that does not depend on the number of ranks. If a model distributes its vectors, each
/// rank has only a part of their entries.

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
/// Its result collects complete vectors on the first rank, and selects the entries of a rank from complete vectors.
template <class Model>
inline constexpr bool is_distributed = requires(const Model& model) {
  model.rank_order();
};

/// Sets the memory in the workspace of a method to `memory`. Does nothing if `memory` is empty. Throws
/// std::invalid_argument if the length of `memory` does not fit the method.
template <class Workspace>
void give_memory(Workspace& workspace, std::span<const double> memory) {
  if (!memory.empty() && !mechanics::restore_memory(workspace, memory))
    throw std::invalid_argument("memory of another method");
}

/// Transfer for a model that runs in one process, which has the complete vectors. The functions are those of the class
/// for distributed vectors below.
template <class Model>
class CheckpointVectors {
  using State = typename Model::State;

 public:
  explicit CheckpointVectors(const Model&) {}

  /// Reads t, q and v into `state`. Reads t, the position, the counters and the memory of the method into `snapshot`.
  /// In the checkpoint, the names of the entries begin with `prefix`. Throws UserError if an entry is missing or has
  /// the wrong size, or if the program lacks the method.
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
  /// Copies the memory of the snapshot into the workspace of its method. Throws std::invalid_argument if the length of
  /// the memory does not fit the method.
  template <class Workspace>
  void restore_memory(Workspace& workspace, Snapshot& snapshot) {
    give_memory(workspace, snapshot.memory);
  }
  void take_own_memory(Snapshot&) const {}  ///< does nothing, because one process has the whole memory
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

  /// Reads the snapshot, q and v of this rank, and the memory of all ranks. The part of the memory that belongs to this
  /// rank depends on the workspace of the method. The workspace is made later, so `restore_memory` selects the part.
  /// Throws UserError if an entry is missing or has the wrong size, or if the program lacks the method. Collective.
  void take(const io::Checkpoint& file, State& state, Snapshot& snapshot, const std::string& prefix = "") {
    from_checkpoint(file, snapshot, prefix);
    state.t = snapshot.t;
    order_.take_position(file.get_doubles(prefix + "q", order_.position_size(state.q)), state.q);
    order_.take_field(file.get_doubles(prefix + "v", order_.field_size()), mechanics::local_values(state.v));
    snapshot.memory = file.get_doubles(prefix + "memory");
    memory_is_whole_ = true;
  }
  /// Copies the memory of this rank into the workspace of its method. If the snapshot has the memory of all ranks,
  /// first replaces it by the part of this rank. Throws std::invalid_argument if the length of the memory does not fit
  /// the method.
  template <class Workspace>
  void restore_memory(Workspace& workspace, Snapshot& snapshot) {
    layout_.emplace(order_);
    workspace.visit_memory(*layout_);
    if (std::exchange(memory_is_whole_, false)) take_own_memory(snapshot);
    give_memory(workspace, snapshot.memory);
  }
  /// Replaces the memory of all ranks in the snapshot by the part of this rank. Requires an earlier call of
  /// `restore_memory`.
  void take_own_memory(Snapshot& snapshot) const {
    if (!snapshot.memory.empty()) snapshot.memory = layout_->take(snapshot.memory);
  }
  /// Returns complete copies of q, v and the memory on the first rank, which writes the checkpoint. On the other ranks
  /// they are not complete. If the snapshot has a memory, requires an earlier call of `restore_memory`. Collective.
  SavedVectors collect(State& state, const Snapshot& snapshot) const {
    return {order_.collect_position(state.q), order_.collect_field(mechanics::local_values(state.v)),
            snapshot.memory.empty() ? std::vector<double>() : layout_->collect(snapshot.memory)};
  }

 private:
  decltype(std::declval<const Model&>().rank_order()) order_;
  std::optional<typename Model::MemoryLayout> layout_;  ///< distribution of the memory over the ranks
  bool memory_is_whole_ = false;  ///< true if the snapshot of the last `take` has the memory of all ranks
};

}  // namespace pseudorigid::app
