#include "reduced/motions_in_lanes.h"

#include "reduced/motion_kernels.h"

namespace pseudorigid::reduced {
const MotionKernels& motion_kernels() {
  static const MotionKernels& kernels = *mechanics::choose_build(builds_of_motion_kernels()).table;
  return kernels;
}

bool moves_in_lanes(mechanics::MethodId method) { return motion_kernels().moves(method); }

MotionsInLanes motions_in_lanes(const materials::AnyLaw& law, const InertiaInLanes& inertia, const MatricesInLanes& q,
                                const MatricesInLanes& v, mechanics::MethodId method,
                                const mechanics::SampleTimes& times, long n_steps) {
  return motion_kernels().motions(law, inertia, q, v, method, times, n_steps);
}

}  // namespace pseudorigid::reduced
