#pragma once
/// Motions of eight pseudo-rigid bodies at a time (eight_bodies.h), compiled for several sets of instructions
/// (motion_kernels.h). Arguments and results of this interface are plain numbers.

#include <array>
#include <string>
#include <vector>

#include "materials/law_table.h"
#include "mechanics/methods/methods.h"
#include "mechanics/methods/time_loop.h"

namespace pseudorigid::reduced {

inline constexpr int n_body_lanes = 8;

/// An entry of a matrix for all bodies, one entry after the other: (entry, body).
using MatricesInLanes = std::array<double, 9 * n_body_lanes>;

struct InertiaInLanes {
  std::array<double, n_body_lanes> volume;
  MatricesInLanes E0_inverse;
  bool isotropic;  ///< each E₀ is a multiple of Id
};

struct MotionsInLanes {
  std::string failure;  ///< failure of one of the bodies, which ends the motions of all; empty if there is none
  double t = 0;         ///< time reached
  std::vector<MatricesInLanes> q;  ///< at the samples
  std::vector<MatricesInLanes> v;
  mechanics::Counters counters{};
};

/// Whether bodies in lanes can move by a method: the symmetric multistep methods.
bool moves_in_lanes(mechanics::MethodId method);

MotionsInLanes motions_in_lanes(const materials::AnyLaw& law, const InertiaInLanes& inertia, const MatricesInLanes& q,
                                const MatricesInLanes& v, mechanics::MethodId method,
                                const mechanics::SampleTimes& times, long n_steps);

}  // namespace pseudorigid::reduced
