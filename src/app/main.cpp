#include "app/commands/libraries.h"
#include "app/commands/program.h"
#include "app/reduced/reduced_in_lanes.h"
#include "app/run/run_models.h"
#include "io/standard_streams.h"
#include "polynomial/dense_kernels.h"

int main(int argc, char** argv) {
  pseudorigid::io::open_standard_descriptors();
  using namespace pseudorigid::app;
  return run_program(
      argc, argv,
      {.models = {{"reduced", run_reduced}, {"polynomial", run_polynomial}},
       .together = {{"reduced", run_reduced_in_lanes}},
       .libraries = common_libraries(),
       .instructions = [] {
         return pseudorigid::mechanics::choose_build(pseudorigid::polynomial::builds_of_dense_kernels()).instructions;
       }});
}
