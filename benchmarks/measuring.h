#pragma once
/// What every benchmark does: take processor times, and end with a sentence where something fails.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "mechanics/core/status.h"

namespace pseudorigid::benchmarks {

/// Processor time of the process, in seconds. Ranks that wait for others do so busily, so that it is wall clock on a
/// machine without other work.
inline double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// That `work` takes.
template <class Work>
double cpu_seconds(const Work& work) {
  const double start = cpu_seconds();
  work();
  return cpu_seconds() - start;
}

/// The upper one of two.
inline double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

inline void require(const mechanics::Status& status) {
  if (status) return;
  std::fprintf(stderr, "error: %s\n", status.reason().c_str());
  std::exit(1);
}

}  // namespace pseudorigid::benchmarks
