#pragma once
/// Interface to the processes of a run. If a launcher has started several processes, a scene without finite elements
/// runs on one of them only. A scene with finite elements runs on all processes. The first process then writes the
/// messages and the files, except for the pieces of pictures, which each process writes itself.

#include <string>

namespace pseudorigid::app {

/// The ranks of a run. This class describes a single process. A derived class overrides its functions for several
/// processes. All ranks must call the collective functions in the same order.
class Ranks {
 public:
  virtual ~Ranks() = default;
  /// The number of this process, from 0.
  virtual int rank() const { return 0; }
  /// The number of processes.
  virtual int size() const { return 1; }
  /// True if `mine` is true on any rank. Collective.
  virtual bool any(bool mine) const { return mine; }
  /// The first rank on which `mine` is true, or size() if there is no such rank. Collective.
  virtual int first_where(bool mine) const { return mine ? 0 : 1; }
  /// Returns the number `mine` of the given rank, on every rank. Collective.
  virtual int number_of(int /*rank*/, int mine) const { return mine; }
  /// Returns the text `mine` of the given rank, on every rank. Collective.
  virtual std::string text_of(int /*rank*/, std::string mine) const { return mine; }
  /// Aborts all ranks with this exit code. In a single process this function does nothing, so that the program ends as
  /// usual.
  virtual void abort(int /*exit_code*/) const {}

  /// Returns `mine` of the first rank, on every rank. Collective.
  bool of_first(bool mine) const { return number_of(0, mine) != 0; }
  bool is_first() const { return rank() == 0; }
};

/// The ranks of a run in a single process.
inline const Ranks& one_rank() {
  static const Ranks ranks;
  return ranks;
}

}  // namespace pseudorigid::app
