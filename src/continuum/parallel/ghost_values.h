#pragma once
/// Ghost entries of distributed vectors: entries that other ranks own and that this rank reads. With one rank there are
/// no ghost entries, and the functions do nothing.

#include "continuum/parallel/types.h"

namespace pseudorigid::continuum {

/// While this object exists, the ghost entries of x have the values that their owners had at its construction. The
/// constructor is collective. If x had no ghost values before, the destructor sets the ghost entries to 0, so that x
/// can be changed again.
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

/// Adds the values of ghost entries to the entries of their owners, and sets the ghost entries to 0. Collective.
inline void add_to_owners(Vector& f) {
  if (f.get_partitioner()->n_mpi_processes() > 1) f.compress(dealii::VectorOperation::add);
}

}  // namespace pseudorigid::continuum
