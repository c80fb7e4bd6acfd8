#include "polynomial/ball_gravity_error.h"

#include <Eigen/Dense>
#include <utility>

namespace pseudorigid::polynomial {
namespace {

/// The coefficients of a field, one column for each function of the space. Entries that the space omits are 0.
Eigen::Matrix3Xd columns(const PolynomialSpace& space, const Eigen::VectorXd& x) {
  Eigen::Matrix3Xd columns = Eigen::Matrix3Xd::Zero(3, space.n_functions());
  for (int a = 0; a < space.n_functions(); ++a)
    for (int i = 0; i < 3; ++i)
      if (const int at = space.place(i, a); at >= 0) columns(i, a) = x[at];
  return columns;
}

}  // namespace

BallGravityError::BallGravityError(std::shared_ptr<const PolynomialSpace> space, const Eigen::VectorXd& derivative)
    : space_(std::move(space)), S_(space_->semi_axes()) {
  Eigen::VectorXd affine = Eigen::VectorXd::Zero(space_->n_unknowns());
  space_->set_affine(space_->affine_part(derivative), space_->mean(derivative), affine);
  epsilon_ = columns(*space_, derivative.head(space_->n_unknowns()) - affine);
}

Eigen::Matrix3d BallGravityError::M(const Eigen::VectorXd& q) const {
  return columns(*space_, q) * epsilon_.transpose();
}

void BallGravityError::add_product(const Eigen::Matrix3d& L, Eigen::VectorXd& f) const {
  const Eigen::Matrix3Xd product = L * epsilon_;
  for (int a = 0; a < space_->n_functions(); ++a)
    for (int i = 0; i < 3; ++i)
      if (const int at = space_->place(i, a); at >= 0) f[at] += product(i, a);
}

double BallGravityError::energy(const Eigen::VectorXd& q) const { return (B(q).inverse() * M(q)).trace(); }

Eigen::Matrix3d BallGravityError::add_derivative(const Eigen::VectorXd& q, Eigen::VectorXd& f) const {
  const Eigen::Matrix3d K = B(q).inverse().transpose();
  add_product(K, f);
  return -K * M(q).transpose() * K * S_;
}

Eigen::Matrix3d BallGravityError::add_derivative_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& u,
                                                      Eigen::VectorXd& f) const {
  const Eigen::Matrix3d K = B(q).inverse().transpose(), K_rate = -K * B(u).transpose() * K;
  const Eigen::Matrix3d Mt = M(q).transpose(), Mt_rate = M(u).transpose();
  add_product(K_rate, f);
  return -(K_rate * Mt * K + K * Mt_rate * K + K * Mt * K_rate) * S_;
}

}  // namespace pseudorigid::polynomial
