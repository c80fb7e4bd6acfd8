#include <cholmod.h>
#include <deal.II/base/config.h>
#include <deal.II/base/multithread_info.h>
#include <fmt/format.h>

#include "app/libraries.h"
#include "app/program.h"
#include "app/run_models.h"

int main(int argc, char** argv) {
  // The kernels are SIMD within one process; threads in the library's vectors would only make sums irreproducible.
  dealii::MultithreadInfo::set_thread_limit(1);
  auto libraries = pseudorigid::app::common_libraries();
  libraries["deal.II"] = DEAL_II_PACKAGE_VERSION;
  libraries["CHOLMOD"] = fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION);
  return pseudorigid::app::run_program(argc, argv, {pseudorigid::app::run_continuum, std::move(libraries)});
}
