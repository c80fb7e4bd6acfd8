#include "app/libraries.h"
#include "app/program.h"

int main(int argc, char** argv) {
  return pseudorigid::app::run_program(argc, argv, {nullptr, pseudorigid::app::common_libraries()});
}
