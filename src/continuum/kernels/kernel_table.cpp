#include "continuum/kernels/kernel_table.h"

#include <stdexcept>
#include <string>

#include "continuum/kernels/cell_products.h"
#include "continuum/kernels/packed_product.h"

namespace pseudorigid::continuum {
namespace {

std::unique_ptr<LocalKernels> make_kernels(int degree, const LocalCells& cells, const StoredEnergy& stored) {
  switch (degree) {
    case 1:
      return make_local_kernels<1>(cells, stored);
    case 2:
      return make_local_kernels<2>(cells, stored);
    case 3:
      return make_local_kernels<3>(cells, stored);
    case 4:
      return make_local_kernels<4>(cells, stored);
    case 5:
      return make_local_kernels<5>(cells, stored);
    case 6:
      return make_local_kernels<6>(cells, stored);
    case 7:
      return make_local_kernels<7>(cells, stored);
    case 8:
      return make_local_kernels<8>(cells, stored);
  }
  throw std::invalid_argument("no kernels for degree " + std::to_string(degree));
}

}  // namespace
}  // namespace pseudorigid::continuum

extern const pseudorigid::continuum::KernelTable PSEUDORIGID_KERNEL_TABLE{
    .make_local_kernels = pseudorigid::continuum::make_kernels,
    .multiply_packed = pseudorigid::continuum::multiply_packed,
    .add_product = pseudorigid::continuum::add_product,
    .multiply_transposed = pseudorigid::continuum::multiply_transposed};
