#include "app/libraries.h"
#include "app/program.h"
#include "app/run_models.h"
#include "io/standard_streams.h"

int main(int argc, char** argv) {
  pseudorigid::io::open_standard_descriptors();
  using namespace pseudorigid::app;
  return run_program(argc, argv, {.models = {{"reduced", run_reduced}}, .libraries = common_libraries()});
}
