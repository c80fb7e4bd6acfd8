#pragma once
/// The kernels of the continuum as a table of functions. The table is compiled once for each instruction set
/// (mechanics/core/kernel_builds.h).

#include <cstddef>
#include <memory>

#include "continuum/kernels/local_kernels.h"
#include "mechanics/core/kernel_builds.h"

namespace pseudorigid::continuum {

struct KernelTable {
  /// Throws std::invalid_argument for a degree that is not compiled.
  std::unique_ptr<LocalKernels> (*make_local_kernels)(int degree, const LocalCells& cells, const StoredEnergy& stored);
  /// y ← A x for a symmetric A, given by the rows of its lower triangle (packed_product.h).
  void (*multiply_packed)(const float* entries, std::size_t n, const float* x, float* y);
  /// `add_product` and `multiply_transposed` are the functions of cell_products.h with these names.
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
