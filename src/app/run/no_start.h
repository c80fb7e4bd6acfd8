#pragma once
/// Failure of the start of a motion, which is known only when the model computes its start.

#include <stdexcept>
#include <utility>

#include "app/run/run_context.h"

namespace pseudorigid::app {

/// The model cannot compute the start of the scene. The text is a sentence for the user.
struct NoStart : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns run(), the outcome of a model's run. If the model cannot compute its start, returns a failed outcome.
template <class Run>
ModelOutcome run_from_start(Run&& run) try {
  return std::forward<Run>(run)();
} catch (const NoStart& reason) {
  ModelOutcome outcome;
  outcome.end = mechanics::Outcome::failed;
  outcome.message = reason.what();
  return outcome;
}

}  // namespace pseudorigid::app
