#pragma once
/// The kernels of the continuum as they are compiled for one set of instructions.

#include <cstddef>
#include <memory>

#include "continuum/kernels/local_kernels.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::continuum {

struct KernelTable {
  /// Throws std::invalid_argument for a degree that is not compiled.
  std::unique_ptr<LocalKernels> (*make_local_kernels)(int degree, const LocalCells& cells, const StoredEnergy& stored);
  /// y ← A x for the lower triangle of A by rows.
  void (*multiply_packed)(const float* entries, std::size_t n, const float* x, float* y);
  /// cell_products.h
  void (*add_product)(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y);
  void (*multiply_transposed)(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y);
};

/// Defined by the build, the best first.
std::span<const mechanics::KernelBuild<KernelTable>> builds_of_kernels();
/// The kernels of this process. Throws mechanics::NoKernels.
const mechanics::KernelBuild<KernelTable>& chosen_kernels();

}  // namespace pseudorigid::continuum
