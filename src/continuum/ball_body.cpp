#include "continuum/ball_body.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <string>

#include "continuum/ranks.h"

namespace pseudorigid::continuum {

BallBody::BallBody(const Sector& sector, int degree, int n_refinements, const materials::AnyLaw& law,
                   const BallLoads& loads, MPI_Comm communicator)
    : space_(BallMesh(sector, n_refinements, communicator), degree, loads.dissipative()),
      kernels_(make_cell_kernels(space_, law)),
      loads_(loads, space_, *kernels_),
      dissipative_(loads.dissipative()),
      volume_(sector.n_images() * kernels_->reference_volume()) {
  E0_ = nodal_moment(space_.reference_positions(), space_.reference_positions());
}

mechanics::Status BallBody::judge_jacobian(double least, const Vector& x) const {
  if (least > 0 && std::isfinite(least)) return {};
  const LeastJacobian found = kernels_->locate_least_jacobian(x);
  char text[160];
  std::snprintf(text, sizeof text, "an element is turned inside out: det F = %.3g at X/r = (%.3f, %.3f, %.3f)",
                found.value, found.where[0], found.where[1], found.where[2]);
  return mechanics::Status::failure(text);
}

mechanics::Status BallBody::applied_force(const Vector& x, const Vector& v, Vector& f) const {
  if (auto status = judge_jacobian(kernels_->force(x, f), x); !status) return status;
  loads_.add(x, v, f);
  return {};
}

void BallBody::apply_inverse_mass(const Vector& f, Vector& a) const {
  if (&a != &f) a = f;
  a.scale(space_.inverse_mass());
}

Vector BallBody::affine_field(const Eigen::Matrix3d& A, const Eigen::Vector3d& c) const {
  const Vector& X = space_.reference_positions();
  Vector x = make_vector();
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3) {
    if (space_.account() == i) continue;
    for (int r = 0; r < 3; ++r) {
      x.local_element(i + r) = c[r];
      for (int j = 0; j < 3; ++j) x.local_element(i + r) += A(r, j) * X.local_element(i + j);
    }
  }
  return x;
}

Eigen::Vector3d BallBody::mean(const Vector& x) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double mass = 0;
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3) {
    const double m = space_.mass().local_element(i);
    mass += m;
    for (int c = 0; c < 3; ++c) sum[c] += m * x.local_element(i + c);
  }
  for (int c = 0; c < 3; ++c)
    if (space_.mesh().sector().reflect[c]) sum[c] = 0;
  return sum / mass;
}

double BallBody::mass() const { return space_.mesh().sector().n_images() * space_.mass().l1_norm() / 3; }

double BallBody::dissipated(const Vector& v) const {
  const auto entry = space_.account();
  return sum_over_ranks(entry ? v.local_element(*entry) : 0, space_.communicator());
}

Eigen::Matrix3d BallBody::nodal_moment(const Vector& a, const Vector& b) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (unsigned int i = 0; i < a.locally_owned_size(); i += 3)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        sum(r, c) += space_.mass().local_element(i) * a.local_element(i + r) * b.local_element(i + c);
  return whole_ball(sum);
}

Eigen::Matrix3d BallBody::whole_ball(const Eigen::Matrix3d& sector_integral) const {
  const Sector& sector = space_.mesh().sector();
  Eigen::Matrix3d result = sector.n_images() * sector_integral;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j && (sector.reflect[i] || sector.reflect[j])) result(i, j) = 0;
  return result;
}

Eigen::Matrix3d BallBody::mass_moment(const Vector& x) const {
  return nodal_moment(x, space_.reference_positions()) * E0_.inverse();
}

}  // namespace pseudorigid::continuum
