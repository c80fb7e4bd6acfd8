#include "polynomial/allocations.h"

#include <cstddef>
#include <cstdlib>

namespace pseudorigid::testing {

std::atomic<long> n_allocations = 0;

}  // namespace pseudorigid::testing

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace pseudorigid::testing {
const bool allocations_are_counted = true;
}

extern "C" {
void* __libc_malloc(std::size_t size);  // NOLINT: glibc's name
void* malloc(std::size_t size) {
  ++pseudorigid::testing::n_allocations;
  return __libc_malloc(size);
}
}

#else

namespace pseudorigid::testing {
const bool allocations_are_counted = false;
}

#endif
