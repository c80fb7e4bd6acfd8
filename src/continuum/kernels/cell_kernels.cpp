#include "continuum/kernels/cell_kernels.h"

#include <stdexcept>
#include <string>

namespace pseudorigid::continuum {

template <int degree>
std::unique_ptr<CellKernels> make_kernels_of_degree(const BallSpace& space, const materials::AnyLaw& law);

std::unique_ptr<CellKernels> make_cell_kernels(const BallSpace& space, const materials::AnyLaw& law) {
  switch (space.degree()) {
    case 1:
      return make_kernels_of_degree<1>(space, law);
    case 2:
      return make_kernels_of_degree<2>(space, law);
    case 3:
      return make_kernels_of_degree<3>(space, law);
    case 4:
      return make_kernels_of_degree<4>(space, law);
    case 5:
      return make_kernels_of_degree<5>(space, law);
    case 6:
      return make_kernels_of_degree<6>(space, law);
    case 7:
      return make_kernels_of_degree<7>(space, law);
    case 8:
      return make_kernels_of_degree<8>(space, law);
  }
  throw std::invalid_argument("no kernels for degree " + std::to_string(space.degree()));
}

}  // namespace pseudorigid::continuum
