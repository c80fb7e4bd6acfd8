#pragma once
/// The number of allocations of the program so far: linking allocations.cpp puts a counter before glibc's malloc, which
/// operator new and Eigen call. Sanitizers have a malloc of their own, and nothing is counted.

#include <atomic>

namespace pseudorigid::testing {

extern std::atomic<long> n_allocations;
extern const bool allocations_are_counted;

}  // namespace pseudorigid::testing
