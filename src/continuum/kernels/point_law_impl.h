#pragma once
/// The implementation of PointLaw for any law of materials/.

#include <cmath>
#include <vector>

#include "continuum/kernels/point_law.h"
#include "continuum/kernels/stress_points.h"
#include "materials/volumetric_energy.h"

namespace pseudorigid::continuum {

template <class Law, int n_lanes>
class LawAtPoints final : public PointLaw<n_lanes> {
 public:
  using L = Lanes<n_lanes>;
  using Point = StressPoint<Law, L>;

  LawAtPoints(const Law& law, double volumetric_stiffness) : law_(law), kappa_(volumetric_stiffness) {}

  void reserve_points(std::size_t n_points) override { points_.reserve(n_points); }
  void add_points(const L* jacobians, const double* unit_weights, int n_points) override {
    for (int q = 0; q < n_points; ++q) points_.emplace_back(load(jacobians, n_points, q), unit_weights[q]);
  }
  std::size_t memory() const override { return points_.size() * sizeof(Point); }

  void stress(std::size_t first, const double* unit_weights, int n_points, L* H, L& least_of_all) const override {
    const Point* points = points_.data() + first;
    L least = least_of_all;
    for (int q = 0; q < n_points; ++q) {
      prefetch(points + n_points + q);
      const Tensor T = points[q].stress(law_, kappa_, unit_weights[q], load(H, n_points, q), least);
#pragma GCC unroll 9
      for (int k = 0; k < 9; ++k) H[k * n_points + q] = T.a[k / 3][k % 3];
    }
    least_of_all = least;
  }

  void energy(const L* F_at_points, const L* weights, int n_points, L& elastic, L& volumetric) const override {
    for (int q = 0; q < n_points; ++q) {
      const Tensor F = load(F_at_points, n_points, q);
      elastic += weights[q] * law_.energy(F);
      if (kappa_ != 0) volumetric += weights[q] * materials::volumetric_energy(kappa_, materials::determinant(F));
    }
  }

  void reserve(const L* F, int n_points, L* reserve) const override {
    for (int q = 0; q < n_points; ++q)
      if constexpr (materials::is_limited<Law>)
        reserve[q] = law_.reserve(load(F, n_points, q));
      else
        reserve[q] = L(HUGE_VAL);
  }

 private:
  using Tensor = materials::Tensor<L>;
  [[gnu::always_inline]] static Tensor load(const L* field, int n_points, int q) {
    const auto entry = [&](int k) { return field[k * n_points + q]; };
    return {{{entry(0), entry(1), entry(2)}, {entry(3), entry(4), entry(5)}, {entry(6), entry(7), entry(8)}}};
  }

  Law law_;
  double kappa_;
  std::vector<Point> points_;
};

}  // namespace pseudorigid::continuum
