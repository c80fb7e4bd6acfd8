#include "polynomial/fields.h"

#include <cstddef>

#include "materials/point_fields.h"

namespace pseudorigid::polynomial {
namespace {

/// The multiplier λ at a point.
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
    double pressure = lambda.size() > 0 ? multiplier_at(space, functions_[i], lambda) : 0;
    if (body.gravity()) pressure -= fields.potential[i] - mean_potential;
    if (auto status = materials::add_point(body.law(), X, space.value(functions_[i], x), space.value(functions_[i], u),
                                           space.gradient(functions_[i], x), pressure, fields);
        !status)
      return status;
  }
  return {};
}

}  // namespace pseudorigid::polynomial
