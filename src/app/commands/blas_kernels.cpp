#include "app/commands/blas_kernels.h"

#include <cstdlib>

namespace pseudorigid::app {

void choose_blas_kernels() {
#ifdef __x86_64__
  constexpr const char* variable = "OPENBLAS_CORETYPE";
  constexpr int keeps = 0;  // a value that the user has set
  if (__builtin_cpu_supports("x86-64-v4"))
    ::setenv(variable, "SKYLAKEX", keeps);
  else if (__builtin_cpu_supports("x86-64-v3"))
    ::setenv(variable, "HASWELL", keeps);
#endif
}

}  // namespace pseudorigid::app
