#include "app/commands/stack_limit.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cerrno>
#include <system_error>

namespace pseudorigid::app {

void require_stack() {
  constexpr rlim_t kilobyte = 1024, needed = 512 * kilobyte;
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= needed) return;
  throw std::system_error(ENOMEM, std::generic_category(),
                          fmt::format("the program needs {} kB of stack, and ulimit -s allows {} kB", needed / kilobyte,
                                      limit.rlim_cur / kilobyte));
}

}  // namespace pseudorigid::app
