#include "polynomial/constraint.h"

#include <algorithm>

#include "materials/bulk_energy.h"
#include "polynomial/dense_kernels.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {
namespace {

/// F ← ∂u/∂X at the quadrature points.
void gradient(const PolynomialSpace& space, const Eigen::VectorXd& u, double* F) {
  space.gradients().evaluate(space.blocks(), 3, u.data(), F);
}
/// A ← F⁻ᵀ at the quadrature points, with F = ∂x/∂X.
void inverse_gradient(const PolynomialSpace& space, const Eigen::VectorXd& q, double* A) {
  ScratchArray F(space.gradients().size(3));
  gradient(space, q, F);
  dense().inverse_transposed(space.n_points(), F, A);
}
/// r_b ← Σ ψ_b y over the quadrature points, with the basis ψ_b of the pressures and a number y at each point.
/// Overwrites y.
void test_with_pressures(const PolynomialSpace& space, double* y, Eigen::VectorXd& r) {
  r.setZero();
  space.pressures().add_transposed(space.pressure_blocks(), 1, y, r.data());
}
/// s ← w λ at the quadrature points, with the quadrature weights w.
void weighted_pressure(const PolynomialSpace& space, const Eigen::VectorXd& lambda, double* s) {
  space.pressures().evaluate(space.pressure_blocks(), 1, lambda.data(), s);
  for (int p = 0; p < space.n_points(); ++p) s[p] *= space.weights()[p];
}
void clear(const PolynomialSpace& space, double* T) { std::fill_n(T, space.gradients().size(3), 0.0); }

}  // namespace

double constraint(const PolynomialSpace& space, const Eigen::VectorXd& q, Eigen::VectorXd& g) {
  ScratchArray F(space.gradients().size(3)), y(space.n_points());
  gradient(space, q, F);
  const double least = dense().log_jacobian(space.n_points(), space.weights().data(), F, y);
  test_with_pressures(space, y, g);
  return least;
}

double bulk(const PolynomialSpace& space, double lambda, const Eigen::VectorXd& g, Eigen::VectorXd& b) {
  const materials::BulkEnergy bulk{lambda};
  ScratchArray theta(space.n_points());
  space.pressures().evaluate(space.pressure_blocks(), 1, g.data(), theta);
  double energy = 0;
  for (int p = 0; p < space.n_points(); ++p) {
    energy += space.weights()[p] * bulk.energy(theta[p]);
    theta[p] = space.weights()[p] * bulk.rate(theta[p]);
  }
  test_with_pressures(space, theta, b);
  return energy;
}

void constraint_rate(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                     Eigen::VectorXd& r) {
  ScratchArray A(space.gradients().size(3)), B(space.gradients().size(3)), y(space.n_points());
  inverse_gradient(space, q, A);
  gradient(space, v, B);
  dense().weighted_product(space.n_points(), space.weights().data(), A, B, y);
  test_with_pressures(space, y, r);
}

void constraint_curvature(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                          Eigen::VectorXd& r) {
  ScratchArray A(space.gradients().size(3)), B(space.gradients().size(3)), y(space.n_points());
  inverse_gradient(space, q, A);
  gradient(space, v, B);
  dense().weighted_curvature(space.n_points(), space.weights().data(), A, B, y);
  test_with_pressures(space, y, r);
}

void add_reaction(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda,
                  Eigen::VectorXd& f) {
  ScratchArray A(space.gradients().size(3)), T(space.gradients().size(3)), s(space.n_points());
  inverse_gradient(space, q, A);
  weighted_pressure(space, lambda, s);
  clear(space, T);
  dense().add_multiple(space.n_points(), s, A, T);
  space.gradients().add_transposed(space.blocks(), 3, T, f.data());
}

void add_reaction_rate(const PolynomialSpace& space, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const Eigen::VectorXd& lambda, Eigen::VectorXd& f) {
  ScratchArray A(space.gradients().size(3)), B(space.gradients().size(3)), T(space.gradients().size(3)),
      s(space.n_points());
  inverse_gradient(space, q, A);
  gradient(space, v, B);
  weighted_pressure(space, lambda, s);
  clear(space, T);
  dense().add_rate_of_inverse(space.n_points(), s, A, B, T);
  space.gradients().add_transposed(space.blocks(), 3, T, f.data());
}

ReactionsBetween::ReactionsBetween(const PolynomialSpace& space, const Eigen::VectorXd& q1, const Eigen::VectorXd& q0)
    : space_(space),
      same_(q1.data() == q0.data()),
      A1_(space.gradients().size(3)),
      A0_(same_ ? 0 : space.gradients().size(3)) {
  inverse_gradient(space, q1, A1_);
  if (!same_) inverse_gradient(space, q0, A0_);
}

void ReactionsBetween::multiply(const Eigen::VectorXd& lambda, Eigen::VectorXd& product) {
  double* A0 = same_ ? A1_ : A0_;
  ScratchArray T(space_.gradients().size(3)), y(space_.n_points()), f(space_.n_unknowns());
  weighted_pressure(space_, lambda, y);
  clear(space_, T);
  dense().add_multiple(space_.n_points(), y, A0, T);
  std::fill_n(static_cast<double*>(f), space_.n_unknowns(), 0.0);
  space_.gradients().add_transposed(space_.blocks(), 3, T, f);
  space_.gradients().evaluate(space_.blocks(), 3, f, T);
  dense().weighted_product(space_.n_points(), space_.weights().data(), A1_, T, y);
  test_with_pressures(space_, y, product);
}

}  // namespace pseudorigid::polynomial
