#include "continuum/kernels/point_law_impl.h"

namespace pseudorigid::continuum {

template <int n_lanes>
std::unique_ptr<PointLaw<n_lanes>> make_point_law(const StoredEnergy& stored) {
  return std::visit(
      [&]<class Law>(const Law& law) -> std::unique_ptr<PointLaw<n_lanes>> {
        return std::make_unique<LawAtPoints<Law, n_lanes>>(law, stored.volumetric_stiffness);
      },
      stored.law);
}

template std::unique_ptr<PointLaw<native_lanes>> make_point_law(const StoredEnergy& stored);
// Without AVX-512, few_lanes equals native_lanes, and a second instantiation would be an error.
#if defined(__AVX512F__)
template std::unique_ptr<PointLaw<few_lanes>> make_point_law(const StoredEnergy& stored);
#endif

}  // namespace pseudorigid::continuum
