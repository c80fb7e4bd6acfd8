#pragma once
/// Table of the functions for sums over pairs of points (surface_gravity.h). `sum` and `sum_moving` are the two
/// functions sum_pairs, for points at rest and for moving points, and `sum_own` is sum_own_pairs. The source
/// pair_sums.cpp is compiled once for each instruction set. Each compilation defines one such table.

#include "gravity/surface_gravity.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::gravity {

struct PairKernels {
  PairSums (*sum)(const SurfacePoints& targets, const SurfacePoints& sources);
  PairSums (*sum_own)(const SurfacePoints& points, const std::array<bool, 3>& mirrors);
  Moving<PairSums> (*sum_moving)(const Moving<SurfacePoints>& targets, const Moving<SurfacePoints>& sources);
};

/// Returns one table of functions for each instruction set, the fastest first. A source file that CMake generates
/// defines this function.
std::span<const mechanics::KernelBuild<PairKernels>> builds_of_pair_kernels();

}  // namespace pseudorigid::gravity
