#include "largest_allocation.h"

#include <cstdlib>
#include <new>

namespace pseudorigid::io::test {

std::atomic<std::size_t> largest_allocation = 0;

}  // namespace pseudorigid::io::test

void* operator new(std::size_t size) {
  using pseudorigid::io::test::largest_allocation;
  if (size > largest_allocation) largest_allocation = size;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
