#pragma once
/// The processes of a run. `pseudorigid` is one process; `pseudorigid-continuum` started by mpirun is several, which
/// compute together: the first reads, writes and speaks for all.

namespace pseudorigid::app {

/// One process. Collective functions are called by all ranks in the same order.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }
  /// Whether it is true on any rank. Collective.
  virtual bool any(bool mine) const { return mine; }
  /// What it is on the first rank. Collective.
  virtual bool of_first(bool mine) const { return mine; }

  bool is_first() const { return rank() == 0; }
};

/// For runs of one process.
inline const Ranks& one_rank() {
  static const Ranks ranks;
  return ranks;
}

}  // namespace pseudorigid::app
