#include "continuum/kernels/point_law_impl.h"

namespace pseudorigid::continuum {

std::unique_ptr<PointLaw> make_point_law(const materials::AnyLaw& law) {
  return std::visit(
      []<class Law>(const Law& l) -> std::unique_ptr<PointLaw> { return std::make_unique<LawAtPoints<Law>>(l); }, law);
}

}  // namespace pseudorigid::continuum
