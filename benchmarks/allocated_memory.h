#pragma once
/// Bytes that the process has allocated and not given back: unlike the resident set, without what libraries map and
/// what the allocator keeps.

#include <malloc.h>

namespace pseudorigid::benchmarks {

inline double allocated_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

}  // namespace pseudorigid::benchmarks
