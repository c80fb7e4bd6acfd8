#pragma once
/// Entries of distributed vectors that other ranks own. A single rank has none, and the functions return at once.

#include "continuum/parallel/types.h"

namespace pseudorigid::continuum {

/// While this object lives, the ghost entries of x are those of their owners; afterwards x can be written again, if it
/// could before.
class GhostValues {
 public:
  explicit GhostValues(const Vector& x)
      : x_(x),
        several_ranks_(x.get_partitioner()->n_mpi_processes() > 1),
        clear_(several_ranks_ && !x.has_ghost_elements()) {
    if (several_ranks_) x_.update_ghost_values();
  }
  ~GhostValues() {
    if (clear_) x_.zero_out_ghost_values();
  }
  GhostValues(const GhostValues&) = delete;
  GhostValues& operator=(const GhostValues&) = delete;

 private:
  const Vector& x_;
  bool several_ranks_, clear_;
};

/// Adds the values of ghost entries to their owners' entries.
inline void add_to_owners(Vector& f) {
  if (f.get_partitioner()->n_mpi_processes() > 1) f.compress(dealii::VectorOperation::add);
}

}  // namespace pseudorigid::continuum
