#pragma once
/// The iteration of gauss_iteration.h, compiled for one instruction set. `solve` is the function iterate_by_calls of
/// gauss_iteration.h, for fields that are evaluated by a virtual function (GaussField).

#include <span>

#include "mechanics/core/gauss_stages.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::mechanics {

struct GaussKernels {
  void (*solve)(const GaussField& field, GaussStages& stages);
};

/// Returns one table for each instruction set, the fastest first. A source file that CMake generates
/// (cmake/Kernels.cmake) defines this function.
std::span<const KernelBuild<GaussKernels>> builds_of_gauss_kernels();

}  // namespace pseudorigid::mechanics
