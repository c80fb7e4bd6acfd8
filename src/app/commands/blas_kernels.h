#pragma once
/// The kernels of OpenBLAS for this processor.
///
/// OpenBLAS chooses its kernels by the model of the processor. For a model that is newer than itself, it may choose
/// those of the oldest x86-64. OpenBLAS 0.3.21 of Debian 12 does so on Intel's Emerald Rapids. Modes and figures of
/// finite elements then take 1.5 to 1.8 times as long.

namespace pseudorigid::app {

/// Sets the environment variable OPENBLAS_CORETYPE to kernels for the vector instructions of this processor, if they
/// are those of x86-64-v3 or v4 and the variable is not set. OpenBLAS reads the variable when it is opened. Other
/// libraries of BLAS ignore it.
void choose_blas_kernels();

}  // namespace pseudorigid::app
