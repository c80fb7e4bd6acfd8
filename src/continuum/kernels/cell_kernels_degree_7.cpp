#include "continuum/kernels/cell_kernels_impl.h"

template std::unique_ptr<pseudorigid::continuum::LocalKernels> pseudorigid::continuum::make_local_kernels<7>(
    const LocalCells&, const StoredEnergy&);
