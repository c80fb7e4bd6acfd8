#pragma once
/// Systems whose second-order fields are compiled for the eight stages of a Gauss step at once
/// (gauss_system_kernels.cpp). A second-order field gives the accelerations as a function of time, positions and
/// velocities. To add a chart, write its functions over any scalar type, add the type to `SystemKernels`, and include
/// its header in gauss_system_kernels.cpp. To add any other system, also write a struct of its numbers. Then add its
/// field over any scalar type and an overload of `solve` to gauss_system_kernels.cpp.
///
/// The types passed to the kernels must have the same memory layout for every instruction set. Eigen's types with the
/// alignment of double meet this condition. Matrices in arrays are stored by columns, as in Eigen.

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
struct FrameOfStages;  // defined in moving_frame.h
class MassPoints;

/// The data of Euler's equation on quaternions (euler_top.h): the inertia operator A, its inverse, and the loads that
/// cause the torque. If `loads` is null, the torque is zero.
struct TopOfStages {
  Eigen::Matrix3d A, A_inverse;
  const BodyLoads* loads = nullptr;
};

/// The spherical pendulum (spherical_pendulum_scene.h) with the mass m, the acceleration of gravity g, the drag
/// coefficient c and an explicit multiplier λ. The z axis points upwards:
///   q̈ = b + λq,  b = −g e_z − c q̇/m,  λ|q|² = −|q̇|² − ⟨q, b⟩.
struct SphericalPendulumOfStages {
  static constexpr int n = 3;
  double g = 1, drag = 0;  // acceleration g of gravity, and c/m

  /// Computes the acceleration a at the position q and the velocity v. Returns |q|², which is positive if the
  /// acceleration is defined.
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

/// The double pendulum in multiplier form (double_pendulum.h): masses m1 and m2 of the points, lengths l1 and l2 of the
/// rods, and acceleration g of gravity.
struct PendulumOfStages {
  double m1 = 1, m2 = 1, l1 = 1, l2 = 1, g = 1;
};

/// A function that solves for the stages of a Gauss step and sets stages.converged. If the function returns false, it
/// has done nothing, and the caller must evaluate the stages one by one.
template <class S>
using StageSolver = bool (*)(const S& system, mechanics::GaussStages& stages);

/// A table with one solver for each of the types S. The constant has<Other> is true if Other is one of these types.
template <class... S>
struct StageSolvers {
  std::tuple<StageSolver<S>...> of;
  template <class Other>
  static constexpr bool has = (std::same_as<S, Other> || ...);
};

using SystemKernels = StageSolvers<TopOfStages, PendulumOfStages, DoublePendulumChart, EulerAngleChart, FixedAxis,
                                   Torus, Sphere, TorusSurface, Ellipsoid, Paraboloid, HyperbolicHalfPlane,
                                   SphericalPendulumOfStages, FrameOfStages, MassPoints>;

/// Returns the builds of the kernels for several instruction sets, the fastest first. A source file that CMake
/// generates defines this function.
std::span<const mechanics::KernelBuild<SystemKernels>> builds_of_system_kernels();

/// The kernels that this process uses. Throws mechanics::NoKernels if no build can be chosen
/// (mechanics/core/kernel_builds.h).
inline const SystemKernels& system_kernels() {
  static const SystemKernels& kernels = *mechanics::choose_build(builds_of_system_kernels()).table;
  return kernels;
}

/// Solves for the stages. If the result is false, the stages must be evaluated one by one. S must be one of the types
/// of SystemKernels. A type derived from one of these types is not accepted, because its field may differ. Throws
/// mechanics::NoKernels as system_kernels does.
template <class S>
requires(SystemKernels::has<S>) bool solve_stages_in_lanes_of(const S& system, mechanics::GaussStages& stages) {
  return std::get<StageSolver<S>>(system_kernels().of)(system, stages);
}

/// Cost of an iteration on the eight stages, in units of one force evaluation (mechanics/core/stage_by_stage.h). The
/// costs follow from times measured in nanoseconds. For three systems, the cost is the time of an iteration divided by
/// the time of a stage of rattle-8 or symmetric-8. These quotients are 110/349 for the double pendulum, 388/125 for
/// mass points, and 61/158 for the spherical pendulum. For the other systems, the cost is twice the time of an
/// iteration divided by the time of a force evaluation of explicit-8. For charts, the time of an iteration divided by
/// the time of an evaluation is between 72/99 and 590/480.
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
