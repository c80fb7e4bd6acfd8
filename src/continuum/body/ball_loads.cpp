#include "continuum/body/ball_loads.h"

#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {
namespace {

/// Returns ∫∇φ_n dX for every node n with its basis function φ_n. The kernel for the viscous force −2η∫J d F⁻ᵀ∇φ_n
/// computes this integral with x = ẋ = X and 2η = −1, because then F = d = Id.
Vector integrated_gradients(const BallSpace& space, const CellKernels& kernels) {
  const Vector& X = space.reference_positions();
  Vector gradients = space.make_vector();
  kernels.add_viscous_force(-0.5, X, X, gradients);
  return gradients;
}

/// The nodal field with the value A a_n at node n. a_n is the value of `a` at this node.
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

LoadForces::LoadForces(const loads::Loads& loads, const BallSpace& space, const CellKernels& kernels)
    : loads_(loads),
      constant_(loads::constant_forcing(loads)),
      driven_(loads::depend_on_time(loads)),
      space_(space),
      kernels_(kernels) {
  if (driven_) gradients_ = integrated_gradients(space, kernels);
  if (!constant_.nominal_traction.isZero(0))
    traction_ = at_nodes(constant_.nominal_traction, integrated_gradients(space, kernels));
}

void LoadForces::add(double t, const Vector& x, const Vector& v, Vector& f) const {
  add_body_forces(constant_, x, f);
  if (traction_) f += *traction_;
  add_pressure(constant_.pressure, x, f);
  double given = 0;
  if (driven_) {
    add_driving(loads::driving(loads_, t), x, f);
    given = driving_power(loads::driving_rate(loads_, t), x);
  }
  const double taken = constant_.damped() ? add_dissipation(x, v, f) : 0;
  if (!driven_ && !constant_.dissipative()) return;
  const auto whole_ball = [&](double power) {
    return space_.mesh().sector().n_images() * sum_over_ranks(power, space_.communicator());
  };
  const double all_taken = whole_ball(taken), all_given = driven_ ? whole_ball(given) : 0;
  if (const auto entry = space_.account()) {
    f.local_element(*entry) = all_taken;
    f.local_element(*entry + 1) = all_given;
  }
}

void LoadForces::add_body_forces(const loads::Forcing& forcing, const Vector& x, Vector& f) const {
  if (forcing.quadratic.isZero(0) && forcing.acceleration.isZero(0)) return;
  const Vector& mass = space_.mass();
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3)
    for (int r = 0; r < 3; ++r) {
      double acceleration = forcing.acceleration[r];
      for (int c = 0; c < 3; ++c) acceleration -= forcing.quadratic(r, c) * x.local_element(i + c);
      f.local_element(i + r) += mass.local_element(i) * acceleration;
    }
}

/// Adds the force of the pressure to f. This force equals the viscous force −2η∫J d F⁻ᵀ∇φ_n of the velocity ẋ = x with
/// 2η = p, because then d = Id.
void LoadForces::add_pressure(double pressure, const Vector& x, Vector& f) const {
  if (pressure != 0) kernels_.add_viscous_force(pressure / 2, x, x, f);
}

void LoadForces::add_driving(const loads::Forcing& forcing, const Vector& x, Vector& f) const {
  add_body_forces(forcing, x, f);
  if (!forcing.nominal_traction.isZero(0)) f += at_nodes(forcing.nominal_traction, *gradients_);
  add_pressure(forcing.pressure, x, f);
}

double LoadForces::driving_power(const loads::Forcing& rate, const Vector& x) const {
  const Vector& mass = space_.mass();
  double power = 0;
  for (unsigned int i = 0; i < x.locally_owned_size(); i += 3) {
    const Eigen::Vector3d x_n(x.local_element(i), x.local_element(i + 1), x.local_element(i + 2)),
        gradient(gradients_->local_element(i), gradients_->local_element(i + 1), gradients_->local_element(i + 2));
    power += mass.local_element(i) * (0.5 * x_n.dot(rate.quadratic * x_n) - rate.acceleration.dot(x_n)) -
             x_n.dot(rate.nominal_traction * gradient);
  }
  if (rate.pressure == 0) return power;
  // The potential of the pressure, p ∫J dX, is homogeneous of degree 3 in x. By Euler's theorem, the potential is
  // therefore a third of the scalar product of x and its gradient, which is −`force`.
  Vector force = space_.make_vector();
  add_pressure(rate.pressure, x, force);
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i) power -= force.local_element(i) * x.local_element(i) / 3;
  return power;
}

double LoadForces::add_dissipation(const Vector& x, const Vector& v, Vector& f) const {
  double power = constant_.viscosity == 0 ? 0 : kernels_.add_viscous_force(constant_.viscosity, x, v, f);
  if (constant_.drag == 0) return power;
  for (unsigned int i = 0; i < v.locally_owned_size(); ++i) {
    const double drag = constant_.drag * space_.mass().local_element(i) * v.local_element(i);
    f.local_element(i) -= drag;
    power += drag * v.local_element(i);
  }
  return power;
}

double LoadForces::potential(double t, const Eigen::Matrix3d& second_moment, const Eigen::Vector3d& first_moment,
                             const Eigen::Matrix3d& F_integral, double volume) const {
  const double constant = constant_.potential(second_moment, first_moment, F_integral, volume);
  if (!driven_) return constant;
  return constant + loads::driving(loads_, t).potential(second_moment, first_moment, F_integral, volume);
}

}  // namespace pseudorigid::continuum
