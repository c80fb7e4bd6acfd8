#include "polynomial/observe_stress.h"

#include <cstddef>
#include <vector>

#include "materials/point_fields.h"
#include "observables/stress_sums.h"
#include "observables/whole_body.h"
#include "polynomial/dense_kernels.h"
#include "polynomial/fields.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {
namespace {

Eigen::Vector3d unit_point(const PolynomialSpace& space, int p) {
  const auto& xi = space.points()[p];
  return {xi[0], xi[1], xi[2]};
}

/// Adds the quadrature points to `sums`.
mechanics::Status add_quadrature_points(const PolynomialBody& body, const Eigen::VectorXd& q,
                                        mechanics::StressSums& sums) {
  const PolynomialSpace& space = body.space();
  const int n = space.n_points();
  ScratchArray F(space.gradients().size(3));
  space.gradients().evaluate(space.blocks(), 3, q.data(), F);
  for (int p = 0; p < n; ++p) {
    if (space.weights()[p] == 0) continue;
    Eigen::Matrix3d F_p, stress;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) F_p(i, k) = F[static_cast<std::ptrdiff_t>(3 * i + k) * n + p];
    const Eigen::Vector3d X = space.semi_axes().cwiseProduct(unit_point(space, p));
    const materials::BranchesAtPoint branches = body.relaxes() ? body.branches_at(q, p) : materials::BranchesAtPoint{};
    if (auto status = materials::cauchy_stress(body.law(), X, F_p, branches, stress); !status) return status;
    sums.add(stress, space.weights()[p]);
  }
  return {};
}

/// The centre, and then the projections of the outermost quadrature points onto the unit sphere.
std::vector<Eigen::Vector3d> center_and_surface(const PolynomialSpace& space) {
  double outermost = 0;
  for (int p = 0; p < space.n_points(); ++p)
    if (space.weights()[p] != 0) outermost = std::max(outermost, unit_point(space, p).norm());
  std::vector<Eigen::Vector3d> points{Eigen::Vector3d::Zero()};
  for (int p = 0; p < space.n_points(); ++p)
    if (const Eigen::Vector3d xi = unit_point(space, p); space.weights()[p] != 0 && xi.norm() > 0.999 * outermost)
      points.push_back(xi.normalized());
  return points;
}

}  // namespace

mechanics::Status observe_stress(const PolynomialBody& body, const Eigen::VectorXd& q,
                                 mechanics::StressObservables& o) {
  mechanics::StressSums sums;
  if (auto status = add_quadrature_points(body, q, sums); !status) return status;
  std::vector<Eigen::Matrix3d> stresses;
  const FieldsAtPoints at(body.space(), center_and_surface(body.space()));
  if (auto status = at.stresses(body, q, stresses); !status) return status;
  for (const Eigen::Matrix3d& stress : stresses) sums.add(stress, 0);
  o.mean = sums.integral / sums.volume;
  o.largest = sums.largest;
  o.at_center = mechanics::von_mises(mechanics::without_odd_entries(stresses.front(), body.space().reflect()));
  return {};
}

}  // namespace pseudorigid::polynomial
