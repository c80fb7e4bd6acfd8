#include "polynomial/observe_stress.h"

#include <cstddef>

#include "materials/point_fields.h"
#include "observables/stress_sums.h"
#include "observables/whole_body.h"
#include "polynomial/dense_kernels.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {

mechanics::Status observe_stress(const PolynomialBody& body, const Eigen::VectorXd& q,
                                 mechanics::StressObservables& o) {
  const PolynomialSpace& space = body.space();
  const int n = space.n_points();
  ScratchArray F(space.gradients().size(3));
  space.gradients().evaluate(space.blocks(), 3, q.data(), F);
  mechanics::StressSums sums;
  for (int p = 0; p < n; ++p) {
    if (space.weights()[p] == 0) continue;
    Eigen::Matrix3d F_p, stress;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) F_p(i, k) = F[static_cast<std::ptrdiff_t>(3 * i + k) * n + p];
    const Eigen::Vector3d xi(space.points()[p][0], space.points()[p][1], space.points()[p][2]);
    const materials::BranchesAtPoint branches = body.relaxes() ? body.branches_at(q, p) : materials::BranchesAtPoint{};
    if (auto status = materials::cauchy_stress(body.law(), space.semi_axes().cwiseProduct(xi), F_p, branches, stress);
        !status)
      return status;
    sums.add(stress, space.weights()[p], xi.norm());
  }
  o.mean = sums.integral / sums.volume;
  o.largest = sums.largest;
  o.at_center =
      mechanics::von_mises(mechanics::without_odd_entries(sums.central / sums.n_central, body.space().reflect()));
  return {};
}

}  // namespace pseudorigid::polynomial
