#include "app/commands/libraries.h"
#include "app/commands/open_continuum.h"
#include "app/commands/program.h"
#include "io/standard_streams.h"
#include "polynomial/dense_kernels.h"

int main(int argc, char** argv) {
  pseudorigid::io::open_standard_descriptors();
  using namespace pseudorigid::app;
  return run_program(
      argc, argv,
      {.models = ball_models(),
       .libraries = common_libraries(),
       .instructions =
           [] {
             return pseudorigid::mechanics::choose_build(pseudorigid::polynomial::builds_of_dense_kernels())
                 .instructions;
           },
       .open_continuum = open_continuum});
}
