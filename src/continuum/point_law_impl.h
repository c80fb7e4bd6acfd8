#pragma once
/// PointLaw for any law of materials/.

#include <cmath>

#include "continuum/point_law.h"

namespace pseudorigid::continuum {

template <class Law>
class LawAtPoints final : public PointLaw {
 public:
  explicit LawAtPoints(const Law& law) : law_(law) {}

  void stress(const QuadraturePoint* points, int n_points, L* H, L& least_J) const override {
    least_J = L(HUGE_VAL);
    for (int q = 0; q < n_points; ++q) {
      const QuadraturePoint& p = points[q];
      const Tensor H_q = load(H, n_points, q);
      least_J = min(materials::determinant(H_q) * p.inverse_determinant, least_J);
      const Tensor P = law_.stress(p.deformation_gradient(H_q));
      for (int i = 0; i < 3; ++i)
        for (int d = 0; d < 3; ++d) {
          const L* row = p.inverse_jacobian + 3 * d;
          H[(3 * i + d) * n_points + q] = -p.weight * (P(i, 0) * row[0] + P(i, 1) * row[1] + P(i, 2) * row[2]);
        }
    }
  }

  void energy(const QuadraturePoint* points, int n_points, const L* H, L& energy) const override {
    energy = L(0.0);
    for (int q = 0; q < n_points; ++q)
      energy += points[q].weight * law_.energy(points[q].deformation_gradient(load(H, n_points, q)));
  }

 private:
  using Tensor = materials::Tensor<L>;
  static Tensor load(const L* field, int n_points, int q) {
    Tensor T;
    for (int k = 0; k < 9; ++k) T(k / 3, k % 3) = field[k * n_points + q];
    return T;
  }

  Law law_;
};

}  // namespace pseudorigid::continuum
