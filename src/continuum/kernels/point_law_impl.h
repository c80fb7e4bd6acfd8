#pragma once
/// PointLaw for any law of materials/.

#include <cmath>

#include "continuum/kernels/point_law.h"

namespace pseudorigid::continuum {

template <class Law, int n_lanes>
class LawAtPoints final : public PointLaw<n_lanes> {
 public:
  using L = Lanes<n_lanes>;
  using Point = QuadraturePoint<n_lanes>;

  LawAtPoints(const Law& law, double volumetric_stiffness) : law_(law), kappa_(volumetric_stiffness) {}

  void stress(const Point* points, int n_points, L* H, L& least_of_all) const override {
    L least = least_of_all;
    for (int q = 0; q < n_points; ++q) {
      const Point& p = points[q];
      prefetch(points + n_points + q);
      const Tensor F = p.deformation_gradient(load(H, n_points, q));
      least = min(materials::determinant(F), least);
      if constexpr (materials::is_limited<Law>) least = min(law_.reserve(F), least);
      Tensor P = -p.weight * law_.stress(F);
      if (kappa_ != 0) add_stabilization(p.weight, F, P);
      const L* row = p.inverse_jacobian;
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i)
#pragma GCC unroll 3
        for (int d = 0; d < 3; ++d)
          H[(3 * i + d) * n_points + q] = P(i, 0) * row[3 * d] + P(i, 1) * row[3 * d + 1] + P(i, 2) * row[3 * d + 2];
    }
    least_of_all = least;
  }

  void energy(const Point* points, int n_points, const L* H, L& elastic, L& volumetric) const override {
    for (int q = 0; q < n_points; ++q) {
      const Tensor F = points[q].deformation_gradient(load(H, n_points, q));
      elastic += points[q].weight * law_.energy(F);
      if (kappa_ == 0) continue;
      const L J = materials::determinant(F);
      volumetric += points[q].weight * (0.25 * kappa_) * (J * J - 1.0 - 2.0 * log(J));
    }
  }

  void reserve(const Point* points, int n_points, const L* H, L* reserve) const override {
    for (int q = 0; q < n_points; ++q)
      if constexpr (materials::is_limited<Law>)
        reserve[q] = law_.reserve(points[q].deformation_gradient(load(H, n_points, q)));
      else
        reserve[q] = L(HUGE_VAL);
  }

 private:
  using Tensor = materials::Tensor<L>;
  [[gnu::always_inline]] static Tensor load(const L* field, int n_points, int q) {
    const auto entry = [&](int k) { return field[k * n_points + q]; };
    return {{{entry(0), entry(1), entry(2)}, {entry(3), entry(4), entry(5)}, {entry(6), entry(7), entry(8)}}};
  }

  /// P ← P − w ∂U/∂F
  [[gnu::always_inline]] void add_stabilization(const L& weight, const Tensor& F, Tensor& P) const {
    const Tensor cof = materials::cofactor(F);
    const L J = materials::determinant(F, cof), factor = weight * (0.5 * kappa_) * (J - 1.0 / J);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) P(i, j) = P(i, j) - factor * cof(i, j);
  }

  Law law_;
  double kappa_;
};

}  // namespace pseudorigid::continuum
