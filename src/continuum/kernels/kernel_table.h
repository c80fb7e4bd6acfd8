#pragma once
/// The kernels of the continuum as a table of functions. The table is compiled once for each instruction set
/// (mechanics/core/kernel_builds.h).

#include <cstddef>
#include <memory>

#include "continuum/kernels/local_kernels.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::continuum {

struct KernelTable {
  /// Returns the kernels for a degree from 1 to 8. Throws std::invalid_argument for another degree.
  std::unique_ptr<LocalKernels> (*make_local_kernels)(int degree, const LocalCells& cells, const StoredEnergy& stored);
  /// The function multiply_packed of packed_product.h.
  void (*multiply_packed)(const float* entries, std::size_t n, const float* x, float* y);
  /// The functions add_product and multiply_transposed of cell_products.h.
  void (*add_product)(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y);
  void (*multiply_transposed)(const float* A, std::size_t n_rows, std::size_t n_columns, const float* x, float* y);
};

/// One table of functions for each instruction set, the fastest first. A source file that CMake generates defines this
/// function.
std::span<const mechanics::KernelBuild<KernelTable>> builds_of_kernels();
/// The kernels that this process uses (mechanics/core/kernel_builds.h). Throws mechanics::NoKernels if no build can be
/// chosen.
const mechanics::KernelBuild<KernelTable>& chosen_kernels();

}  // namespace pseudorigid::continuum
