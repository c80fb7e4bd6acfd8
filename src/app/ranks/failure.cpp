#include "app/ranks/failure.h"

#include <new>
#include <stdexcept>
#include <system_error>

#include "app/ranks/on_all_ranks.h"
#include "io/files.h"
#include "mechanics/core/kernel_builds.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

template <class Error>
bool is(const std::exception& error) {
  return dynamic_cast<const Error*>(&error) != nullptr;
}

}  // namespace

Failure failure_of(const std::exception& error) {
  if (const auto* agreed = dynamic_cast<const FailureOnAllRanks*>(&error)) return agreed->failure();
  if (is<UserError>(error) || is<mechanics::NoKernels>(error)) return {exit_wrong_input, error.what()};
  if (is<io::WriteError>(error)) return {exit_stopped, error.what()};
  // If no machine could provide the requested size, std::vector throws length_error in place of bad_alloc.
  if (is<std::bad_alloc>(error) || is<std::length_error>(error))
    return {exit_stopped, "the memory does not suffice for this scene"};
  // A system_error is not a defect of the program. Its causes are, for example, a file that cannot be read or removed,
  // or a thread that cannot be started.
  if (is<std::system_error>(error)) return {exit_stopped, std::string("the system refuses: ") + error.what()};
  return {exit_defect, std::string("a defect of pseudorigid, please report it: ") + error.what()};
}

}  // namespace pseudorigid::app
