#pragma once
/// The exit codes of the program, and the exit code of each kind of exception.

#include <exception>
#include <string>

#include "mechanics/core/outcome.h"

namespace pseudorigid::app {

/// The code exit_done means that the command is done. The code exit_defect means a defect of the program, and
/// exit_wrong_input means wrong input of the user. The code exit_stopped means that a run stopped early, or that memory
/// or another resource was not available.
constexpr int exit_done = 0, exit_defect = 1, exit_wrong_input = 2, exit_stopped = 3;

/// The exit code of a run with this outcome. A failed and an interrupted run have the same code.
constexpr int exit_code_of(mechanics::Outcome outcome) {
  return outcome == mechanics::Outcome::finished ? exit_done : exit_stopped;
}

struct Failure {
  int exit_code;
  std::string message;  ///< one sentence for the user
};

/// The exit code and the message for an exception. Wrong input of the user, and kernels that do not exist for the
/// processor, have the exit code 2. A failed write, a lack of memory or an error of the operating system has the exit
/// code 3. A FailureOnAllRanks has the code and the message of the exception that caused it. Any other exception is a
/// defect of the program and has the exit code 1.
Failure failure_of(const std::exception& error);

}  // namespace pseudorigid::app
