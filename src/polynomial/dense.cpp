#include "polynomial/dense_kernels.h"

namespace pseudorigid::polynomial {

const DenseKernels& dense() {
  static const DenseKernels& kernels = *mechanics::choose_build(builds_of_dense_kernels()).table;
  return kernels;
}

}  // namespace pseudorigid::polynomial
