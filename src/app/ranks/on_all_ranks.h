#pragma once
/// A failure on one rank must end all ranks: the others would wait for a rank that is gone. So an exception may leave
/// collective work only if every rank has it. There are two ways:
///  - what one rank does alone and what may fail there (files) is done by on_all_ranks, which tells all of them;
///  - any other exception cannot reach the others, which wait in a collective operation that this rank will not enter:
///    together_or_not_at_all ends them.
/// In a single process exceptions pass unchanged.

#include <exception>
#include <optional>
#include <stdexcept>
#include <utility>

#include "app/ranks/failure.h"
#include "app/ranks/ranks.h"

namespace pseudorigid::app {

/// Thrown by all ranks, with the message of the first rank on which the work failed.
class FailureOnAllRanks : public std::runtime_error {
 public:
  explicit FailureOnAllRanks(const Failure& failure)
      : std::runtime_error(failure.message), exit_code_(failure.exit_code) {}
  Failure failure() const { return {exit_code_, what()}; }

 private:
  int exit_code_;
};

/// Collective. The work itself is not: a rank that fails during the work must not leave the others waiting.
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

/// The result of the work, which is collective. `last_words(failure)` are those of the rank that ends all.
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
