#include "continuum/kernels/cell_kernels_impl.h"

template std::unique_ptr<pseudorigid::continuum::CellKernels> pseudorigid::continuum::make_kernels_of_degree<3>(
    const BallSpace&, const materials::AnyLaw&);
