#pragma once
/// The iteration on the stages of a Gauss step as it is compiled for one set of instructions, for fields that are
/// called stage after stage.

#include <span>

#include "mechanics/core/gauss_stages.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::mechanics {

struct GaussKernels {
  void (*solve)(const GaussField& field, GaussStages& stages);
};

/// Defined by the build, the best first.
std::span<const KernelBuild<GaussKernels>> builds_of_gauss_kernels();

}  // namespace pseudorigid::mechanics
