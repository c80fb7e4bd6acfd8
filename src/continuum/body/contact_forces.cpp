#include "continuum/body/contact_forces.h"

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Dense>
#include <array>

#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/ranks.h"
#include "loads/friction.h"

namespace pseudorigid::continuum {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

Vector3d node_value(const Vector& u, unsigned int node) {
  return {u.local_element(3 * node), u.local_element(3 * node + 1), u.local_element(3 * node + 2)};
}
Vector3d at_point(const std::array<MatrixXd, 3>& field, Eigen::Index p) {
  return {field[0](p), field[1](p), field[2](p)};
}

}  // namespace

int n_contact_points(const BallSpace& space) { return 2 * (static_cast<int>(space.degree()) + 1); }

ContactForces::ContactForces(const loads::Planes& planes, const BallSpace& space, int n_points)
    : planes_(planes), space_(space) {
  const ReferenceCell& ref = space.reference_cell();
  const dealii::QGauss<1> rule(static_cast<unsigned int>(n_points));
  values_.resize(n_points, ref.n);
  MatrixXd derivatives(n_points, ref.n);
  for (int p = 0; p < n_points; ++p)
    for (int i = 0; i < ref.n; ++i) {
      const double xi = rule.point(static_cast<unsigned int>(p))[0];
      values_(p, i) = lagrange(ref.nodes, i, xi);
      derivatives(p, i) = lagrange_derivative(ref.nodes, i, xi);
    }
  lebesgue_ = values_.cwiseAbs().rowwise().sum().maxCoeff();
  const Vector& X = space.reference_positions();
  const GhostValues of_X(X);
  for (const CellFace& cell_face : free_surface(space)) {
    Face& face = faces_.emplace_back();
    for (const int node : nodes_of(cell_face, ref.n)) face.nodes.push_back(space.cell_nodes(cell_face.cell)[node]);
    std::array<MatrixXd, 3> by_p, by_q;
    for (int c = 0; c < 3; ++c) {
      MatrixXd nodal(ref.n, ref.n);
      for (Eigen::Index k = 0; k < nodal.size(); ++k) nodal(k) = X.local_element(3 * face.nodes[k] + c);
      by_p[c] = derivatives * nodal * values_.transpose();
      by_q[c] = values_ * nodal * derivatives.transpose();
    }
    face.weights.resize(n_points, n_points);
    for (int p = 0; p < n_points; ++p)
      for (int q = 0; q < n_points; ++q) {
        const Vector3d a(by_p[0](p, q), by_p[1](p, q), by_p[2](p, q)), b(by_q[0](p, q), by_q[1](p, q), by_q[2](p, q));
        face.weights(p, q) =
            rule.weight(static_cast<unsigned int>(p)) * rule.weight(static_cast<unsigned int>(q)) * a.cross(b).norm();
      }
  }
}

MatrixXd ContactForces::along(const loads::Plane& plane, double offset, const Face& face, const Vector& u) const {
  MatrixXd nodal(values_.cols(), values_.cols());
  for (Eigen::Index k = 0; k < nodal.size(); ++k) nodal(k) = plane.normal.dot(node_value(u, face.nodes[k])) - offset;
  return nodal;
}

bool ContactForces::may_touch(const MatrixXd& heights) const {
  const double least = heights.minCoeff(), most = heights.maxCoeff();
  return 0.5 * (most + least) - 0.5 * lebesgue_ * lebesgue_ * (most - least) < 0;
}

void ContactForces::spread(const MatrixXd& pressures, const Vector3d& normal, const Face& face, Vector& f) const {
  const MatrixXd half = values_.transpose().lazyProduct(pressures), nodal = half.lazyProduct(values_);
  for (Eigen::Index k = 0; k < nodal.size(); ++k)
    for (int c = 0; c < 3; ++c) f.local_element(3 * face.nodes[k] + c) += nodal(k) * normal[c];
}

ContactForces::VectorAtPoints ContactForces::vector_at_points(const Face& face, const Vector& u) const {
  VectorAtPoints field;
  for (int c = 0; c < 3; ++c) field[c] = at_points(along({.normal = Vector3d::Unit(c)}, 0, face, u));
  return field;
}

template <class Visit>
void ContactForces::for_touching_faces(const loads::Plane& plane, const Vector& x, Visit&& visit) const {
  for (const Face& face : faces_) {
    const MatrixXd nodal = along(plane, plane.position, face, x);
    if (!may_touch(nodal)) continue;
    const MatrixXd heights = at_points(nodal);
    if (heights.minCoeff() >= 0) continue;
    visit(face, heights);
  }
}

double ContactForces::add(double t, const Vector& x, Vector& f) const {
  const GhostValues of_x(x);
  double given = 0;
  for (const loads::Plane& at_start : planes_) {
    const loads::Plane plane = at_start.at(t);
    for_touching_faces(plane, x, [&](const Face& face, const MatrixXd& heights) {
      const MatrixXd pressures = -plane.stiffness * face.weights.cwiseProduct(heights.cwiseMin(0));
      if (plane.speed != 0) given += plane.speed * pressures.sum();
      spread(pressures, plane.normal, face, f);
    });
  }
  add_to_owners(f);
  return planes_.moving() ? sum_over_ranks(given, space_.communicator()) : 0;
}

