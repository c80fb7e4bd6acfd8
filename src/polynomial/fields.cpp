#include "polynomial/fields.h"

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <variant>

#include "materials/eigen_tensor.h"

namespace pseudorigid::polynomial {
namespace {

mechanics::Status inverted(double J, const Eigen::Vector3d& X) {
  char text[160];
  std::snprintf(text, sizeof text, "no stress to draw: det F = %.3g at X/r = (%.3f, %.3f, %.3f)", J, X[0], X[1], X[2]);
  return mechanics::Status::failure(text);
}

/// λ at a point.
double multiplier_at(const PolynomialSpace& space, const std::vector<Jet>& functions, const Eigen::VectorXd& lambda) {
  double value = 0;
  for (std::size_t b = 0; b < functions.size(); ++b)
    if (const int at = space.pressure_place(static_cast<int>(b)); at >= 0) value += lambda[at] * functions[b].value;
  return value;
}

}  // namespace

FieldsAtPoints::FieldsAtPoints(const PolynomialSpace& space, const std::vector<Eigen::Vector3d>& points)
    : points_(points) {
  for (const Eigen::Vector3d& xi : points) functions_.push_back(space.functions_at({xi[0], xi[1], xi[2]}));
}

mechanics::Status FieldsAtPoints::fields(const PolynomialBody& body, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                         const Eigen::VectorXd& lambda, mechanics::BodyFields& fields) const {
  const PolynomialSpace& space = body.space();
  const auto x = q.head(space.n_unknowns()), u = v.head(space.n_unknowns());
  fields = {};
  fields.center = space.mean(x);
  fields.moment = space.affine_part(x) * space.inertia().asDiagonal();
  double mean_potential = 0;
  if (body.gravity()) {
    std::vector<Eigen::Vector3d> positions;
    for (const auto& functions : functions_) positions.push_back(space.value(functions, x));
    fields.potential = body.gravity()->potential(q, positions);
    mean_potential = 5.0 / 3 * body.gravity()->energy(q) / space.volume();
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d X = space.semi_axes().cwiseProduct(points_[i]);
    const Eigen::Matrix3d F = space.gradient(functions_[i], x);
    const double J = F.determinant();
    if (!(J > 0 && std::isfinite(J))) return inverted(J, X);
    double pressure = lambda.size() > 0 ? multiplier_at(space, functions_[i], lambda) : 0;
    if (body.gravity()) pressure -= fields.potential[i] - mean_potential;
    const auto [P, W] = std::visit(
        [&](const auto& law) {
          const auto f = materials::to_tensor(F);
          return std::pair{materials::to_matrix(law.stress(f)), law.energy(f)};
        },
        body.law());
    const Eigen::Matrix3d stress = (P * F.transpose() - pressure * Eigen::Matrix3d::Identity()) / J;
    fields.add(X, space.value(functions_[i], x), space.value(functions_[i], u), F, stress, W);
  }
  return {};
}

}  // namespace pseudorigid::polynomial
