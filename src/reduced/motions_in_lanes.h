#pragma once
/// Motions of eight pseudo-rigid bodies at once (eight_bodies.h), compiled for several instruction sets
/// (motion_kernels.h). The arguments and results of this interface are plain numbers.

#include <array>
#include <string>
#include <vector>

#include "materials/law_table.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"

namespace pseudorigid::reduced {

inline constexpr int n_body_lanes = 8;

/// The entries of a matrix for all bodies, row by row. The values of one entry for the eight bodies are contiguous:
/// [entry][body].
using MatricesInLanes = std::array<double, 9 * n_body_lanes>;

/// Volume and inverse inertia E₀⁻¹ of each body.
struct InertiaInLanes {
  std::array<double, n_body_lanes> volume;
  MatricesInLanes E0_inverse;
  bool isotropic;  ///< true if each E₀ is a multiple of Id
};

struct MotionsInLanes {
  std::string failure;             ///< reason of the failure of a body, which ends all motions; empty if all succeed
  double t = 0;                    ///< the time that the motions reached
  std::vector<MatricesInLanes> q;  ///< deformations Q at the samples
  std::vector<MatricesInLanes> v;  ///< velocities Q̇ at the samples
  mechanics::Counters counters{};
};

/// Returns true if motions_in_lanes can use the method. This is the case for the symmetric multistep methods.
bool moves_in_lanes(mechanics::MethodId method);

/// Integrates the motions of eight bodies from the deformations q and the velocities v at the time 0, with n_steps
/// steps between two samples. The first sample is the state at the time 0. If one body fails, all motions end, and the
/// result has the samples before the failure. If moves_in_lanes(method) is false, the result has no samples and no
/// failure.
MotionsInLanes motions_in_lanes(const materials::AnyLaw& law, const InertiaInLanes& inertia, const MatricesInLanes& q,
                                const MatricesInLanes& v, mechanics::MethodId method,
                                const mechanics::SampleTimes& times, long n_steps);

}  // namespace pseudorigid::reduced