loads::ContactPower ContactForces::add_dissipation(double t, const Vector& x, const Vector& v, Vector& f) const {
  if (!planes_.damped() && !planes_.rough()) return {};
  const GhostValues of_x(x), of_v(v);
  const loads::Planes planes = planes_.at(t);
  loads::ContactPower power = add_plane_damping(planes, x, v, f);
  const auto friction_on = [&](const loads::Plane& plane, const Face& face) {
    return [&, velocities = vector_at_points(face, v)](Eigen::Index p, double pressure) {
      const loads::Friction friction(plane, at_point(velocities, p));
      power.taken += friction.power(pressure);
      return friction.traction(pressure);
    };
  };
  add_tractions(planes, x, friction_on, f);
  add_to_owners(f);
  const auto [taken, given] = sum_over_ranks(std::array{power.taken, power.given}, space_.communicator());
  return {taken, given};
}

loads::ContactPower ContactForces::add_plane_damping(const loads::Planes& planes, const Vector& x, const Vector& u,
                                                     Vector& f) const {
  loads::ContactPower power;
  for (const loads::Plane& plane : planes) {
    if (plane.damping == 0) continue;
    for_touching_faces(plane, x, [&](const Face& face, const MatrixXd& heights) {
      const MatrixXd rates = -at_points(along(plane, plane.speed, face, u));  // rates ḋ of the depths d
      const MatrixXd pressures =
          -plane.stiffness * plane.damping * face.weights.cwiseProduct(heights.cwiseMin(0)).cwiseProduct(rates);
      power += {.taken = pressures.cwiseProduct(rates).sum(), .given = plane.speed * pressures.sum()};
      spread(pressures, plane.normal, face, f);
    });
  }
  return power;
}

template <class TractionOn>
void ContactForces::add_tractions(const loads::Planes& planes, const Vector& x, TractionOn&& traction_on,
                                  Vector& f) const {
  for (const loads::Plane& plane : planes) {
    if (plane.friction == 0) continue;
    for_touching_faces(plane, x, [&](const Face& face, const MatrixXd& heights) {
      const auto traction = traction_on(plane, face);
      VectorAtPoints forces;
      forces.fill(MatrixXd::Zero(heights.rows(), heights.cols()));
      for (Eigen::Index p = 0; p < heights.size(); ++p) {
        if (heights(p) >= 0) continue;
        const Vector3d force = traction(p, -plane.stiffness * face.weights(p) * heights(p));
        for (int c = 0; c < 3; ++c) forces[c](p) = force[c];
      }
      for (int c = 0; c < 3; ++c) spread(forces[c], Vector3d::Unit(c), face, f);
    });
  }
}

void ContactForces::add_damping(double t, const Vector& x, const Vector& v, const Vector& u,
                                mechanics::Linearization kind, Vector& f) const {
  if (!planes_.damped() && !planes_.rough()) return;
  const GhostValues of_x(x), of_v(v), of_u(u);
  const loads::Planes planes = planes_.stopped_at(t);
  add_plane_damping(planes, x, u, f);
  const auto change_on = [&](const loads::Plane& plane, const Face& face) {
    return [&, velocities = vector_at_points(face, v), changes = vector_at_points(face, u)](Eigen::Index p,
                                                                                            double pressure) {
      return loads::Friction(plane, at_point(velocities, p)).change(pressure, at_point(changes, p), kind);
    };
  };
  add_tractions(planes, x, change_on, f);
  add_to_owners(f);
}

void ContactForces::add_holding(const Vector& x, const Vector& x0, Vector& f) const {
  const GhostValues of_x(x), of_x0(x0);
  const double k = planes_.stiffness_of_all();
  for (const Face& face : faces_)
    for (int c = 0; c < 3; ++c) {
      const loads::Plane across{.normal = Vector3d::Unit(c)};
      spread(-k * face.weights.cwiseProduct(at_points(along(across, 0, face, x) - along(across, 0, face, x0))),
             across.normal, face, f);
    }
  add_to_owners(f);
}

loads::Contact ContactForces::contact(double t, const Vector& x) const {
  const GhostValues of_x(x);
  const loads::Planes planes = planes_.at(t);
  std::vector<loads::PlaneContact> contacts(planes_.size());
  for (const Face& face : faces_) {
    const VectorAtPoints positions = vector_at_points(face, x);
    for (std::size_t j = 0; j < planes.size(); ++j)
      for (Eigen::Index p = 0; p < face.weights.size(); ++p)
        contacts[j].add(planes[j], at_point(positions, p), face.weights(p));
  }
  for (loads::PlaneContact& one : contacts) {
    const auto [energy, force, area, spread, x0, x1, x2] = sum_over_ranks(
        std::array{one.energy, one.force, one.area, one.spread, one.moment[0], one.moment[1], one.moment[2]},
        space_.communicator());
    one = {energy, force, area, spread, least_over_ranks(one.height, space_.communicator()), {x0, x1, x2}};
  }
  return summary(planes, of_whole_body(planes, contacts, space_.mesh().sector().reflect));
}

}  // namespace pseudorigid::continuum
