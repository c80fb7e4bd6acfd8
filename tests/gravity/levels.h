#pragma once
/// The sums over pairs, compiled for every level of x86-64.

#include "gravity/pair_kernels.h"

namespace pseudorigid::testing {

std::span<const mechanics::KernelBuild<gravity::PairKernels>> builds_of_all_levels();

}  // namespace pseudorigid::testing
