#pragma once
/// Motions of eight bodies (motions_in_lanes.h) as they are compiled for one set of instructions.

#include "mechanics/core/kernel_builds.h"
#include "reduced/motions_in_lanes.h"

namespace pseudorigid::reduced {

struct MotionKernels {
  bool (*moves)(mechanics::MethodId method);
  MotionsInLanes (*motions)(const materials::AnyLaw& law, const InertiaInLanes& inertia, const MatricesInLanes& q,
                            const MatricesInLanes& v, mechanics::MethodId method, const mechanics::SampleTimes& times,
                            long n_steps);
};

/// Defined by the build, the best first.
std::span<const mechanics::KernelBuild<MotionKernels>> builds_of_motion_kernels();

}  // namespace pseudorigid::reduced
