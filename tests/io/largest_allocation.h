#pragma once
/// The largest single allocation of the program since it was last set to 0, to prove that a forged size is never
/// believed. Linking largest_allocation.cpp replaces the global operator new.

#include <atomic>
#include <cstddef>

namespace pseudorigid::io::test {

extern std::atomic<std::size_t> largest_allocation;

}  // namespace pseudorigid::io::test
