#pragma once
/// The inner loops of polynomial bodies, compiled for every level of x86-64.

#include "polynomial/dense_kernels.h"

namespace pseudorigid::testing {

std::span<const mechanics::KernelBuild<polynomial::DenseKernels>> builds_of_dense_levels();

}  // namespace pseudorigid::testing
