#pragma once
/// Vectors in huge pages of memory. A sweep over a large array then has fewer misses of the address translation, and
/// the prefetch of the processor does not end every 4 kB.

#include <cstddef>
#include <new>
#include <vector>

namespace pseudorigid::mechanics {

/// Size of a huge page in bytes.
inline constexpr std::size_t huge_page = std::size_t{1} << 21;

/// Returns `size` bytes of new memory, aligned to a huge page, in huge pages if the system has them. Throws
/// std::bad_alloc. `release_huge_pages` must get the same size.
void* new_huge_pages(std::size_t size);
void release_huge_pages(void* memory, std::size_t size) noexcept;

/// An allocator with huge pages for arrays that fill at least one.
template <class T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) noexcept {}

  T* allocate(std::size_t n) {
    const std::size_t size = n * sizeof(T);
    return static_cast<T*>(size < huge_page ? ::operator new(size, alignment) : new_huge_pages(size));
  }
  void deallocate(T* memory, std::size_t n) noexcept {
    if (n * sizeof(T) < huge_page)
      ::operator delete(memory, alignment);
    else
      release_huge_pages(memory, n * sizeof(T));
  }
  template <class U>
  bool operator==(const HugePageAllocator<U>&) const {
    return true;
  }

 private:
  static constexpr std::align_val_t alignment{alignof(T) > 64 ? alignof(T) : 64};
};

template <class T>
using HugePageVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace pseudorigid::mechanics
