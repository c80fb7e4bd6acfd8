#pragma once
/// The functions of the pseudo-rigid model that are compiled once for each instruction set. They compute motions of
/// eight bodies (motions_in_lanes.h), and the eight stages of a Gauss step of one body (body_of_stages.h).

#include "mechanics/core/kernel_builds.h"
#include "reduced/body_of_stages.h"
#include "reduced/motions_in_lanes.h"

namespace pseudorigid::reduced {

/// The implementations of moves_in_lanes, motions_in_lanes and solve_stages_of_body, in this order.
struct MotionKernels {
  bool (*moves)(mechanics::MethodId method);
  MotionsInLanes (*motions)(const materials::AnyLaw& law, const InertiaInLanes& inertia, const MatricesInLanes& q,
                            const MatricesInLanes& v, mechanics::MethodId method, const mechanics::SampleTimes& times,
                            long n_steps);
  void (*solve_stages)(const BodyOfStages& body, BodyEntries entries, const AccountsOfStages* accounts,
                       mechanics::GaussStages& stages);
};

/// One table of functions for each instruction set, the fastest first. A source file that CMake generates defines this
/// function.
std::span<const mechanics::KernelBuild<MotionKernels>> builds_of_motion_kernels();

/// Returns the table that this process uses. Throws NoKernels if no table can be chosen
/// (mechanics/core/kernel_builds.h).
const MotionKernels& motion_kernels();

}  // namespace pseudorigid::reduced
