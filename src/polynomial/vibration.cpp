#include "polynomial/vibration.h"

#include <algorithm>

namespace pseudorigid::polynomial {
namespace {

/// The number of quadrature points in each direction for products of polynomials of degree N with the motions of the
/// modes. Let d be the largest degree of these products. The points of a space of degree M are exact up to the degree
/// 2M + 3, and M is the least number with 2M + 3 ≥ d. The result is at least the number of points for degree N.
int n_points(int N) {
  const int degree_of_products = N + mechanics::SpheroidalMotions::largest_power;
  const int M = (degree_of_products - 2) / 2;
  return PolynomialSpace::least_points(std::max(N, M));
}

mechanics::Vibration vibration_of(const PolynomialSpace& space) {
  const mechanics::SpheroidalMotions motions(space.reflect());
  Eigen::Matrix3Xd X(3, space.n_points());
  Eigen::VectorXd masses(space.n_points());
  Eigen::MatrixXd products(motions.size(), 3 * space.n_points());
  for (int p = 0; p < space.n_points(); ++p) {
    X.col(p) = Eigen::Vector3d(space.points()[p].data());
    masses[p] = space.weights()[p] / space.n_mirrors();
    products.middleCols<3>(3 * p) = masses[p] * motions.at(X.col(p));
  }
  return {motions, X, masses, products};
}

}  // namespace

BodyVibration::BodyVibration(const PolynomialSpace& space)
    : space_(space.degree(), space.reflect(), space.semi_axes(), n_points(space.degree())),
      vibration_(vibration_of(space_)) {}

mechanics::VibrationObservables BodyVibration::observe(const BodyState& state,
                                                       const mechanics::ContinuumObservables& known) const {
  const auto relative = [&](const Eigen::VectorXd& u, const Eigen::Vector3d& mean) -> Eigen::Matrix3Xd {
    return space_.values_at_points(u.head(space_.n_unknowns())).transpose().colwise() - mean;
  };
  const Eigen::VectorXd sums =
      vibration_.sums(relative(state.q, known.center), relative(state.v, known.velocity), known.Q, known.Qdot);
  return vibration_.observables(sums, known.elastic);
}

}  // namespace pseudorigid::polynomial
