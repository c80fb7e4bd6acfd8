#pragma once
/// How the program ends: its exit codes, and the meaning of an exception.

#include <exception>
#include <string>

#include "mechanics/core/outcome.h"

namespace pseudorigid::app {

constexpr int exit_done = 0, exit_defect = 1, exit_wrong_input = 2, exit_stopped = 3;

constexpr int exit_code_of(mechanics::Outcome outcome) {
  return outcome == mechanics::Outcome::finished ? exit_done : exit_stopped;
}

struct Failure {
  int exit_code;
  std::string message;  ///< one sentence, for the user
};

/// The user's input is wrong (UserError); disk, memory or another means of the machine does not suffice; a defect.
Failure failure_of(const std::exception& error);

}  // namespace pseudorigid::app
