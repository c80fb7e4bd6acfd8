#include "polynomial/turns.h"

#include <Eigen/Dense>

#include "polynomial/octant_quadrature.h"

namespace pseudorigid::polynomial {

Turns::Turns(const PolynomialSpace& space) : space_(space), functions_(ball_polynomials(space.degree())) {
  const int N = space.degree();
  for (auto& of_axis : of_harmonics_)
    for (int l = 0; l <= N; ++l) of_axis.emplace_back(Eigen::MatrixXd::Zero(2 * l + 1, 2 * l + 1));
  for (const SurfacePoint& point : octant_surface_points(N / 2 + 1))  // exact for degree 2N
    for (int image = 0; image < 8; ++image) {
      std::array<double, 3> xi = point.xi;
      for (int i = 0; i < 3; ++i)
        if (image >> i & 1) xi[i] = -xi[i];
      const auto harmonics = solid_harmonics(N, xi);
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis).cross(Eigen::Vector3d(xi.data()));
        for (int l = 0; l <= N; ++l)
          for (int m = 0; m <= 2 * l; ++m) {
            const double rate = along.dot(Eigen::Vector3d(harmonics[l][m].gradient.data()));
            for (int k = 0; k <= 2 * l; ++k)
              of_harmonics_[axis][l](k, m) += point.weight * harmonics[l][k].value * rate;
          }
      }
    }
}

Eigen::VectorXd Turns::of_space(int axis, const Eigen::VectorXd& x) const {
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  Eigen::VectorXd turned = Eigen::VectorXd::Zero(x.size());
  for (int a = 0; a < space_.n_functions(); ++a) {
    turned[space_.place(j, a)] = -x[space_.place(k, a)];
    turned[space_.place(k, a)] = x[space_.place(j, a)];
  }
  return turned;
}

Eigen::VectorXd Turns::of_ball(int axis, const Eigen::VectorXd& x) const {
  Eigen::VectorXd turned = Eigen::VectorXd::Zero(x.size());
  for (int first = 0; first < space_.n_functions();) {  // a group of functions: the same n and l, m = −l … l
    const int l = functions_[first].l, n_members = 2 * l + 1;
    for (int i = 0; i < 3; ++i) {
      Eigen::VectorXd members(n_members);
      for (int m = 0; m < n_members; ++m) members[m] = x[space_.place(i, first + m)];
      members = of_harmonics_[axis][l] * members;
      for (int m = 0; m < n_members; ++m) turned[space_.place(i, first + m)] = members[m];
    }
    first += n_members;
  }
  return turned;
}

Eigen::VectorXd Turns::square(const Eigen::VectorXd& u) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(u.size());
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd once = of_space(axis, u) - of_ball(axis, u);
    sum -= of_space(axis, once) - of_ball(axis, once);
  }
  return sum;
}

}  // namespace pseudorigid::polynomial
