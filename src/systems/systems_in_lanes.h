#pragma once
/// Systems whose fields are compiled for the eight stages of a Gauss step at once (gauss_system_kernels.cpp). To add
/// one:
///   - a chart whose functions take any scalar: a type in `SystemKernels` and a line in the table of the kernels;
///   - another system: a struct of plain numbers as well, and its field over any scalar.
///
/// A type that crosses to the kernels has the same layout for all instructions. Eigen's types that are
/// aligned as double have it. Matrices in arrays are in the order of Eigen's: column by column.

#include <Eigen/Core>
#include <concepts>
#include <span>
#include <tuple>

#include "mechanics/core/gauss_stages.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::systems {

struct DoublePendulumChart;
struct EulerAngleChart;
struct FixedAxis;
struct Torus;
struct Sphere;
struct TorusSurface;
struct Ellipsoid;
struct Paraboloid;
struct HyperbolicHalfPlane;
struct BodyLoads;
struct FrameOfStages;  // moving_frame.h
class MassPoints;

/// Euler's equation on quaternions (euler_top.h), under these loads if there are any.
struct TopOfStages {
  Eigen::Matrix3d A, A_inverse;
  const BodyLoads* loads = nullptr;
};

/// The spherical pendulum (spherical_pendulum_scene.h) with its explicit multiplier, z pointing up:
///   q̈ = b + λq,  b = −g e_z − c q̇/m,  λ|q|² = −|q̇|² − ⟨q, b⟩.
struct SphericalPendulumOfStages {
  static constexpr int n = 3;
  double g = 1, drag = 0;  // c/m

  template <class T>
  T operator()(int, const T* q, const T* v, T* a) const {
    const T square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2], speed2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    for (int k = 0; k < 3; ++k) a[k] = -drag * v[k];
    a[2] = a[2] - g;
    const T lambda = -(speed2 + q[0] * a[0] + q[1] * a[1] + q[2] * a[2]) / square;
    for (int k = 0; k < 3; ++k) a[k] = a[k] + lambda * q[k];
    return square;
  }
};

/// The double pendulum in multiplier form (double_pendulum.h).
struct PendulumOfStages {
  double m1 = 1, m2 = 1, l1 = 1, l2 = 1, g = 1;
};

/// Solves the stages, or returns false before it begins if it cannot.
template <class S>
using StageSolver = bool (*)(const S& system, mechanics::GaussStages& stages);

template <class... S>
struct StageSolvers {
  std::tuple<StageSolver<S>...> of;
  template <class Other>
  static constexpr bool has = (std::same_as<S, Other> || ...);
};

using SystemKernels = StageSolvers<TopOfStages, PendulumOfStages, DoublePendulumChart, EulerAngleChart, FixedAxis,
                                   Torus, Sphere, TorusSurface, Ellipsoid, Paraboloid, HyperbolicHalfPlane,
                                   SphericalPendulumOfStages, FrameOfStages, MassPoints>;

/// Defined by the build, the best first.
std::span<const mechanics::KernelBuild<SystemKernels>> builds_of_system_kernels();

/// Those that this process uses.
inline const SystemKernels& system_kernels() {
  static const SystemKernels& kernels = *mechanics::choose_build(builds_of_system_kernels()).table;
  return kernels;
}

/// For exactly these types: one that is derived from them may have another field.
template <class S>
requires(SystemKernels::has<S>) bool solve_stages_in_lanes_of(const S& system, mechanics::GaussStages& stages) {
  return std::get<StageSolver<S>>(system_kernels().of)(system, stages);
}

/// Cost of an iteration (mechanics/core/stage_by_stage.h), measured in nanoseconds. For points and the spherical
/// pendulum it is over those of a stage of rattle-8 or symmetric-8 (110/349, 388/125, 61/158). For the others it is
/// over those of a force of explicit-8, which counts twice (charts: 72/99 to 590/480).
template <class S>
inline constexpr double cost_of_iteration_in_lanes = 2;
template <>
inline constexpr double cost_of_iteration_in_lanes<TopOfStages> = 1.8;
template <>
inline constexpr double cost_of_iteration_in_lanes<PendulumOfStages> = 0.32;
template <>
inline constexpr double cost_of_iteration_in_lanes<DoublePendulumChart> = 1.7;
template <>
inline constexpr double cost_of_iteration_in_lanes<SphericalPendulumOfStages> = 0.4;
template <>
inline constexpr double cost_of_iteration_in_lanes<FrameOfStages> = 3;
template <>
inline constexpr double cost_of_iteration_in_lanes<MassPoints> = 3;

template <class S>
requires(SystemKernels::has<S>) double cost_of_iteration_of(const S&) { return cost_of_iteration_in_lanes<S>; }

}  // namespace pseudorigid::systems
