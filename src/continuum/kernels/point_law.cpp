#include "continuum/kernels/point_law_impl.h"

namespace pseudorigid::continuum {

std::unique_ptr<PointLaw> make_point_law(const StoredEnergy& stored) {
  return std::visit(
      [&]<class Law>(const Law& law) -> std::unique_ptr<PointLaw> {
        return std::make_unique<LawAtPoints<Law>>(law, stored.volumetric_stiffness);
      },
      stored.law);
}

}  // namespace pseudorigid::continuum
