#include "mechanics/core/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace pseudorigid::mechanics {
namespace {

std::size_t whole_pages(std::size_t size) { return (size + huge_page - 1) / huge_page * huge_page; }

}  // namespace

// The memory is mapped anew. Memory that was in use before keeps its usual pages.
void* new_huge_pages(std::size_t size) {
  const std::size_t whole = whole_pages(size), mapped = whole + huge_page;
  void* const start = mmap(nullptr, mapped, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (start == MAP_FAILED) throw std::bad_alloc();
  const auto address = reinterpret_cast<std::uintptr_t>(start);
  const std::size_t before = whole_pages(address) - address, after = mapped - before - whole;
  char* const memory = static_cast<char*>(start) + before;
  if (before > 0) munmap(start, before);
  if (after > 0) munmap(memory + whole, after);
  (void)madvise(memory, whole, MADV_HUGEPAGE);  // if the system refuses, the pages are usual ones
  return memory;
}

void release_huge_pages(void* memory, std::size_t size) noexcept { munmap(memory, whole_pages(size)); }

}  // namespace pseudorigid::mechanics
