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
  double reach = -affine_contact(plane, q).contact().height;  // depth of the affine part behind the plane
  for (const Block& block : space_->blocks())
    for (int k = 0; k < block.n(); ++k)
      reach += std::abs(plane.normal[block.component] * q[block.offset + k]) * largest_[block.offset + k];
  return reach > 0;
}

bool BodyContact::may_touch(const loads::Planes& planes, const Eigen::VectorXd& q) const {
  return std::any_of(planes.begin(), planes.end(), [&](const loads::Plane& plane) { return may_touch(plane, q); });
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

template <class Visit>
void BodyContact::for_touching_points(const loads::Planes& planes, const Field& x, Visit&& visit) const {
  for (const loads::Plane& plane : planes)
    for (std::size_t p = 0; p < places_.size(); ++p)
      if (const double d = -plane.height(at(x, places_[p])); d > 0) visit(plane, places_[p], weights_[p], d);
}

std::vector<loads::PlaneContact> BodyContact::of_points(const loads::Planes& planes, const Field& x) const {
  std::vector<loads::PlaneContact> contacts(planes.size());
  for (std::size_t j = 0; j < planes.size(); ++j)
    for (std::size_t p = 0; p < places_.size(); ++p) contacts[j].add(planes[j], at(x, places_[p]), weights_[p]);
  return contacts;
}

loads::Contact BodyContact::contact(double t, const Eigen::VectorXd& q) const {
  const loads::Planes planes = planes_.at(t);
  if (!is_affine()) return summary(planes, of_whole_body(planes, of_points(planes, positions(q)), space_->reflect()));
  std::vector<loads::PlaneContact> contacts;
  for (const loads::Plane& plane : planes) contacts.push_back(affine_contact(plane, q).contact());
  return summary(planes, contacts);
}

/// Adds the generalised force of the forces `by_point` to f. `by_point` has a force at each point of the computed
/// sector. The coefficients q of f describe the whole body. Therefore the forces are multiplied by the number of copies
/// of the sector. After the call, the values in `by_point` are not defined.
void BodyContact::spread(Field& by_point, Eigen::VectorXd& f) const {
  for (double& value : by_point) value *= space_->n_mirrors();
  tables_.add_transposed(space_->blocks(), 3, by_point.data(), f.data());
}

/// Adds the generalised force of an affine force to f. The generalised force follows from the coefficients of x = c + A
/// X, which are c √Vol and A_ij √E₀_j. Vol is the volume, and the E₀_j are the diagonal entries of the inertia ∫ρXXᵀ
/// dX.
void BodyContact::spread(const loads::AffineForce& force, Eigen::VectorXd& f) const {
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(space_->n_unknowns());
  space_->set_affine(force.on_Q * space_->inertia().cwiseInverse().asDiagonal(), force.on_center / space_->volume(),
                     coefficients);
  f.head(space_->n_unknowns()) += coefficients;
}

double BodyContact::add_force(double t, const Eigen::VectorXd& q, Eigen::VectorXd& f) const {
  const loads::Planes planes = planes_.at(t);
  double given = 0;
  if (is_affine()) {
    loads::AffineForce force;
    for (const loads::Plane& plane : planes) {
      const loads::EllipsoidContact contact = affine_contact(plane, q);
      contact.add_force(force);
      given += contact.given();
    }
    spread(force, f);
    return given;
  }
  if (!may_touch(planes, q)) return given;
  const Field x = positions(q);
  Field force(x.size(), 0.0);
  for_touching_points(planes, x, [&](const loads::Plane& plane, std::size_t place, double weight, double d) {
    add_at(force, place, weight * plane.stiffness * d * plane.normal);
    given += space_->n_mirrors() * weight * plane.stiffness * d * plane.speed;
  });
  spread(force, f);
  return given;
}

void BodyContact::add_force_rate(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& u,
                                 Eigen::VectorXd& f) const {
  const loads::Planes planes = planes_.at(t);
  if (is_affine()) {
    loads::AffineForce rate;
    const auto du = u.head(space_->n_unknowns());
    for (const loads::Plane& plane : planes)
      affine_contact(plane, q).add_force_rate(space_->affine_part(du), space_->mean(du), rate);
    return spread(rate, f);
  }
  if (!may_touch(planes, q)) return;
  const Field x = positions(q), du = positions(u);
  Field rate(x.size(), 0.0);
  for_touching_points(planes, x, [&](const loads::Plane& plane, std::size_t place, double weight, double) {
    add_at(rate, place, -weight * plane.stiffness * plane.normal.dot(at(du, place)) * plane.normal);
  });
  spread(rate, f);
}

loads::ContactPower BodyContact::add_dissipation(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                                 Eigen::VectorXd& f) const {
  const loads::Planes planes = planes_.at(t);
  loads::ContactPower power = add_plane_damping(planes, q, v, f);
  power.taken += add_friction(planes, q, v, f);
  return power;
}

loads::ContactPower BodyContact::add_plane_damping(const loads::Planes& planes, const Eigen::VectorXd& q,
                                                   const Eigen::VectorXd& u, Eigen::VectorXd& f) const {
  loads::ContactPower power;
  if (is_affine()) {
    loads::AffineForce force;
    const auto du = u.head(space_->n_unknowns());
    for (const loads::Plane& plane : planes)
      power += affine_contact(plane, q).add_damping(space_->affine_part(du), space_->mean(du), force);
    spread(force, f);
    return power;
  }
  if (!planes.damped() || !may_touch(planes, q)) return power;
  const Field x = positions(q), at_points = positions(u);
  Field force(x.size(), 0.0);
  for_touching_points(planes, x, [&](const loads::Plane& plane, std::size_t place, double weight, double d) {
    const double rate = plane.rate(at(at_points, place)), c = weight * plane.stiffness * plane.damping * d;
    add_at(force, place, c * rate * plane.normal);
    power += {.taken = space_->n_mirrors() * c * rate * rate, .given = space_->n_mirrors() * c * rate * plane.speed};
  });
  spread(force, f);
  return power;
}

double BodyContact::add_friction(const loads::Planes& planes, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                 Eigen::VectorXd& f) const {
  double power = 0;
  if (!planes.rough() || !may_touch(planes, q)) return power;
  if (is_affine()) {
    loads::AffineForce force;
    const Eigen::Matrix3d Qdot = space_->affine_part(v.head(space_->n_unknowns()));
    const Eigen::Vector3d cdot = space_->mean(v.head(space_->n_unknowns()));
    for (const loads::Plane& plane : planes)
      power += loads::EllipsoidFriction(affine_contact(plane, q), Qdot, cdot).add_force(force);
    spread(force, f);
    return power;
  }
  const Field x = positions(q), at_points = positions(v);
  Field force(x.size(), 0.0);
  for_touching_points(planes, x, [&](const loads::Plane& plane, std::size_t place, double weight, double d) {
    const loads::Friction friction(plane, at(at_points, place));
    const double pressure = weight * plane.stiffness * d;
    add_at(force, place, friction.traction(pressure));
    power += space_->n_mirrors() * friction.power(pressure);
  });
  spread(force, f);
  return power;
}

void BodyContact::add_damping(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v, const Eigen::VectorXd& u,
                              mechanics::Linearization kind, Eigen::VectorXd& f) const {
  const loads::Planes planes = planes_.stopped_at(t);
  add_plane_damping(planes, q, u, f);
  if (!planes.rough() || !may_touch(planes, q)) return;
  if (is_affine()) {
    loads::AffineForce change;
    const auto of_v = v.head(space_->n_unknowns()), of_u = u.head(space_->n_unknowns());
    const Eigen::Matrix3d Qdot = space_->affine_part(of_v), dQdot = space_->affine_part(of_u);
    const Eigen::Vector3d cdot = space_->mean(of_v), dcdot = space_->mean(of_u);
    for (const loads::Plane& plane : planes)
      loads::EllipsoidFriction(affine_contact(plane, q), Qdot, cdot).add_change(dQdot, dcdot, kind, change);
    return spread(change, f);
  }
  const Field x = positions(q), v_at_points = positions(v), u_at_points = positions(u);
  Field change(x.size(), 0.0);
  for_touching_points(planes, x, [&](const loads::Plane& plane, std::size_t place, double weight, double d) {
    const loads::Friction friction(plane, at(v_at_points, place));
    add_at(change, place, friction.change(weight * plane.stiffness * d, at(u_at_points, place), kind));
  });
  spread(change, f);
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
