#pragma once
/// Kernels of degree 3 for the neo-Hookean law with a pure gauge, W + c ln J.

#include <memory>

#include "continuum/kernels/cell_kernels.h"

namespace pseudorigid::testing {

inline constexpr int gauged_degree = 3;

std::unique_ptr<continuum::CellKernels> make_gauged_kernels(const continuum::BallSpace& space, double c);

}  // namespace pseudorigid::testing
