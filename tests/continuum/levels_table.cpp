#include "continuum/kernels/cell_products.h"
#include "continuum/kernels/packed_product.h"
#include "continuum/levels.h"

namespace pseudorigid::testing {
namespace {

std::unique_ptr<continuum::LocalKernels> make_kernels(int, const continuum::LocalCells& cells,
                                                      const continuum::StoredEnergy& stored) {
  return continuum::make_local_kernels<degree_of_levels>(cells, stored);
}

}  // namespace
}  // namespace pseudorigid::testing

extern const pseudorigid::continuum::KernelTable PSEUDORIGID_KERNEL_TABLE{
    .make_local_kernels = pseudorigid::testing::make_kernels,
    .multiply_packed = pseudorigid::continuum::multiply_packed,
    .add_product = pseudorigid::continuum::add_product,
    .multiply_transposed = pseudorigid::continuum::multiply_transposed};
