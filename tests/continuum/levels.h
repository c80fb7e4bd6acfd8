#pragma once
/// The kernels of degree 4, compiled for every level of x86-64.

#include "continuum/kernels/kernel_table.h"

namespace pseudorigid::testing {

inline constexpr int degree_of_levels = 4;
std::span<const mechanics::KernelBuild<continuum::KernelTable>> builds_of_degree_4();

}  // namespace pseudorigid::testing
