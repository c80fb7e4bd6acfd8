#pragma once
/// The processes of a run. If a launcher has started several processes, only one of them runs a scene without finite
/// elements. With finite elements all compute together: the first writes and speaks for all.

#include <string>

namespace pseudorigid::app {

/// One process. Collective functions are called by all ranks in the same order.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const { return 0; }
  virtual int size() const { return 1; }
  /// Whether it is true on any rank. Collective.
  virtual bool any(bool mine) const { return mine; }
  /// The first rank on which it is true, size() if there is none. Collective.
  virtual int first_where(bool mine) const { return mine ? 0 : 1; }
  /// Broadcasts `mine` from `rank`. Collective.
  virtual int number_of(int /*rank*/, int mine) const { return mine; }
  virtual std::string text_of(int /*rank*/, std::string mine) const { return mine; }
  /// Ends all ranks at once. A single process returns and ends by itself.
  virtual void abort(int /*exit_code*/) const {}

  bool of_first(bool mine) const { return number_of(0, mine) != 0; }
  bool is_first() const { return rank() == 0; }
};

/// For runs of one process.
inline const Ranks& one_rank() {
  static const Ranks ranks;
  return ranks;
}

}  // namespace pseudorigid::app
