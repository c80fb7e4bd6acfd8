#include "mechanics/core/gauss_kernels.h"

#include "mechanics/core/gauss_iteration.h"

extern const pseudorigid::mechanics::GaussKernels PSEUDORIGID_KERNEL_TABLE{
    .solve = pseudorigid::mechanics::detail::iterate_by_calls};
