#include "app/libraries.h"
#include "app/program.h"
#include "io/standard_streams.h"

int main(int argc, char** argv) {
  pseudorigid::io::open_standard_descriptors();
  return pseudorigid::app::run_program(argc, argv, {nullptr, pseudorigid::app::common_libraries()});
}
