#pragma once
/// Systems as plain numbers, for the kernels that evaluate their fields at the eight stages of a Gauss step at once
/// (gauss_system_kernels.cpp). Matrices are in the order of Eigen's: column by column.

#include <array>
#include <span>

#include "mechanics/core/gauss_stages.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::systems {

/// Euler's equation on quaternions (euler_top.h), under the weight of the body.
struct TopOfStages {
  std::array<double, 9> A{}, A_inverse{};
  bool has_weight = false;
  std::array<double, 3> moment{}, gravity{};  ///< mG, g
};

/// The double pendulum in its two forms (double_pendulum.h, double_pendulum_chart.h).
struct PendulumOfStages {
  double m1 = 1, m2 = 1, l1 = 1, l2 = 1, g = 1;
};

struct SystemKernels {
  void (*top)(const TopOfStages& top, mechanics::GaussStages& stages);
  void (*pendulum_points)(const PendulumOfStages& pendulum, mechanics::GaussStages& stages);
  void (*pendulum_angles)(const PendulumOfStages& pendulum, mechanics::GaussStages& stages);
};

/// Defined by the build, the best first.
std::span<const mechanics::KernelBuild<SystemKernels>> builds_of_system_kernels();

/// Cost of an iteration (mechanics/core/stage_by_stage.h). Measured as nanoseconds over those of a stage of
/// rattle-8 for the points (110/349), and of a force of explicit-8, which counts twice, for the others (73/81, 90/104).
inline constexpr double cost_of_top = 1.8, cost_of_pendulum_points = 0.32, cost_of_pendulum_angles = 1.7;

/// Those that this process uses.
inline const SystemKernels& system_kernels() {
  static const SystemKernels& kernels = *mechanics::choose_build(builds_of_system_kernels()).table;
  return kernels;
}

}  // namespace pseudorigid::systems
