#include "continuum/gauged_kernels.h"

#include "continuum/kernels/cell_kernels_impl.h"
#include "continuum/kernels/point_law_impl.h"

namespace pseudorigid::testing {
namespace {

/// W + c ln J,  P + c F⁻ᵀ
struct Gauged {
  materials::CiarletGeymonat law;
  double c;

  template <class T>
  T energy(const materials::Tensor<T>& F) const {
    return law.energy(F) + c * log(materials::determinant(F));
  }
  template <class T>
  materials::Tensor<T> stress(const materials::Tensor<T>& F) const {
    materials::Tensor<T> P = law.stress(F);
    const materials::Tensor<T> cof = materials::cofactor(F);
    const T factor = c / materials::determinant(F, cof);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) P(i, j) = P(i, j) + factor * cof(i, j);
    return P;
  }
};

}  // namespace

std::unique_ptr<continuum::CellKernels> make_gauged_kernels(const continuum::BallSpace& space, double c) {
  using Law = continuum::LawAtPoints<Gauged, continuum::few_lanes>;
  return std::make_unique<continuum::CellKernels>(
      space, std::make_unique<continuum::DegreeKernels<gauged_degree, continuum::few_lanes>>(
                 local_cells(space), std::make_unique<Law>(Gauged{{1, 0}, c}, 0.0)));
}

}  // namespace pseudorigid::testing
