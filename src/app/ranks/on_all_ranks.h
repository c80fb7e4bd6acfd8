#pragma once
/// Functions that end all ranks if one rank fails. Otherwise the other ranks would wait for the failed one forever. An
/// exception may leave a collective operation only if every rank throws it. There are two cases:
///   - Work of one rank without the others, for example with files, can fail. `on_all_ranks` runs such work and then
///     throws FailureOnAllRanks on all ranks.
///   - Any other exception occurs while the other ranks wait in a collective operation that this rank will not enter.
///     `together_or_not_at_all` then aborts all ranks.
/// In a single process exceptions pass unchanged.

#include <exception>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/ranks/failure.h"
#include "app/ranks/ranks.h"

namespace pseudorigid::app {

/// Exception that all ranks throw, with the message and the exit code of the first rank on which the work failed.
class FailureOnAllRanks : public std::runtime_error {
 public:
  explicit FailureOnAllRanks(const Failure& failure)
      : std::runtime_error(failure.message), exit_code_(failure.exit_code) {}
  Failure failure() const { return {exit_code_, what()}; }

 private:
  int exit_code_;
};

/// Runs `work` on every rank. In a single process its exceptions pass unchanged. If a std::exception leaves the work on
/// one of several ranks, all ranks throw FailureOnAllRanks. Collective. The work itself must not contain collective
/// operations: after a failure on one rank, the other ranks would wait in these operations.
template <class Work>
void on_all_ranks(const Ranks& ranks, Work&& work) {
  if (ranks.size() == 1) return work();
  Failure mine{exit_done, ""};
  try {
    work();
  } catch (const std::exception& error) {
    mine = failure_of(error);
  }
  const int first = ranks.first_where(mine.exit_code != exit_done);
  if (first == ranks.size()) return;
  const int exit_code = ranks.number_of(first, mine.exit_code);
  throw FailureOnAllRanks({exit_code, ranks.text_of(first, std::move(mine.message))});
}

/// Runs collective work and returns its result. In a single process every exception passes unchanged. If the work fails
/// on one of several ranks, this rank calls `last_words(failure)` and then aborts all ranks. The function `last_words`
/// can, for example, write the failure to the log. A FailureOnAllRanks passes unchanged, because all ranks throw it.
template <class Work, class LastWords>
auto together_or_not_at_all(const Ranks& ranks, Work&& work, LastWords&& last_words) {
  try {
    return work();
  } catch (const FailureOnAllRanks&) {
    throw;
  } catch (const std::exception& error) {
    if (ranks.size() > 1) {
      const Failure failure = failure_of(error);
      last_words(failure);
      ranks.abort(failure.exit_code);
    }
    throw;
  }
}

}  // namespace pseudorigid::app
