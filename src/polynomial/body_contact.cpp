#include "polynomial/body_contact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "polynomial/octant_quadrature.h"
#include "polynomial/scratch.h"

namespace pseudorigid::polynomial {

BodyContact::BodyContact(const loads::Planes& planes, std::shared_ptr<const PolynomialSpace> space, int n_points)
    : planes_(planes),
      space_(std::move(space)),
      S_(space_->semi_axes().asDiagonal()),
      tables_(space_->surface_values(space_->degree() == 1 ? 1 : n_points)),
      largest_(static_cast<std::size_t>(space_->n_unknowns()), 0.0) {
  if (is_affine()) return;
  const std::vector<SurfacePoint> octant = octant_surface_points(n_points);
  for (int image = 0; image < space_->n_images(); ++image)
    for (std::size_t p = 0; p < octant.size(); ++p) {
      places_.push_back(static_cast<std::size_t>(image) * tables_.stride() + p);
      weights_.push_back(octant[p].weight);
    }
  Eigen::VectorXd affine = Eigen::VectorXd::Zero(space_->n_unknowns());
  space_->set_affine(Eigen::Matrix3d::Ones(), Eigen::Vector3d::Ones(), affine);
  for (const Block& block : space_->blocks())
    for (int k = 0; k < block.n(); ++k) {
      const int at = block.offset + k;
      if (affine[at] != 0) continue;
      for (const double value : tables_.row(block, k, 0)) largest_[at] = std::max(largest_[at], std::abs(value));
    }
}

loads::EllipsoidContact BodyContact::affine_contact(const loads::Plane& plane, const Eigen::VectorXd& q) const {
  const auto x = q.head(space_->n_unknowns());
  return {plane, S_, space_->affine_part(x), space_->mean(x)};
}

bool BodyContact::may_touch(const loads::Plane& plane, const Eigen::VectorXd& q) const {
  double reach = -affine_contact(plane, q).contact().height;  // largest depth of the affine part behind the plane
  for (const Block& block : space_->blocks())
    for (int k = 0; k < block.n(); ++k)
      reach += std::abs(plane.normal[block.component] * q[block.offset + k]) * largest_[block.offset + k];
  return reach > 0;
}

bool BodyContact::may_touch(const Eigen::VectorXd& q) const {
  return std::any_of(planes_.begin(), planes_.end(), [&](const loads::Plane& plane) { return may_touch(plane, q); });
}

BodyContact::Field BodyContact::positions(const Eigen::VectorXd& q) const {
  Field values(tables_.size(3));
  tables_.evaluate(space_->blocks(), 3, q.data(), values.data());
  return values;
}

Eigen::Vector3d BodyContact::at(const Field& field, std::size_t place) const {
  const std::size_t n = static_cast<std::size_t>(tables_.n_points());
  return {field[place], field[n + place], field[2 * n + place]};
}

void BodyContact::add_at(Field& field, std::size_t place, const Eigen::Vector3d& value) const {
  const std::size_t n = static_cast<std::size_t>(tables_.n_points());
  for (std::size_t i = 0; i < 3; ++i) field[i * n + place] += value[static_cast<Eigen::Index>(i)];
}

std::vector<loads::PlaneContact> BodyContact::of_points(const Field& x) const {
  std::vector<loads::PlaneContact> contacts(planes_.size());
  for (std::size_t j = 0; j < planes_.size(); ++j)
    for (std::size_t p = 0; p < places_.size(); ++p) contacts[j].add(planes_[j], at(x, places_[p]), weights_[p]);
  return contacts;
}

loads::Contact BodyContact::contact(const Eigen::VectorXd& q) const {
  if (!is_affine()) return summary(planes_, of_whole_body(planes_, of_points(positions(q)), space_->reflect()));
  std::vector<loads::PlaneContact> contacts;
  for (const loads::Plane& plane : planes_) contacts.push_back(affine_contact(plane, q).contact());
  return summary(planes_, contacts);
}

/// Adds the generalised force of a force field at the points to f. The tables have the functions of the whole body, and
/// the points are in the computed sector. Therefore `by_point` is multiplied by the number of copies of the sector.
void BodyContact::spread(Field& by_point, Eigen::VectorXd& f) const {
  for (double& value : by_point) value *= space_->n_mirrors();
  tables_.add_transposed(space_->blocks(), 3, by_point.data(), f.data());
}

/// Adds the generalised force of an affine force to f. The coefficients of x = c + A X are c √Vol and A_ij √E₀_j.
void BodyContact::spread(const loads::AffineForce& force, Eigen::VectorXd& f) const {
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(space_->n_unknowns());
  space_->set_affine(force.on_Q * space_->inertia().cwiseInverse().asDiagonal(), force.on_center / space_->volume(),
                     coefficients);
  f.head(space_->n_unknowns()) += coefficients;
}

void BodyContact::add_force(const Eigen::VectorXd& q, Eigen::VectorXd& f) const {
  if (is_affine()) {
    loads::AffineForce force;
    for (const loads::Plane& plane : planes_) affine_contact(plane, q).add_force(force);
    return spread(force, f);
  }
  if (!may_touch(q)) return;
  const Field x = positions(q);
  Field force(x.size(), 0.0);
  for (const loads::Plane& plane : planes_)
    for (std::size_t p = 0; p < places_.size(); ++p)
      if (const double d = -plane.height(at(x, places_[p])); d > 0)
        add_at(force, places_[p], weights_[p] * plane.stiffness * d * plane.normal);
  spread(force, f);
}

void BodyContact::add_force_rate(const Eigen::VectorXd& q, const Eigen::VectorXd& u, Eigen::VectorXd& f) const {
  if (is_affine()) {
    loads::AffineForce rate;
    const auto du = u.head(space_->n_unknowns());
    for (const loads::Plane& plane : planes_)
      affine_contact(plane, q).add_force_rate(space_->affine_part(du), space_->mean(du), rate);
    return spread(rate, f);
  }
  if (!may_touch(q)) return;
  const Field x = positions(q), du = positions(u);
  Field rate(x.size(), 0.0);
  for (const loads::Plane& plane : planes_)
    for (std::size_t p = 0; p < places_.size(); ++p)
      if (plane.height(at(x, places_[p])) < 0)
        add_at(rate, places_[p], -weights_[p] * plane.stiffness * plane.normal.dot(at(du, places_[p])) * plane.normal);
  spread(rate, f);
}

double BodyContact::add_damping(const Eigen::VectorXd& q, const Eigen::VectorXd& v, Eigen::VectorXd& f) const {
  double power = 0;
  if (is_affine()) {
    loads::AffineForce force;
    const auto u = v.head(space_->n_unknowns());
    for (const loads::Plane& plane : planes_)
      power += affine_contact(plane, q).add_damping(space_->affine_part(u), space_->mean(u), force);
    spread(force, f);
    return power;
  }
  if (!planes_.damped() || !may_touch(q)) return 0;
  const Field x = positions(q), u = positions(v);
  Field force(x.size(), 0.0);
  for (const loads::Plane& plane : planes_)
    for (std::size_t p = 0; p < places_.size(); ++p) {
      const double d = -plane.height(at(x, places_[p]));
      if (d <= 0) continue;
      const double rate = -plane.normal.dot(at(u, places_[p])), c = weights_[p] * plane.stiffness * plane.damping * d;
      add_at(force, places_[p], c * rate * plane.normal);
      power += space_->n_mirrors() * c * rate * rate;
    }
  spread(force, f);
  return power;
}

void BodyContact::add_holding_force(const Eigen::VectorXd& u, Eigen::VectorXd& f) const {
  const double k = planes_.stiffness_of_all();
  if (is_affine()) {
    const double area = 4 * std::numbers::pi;
    const auto x = u.head(space_->n_unknowns());
    return spread({-k * area / 3 * space_->affine_part(x) * S_ * S_, -k * area * space_->mean(x)}, f);
  }
  const Field x = positions(u);
  Field force(x.size(), 0.0);
  for (std::size_t p = 0; p < places_.size(); ++p) add_at(force, places_[p], -k * weights_[p] * at(x, places_[p]));
  spread(force, f);
}

}  // namespace pseudorigid::polynomial
