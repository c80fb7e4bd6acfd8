#include "continuum/elastic_ball.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <string>

namespace pseudorigid::continuum {

ElasticBall::ElasticBall(const Sector& sector, int degree, int n_refinements, const materials::AnyLaw& law,
                         MPI_Comm communicator, std::optional<GramMethod> gram_method)
    : space_(BallMesh(sector, n_refinements, communicator), degree),
      kernels_(make_cell_kernels(space_, law)),
      gram_method_(gram_method.value_or(fitting_gram_method(space_))),
      volume_(sector.n_images() * kernels_->reference_volume()),
      least_cell_volume_(kernels_->least_cell_volume()) {
  E0_ = nodal_moment(space_.reference_positions(), space_.reference_positions());
}

double ElasticBall::multiplier_scale() const { return std::sqrt(least_cell_volume_); }

mechanics::Status ElasticBall::judge_jacobian(double least, const Vector& x) const {
  if (least > 0 && std::isfinite(least)) return {};
  const LeastJacobian found = kernels_->locate_least_jacobian(x);
  char text[160];
  std::snprintf(text, sizeof text, "an element is turned inside out: det F = %.3g at X/r = (%.3f, %.3f, %.3f)",
                found.value, found.where[0], found.where[1], found.where[2]);
  return mechanics::Status::failure(text);
}

mechanics::Status ElasticBall::force(double, const Vector& x, const Vector&, Workspace&, Vector& f) const {
  return judge_jacobian(kernels_->force(x, f), x);
}

mechanics::Status ElasticBall::constraint(const Vector& x, Multiplier& g) const {
  return judge_jacobian(kernels_->constraint(x, g), x);
}

void ElasticBall::apply_inverse_mass(const Vector& f, Vector& a) const {
  if (&a != &f) a = f;
  a.scale(space_.inverse_mass());
}

Vector ElasticBall::affine_field(const Eigen::Matrix3d& A) const {
  const Vector& X = space_.reference_positions();
  Vector x = make_vector();
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) x.local_element(i + r) += A(r, c) * X.local_element(i + c);
  return x;
}

Eigen::Matrix3d ElasticBall::nodal_moment(const Vector& a, const Vector& b) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (unsigned int i = 0; i < a.locally_owned_size(); i += 3)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        sum(r, c) += space_.mass().local_element(i) * a.local_element(i + r) * b.local_element(i + c);
  return whole_ball(sum);
}

Eigen::Matrix3d ElasticBall::whole_ball(const Eigen::Matrix3d& sector_integral) const {
  const Sector& sector = space_.mesh().sector();
  Eigen::Matrix3d result = sector.n_images() * sector_integral;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j && (sector.reflect[i] || sector.reflect[j])) result(i, j) = 0;
  return result;
}

Eigen::Matrix3d ElasticBall::mass_moment(const Vector& x) const {
  return nodal_moment(x, space_.reference_positions()) * E0_.inverse();
}

}  // namespace pseudorigid::continuum
