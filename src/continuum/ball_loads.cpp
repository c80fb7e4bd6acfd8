#include "continuum/ball_loads.h"

#include "continuum/ranks.h"

namespace pseudorigid::continuum {
namespace {

/// ∫∇φ_n dX: the viscous force −2η∫d F⁻ᵀ∇φ_n of the dilation ẋ = X at rest, where d = F = Id, with 2η = −1.
Vector integrated_gradients(const BallSpace& space, const CellKernels& kernels) {
  const Vector& X = space.reference_positions();
  Vector gradients = space.make_vector();
  kernels.add_viscous_force(-0.5, X, X, gradients);
  return gradients;
}

/// A a_n at every node.
Vector at_nodes(const Eigen::Matrix3d& A, const Vector& a) {
  Vector result = a;
  for (unsigned int i = 0; i < a.locally_owned_size(); i += 3)
    for (int r = 0; r < 3; ++r) {
      double sum = 0;
      for (int c = 0; c < 3; ++c) sum += A(r, c) * a.local_element(i + c);
      result.local_element(i + r) = sum;
    }
  return result;
}

}  // namespace

LoadForces::LoadForces(const BallLoads& loads, const BallSpace& space, const CellKernels& kernels)
    : loads_(loads), space_(space), kernels_(kernels) {
  if (!loads.nominal_traction.isZero(0))
    traction_ = at_nodes(loads.nominal_traction, integrated_gradients(space, kernels));
}

void LoadForces::add(const Vector& x, const Vector& v, Vector& f) const {
  if (!loads_.quadratic.isZero(0) || !loads_.acceleration.isZero(0)) add_body_forces(x, f);
  if (traction_) f += *traction_;
  if (!loads_.dissipative()) return;
  const double power =
      space_.mesh().sector().n_images() * sum_over_ranks(add_dissipation(x, v, f), space_.communicator());
  if (const auto entry = space_.account()) f.local_element(*entry) = power;
}

void LoadForces::add_body_forces(const Vector& x, Vector& f) const {
  const Vector& mass = space_.mass();
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3)
    for (int r = 0; r < 3; ++r) {
      double acceleration = loads_.acceleration[r];
      for (int c = 0; c < 3; ++c) acceleration -= loads_.quadratic(r, c) * x.local_element(i + c);
      f.local_element(i + r) += mass.local_element(i) * acceleration;
    }
}

double LoadForces::add_dissipation(const Vector& x, const Vector& v, Vector& f) const {
  double power = loads_.viscosity == 0 ? 0 : kernels_.add_viscous_force(loads_.viscosity, x, v, f);
  if (loads_.drag == 0) return power;
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i) {
    const double drag = loads_.drag * space_.mass().local_element(i) * v.local_element(i);
    f.local_element(i) -= drag;
    power += drag * v.local_element(i);
  }
  return power;
}

double LoadForces::potential(const Eigen::Matrix3d& second_moment, const Eigen::Vector3d& first_moment,
                             const Eigen::Matrix3d& F_integral) const {
  return 0.5 * loads_.quadratic.cwiseProduct(second_moment).sum() - loads_.acceleration.dot(first_moment) -
         loads_.nominal_traction.cwiseProduct(F_integral).sum();
}

}  // namespace pseudorigid::continuum
