#pragma once
/// Table of the functions for sums over pairs of points. The members implement functions of surface_gravity.h: `sum`
/// implements sum_pairs for points without rates, `sum_moving` implements sum_pairs for points with rates, and
/// `sum_own` implements sum_own_pairs. The source pair_sums.cpp is compiled once for each instruction set. Each
/// compilation defines one such table.

#include "gravity/surface_gravity.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::gravity {

struct PairKernels {
  PairSums (*sum)(const SurfacePoints& targets, const SurfacePoints& sources);
  PairSums (*sum_own)(const SurfacePoints& points, const std::array<bool, 3>& mirrors);
  Moving<PairSums> (*sum_moving)(const Moving<SurfacePoints>& targets, const Moving<SurfacePoints>& sources);
};

/// Returns the tables for all instruction sets of this program, the fastest first. The processor may lack some of these
/// instruction sets. A source file that CMake generates defines this function.
std::span<const mechanics::KernelBuild<PairKernels>> builds_of_pair_kernels();

}  // namespace pseudorigid::gravity
