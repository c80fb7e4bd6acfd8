#include "continuum/body/contact_forces.h"

#include <deal.II/base/quadrature_lib.h>

#include <Eigen/Dense>
#include <array>

#include "continuum/parallel/ghost_values.h"
#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

Vector3d node_value(const Vector& u, unsigned int node) {
  return {u.local_element(3 * node), u.local_element(3 * node + 1), u.local_element(3 * node + 2)};
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

void ContactForces::add(const Vector& x, Vector& f) const {
  const GhostValues of_x(x);
  for (const loads::Plane& plane : planes_)
    for (const Face& face : faces_) {
      const MatrixXd nodal = along(plane, plane.position, face, x);
      if (!may_touch(nodal)) continue;
      const MatrixXd heights = at_points(nodal);
      if (heights.minCoeff() >= 0) continue;
      spread(-plane.stiffness * face.weights.cwiseProduct(heights.cwiseMin(0)), plane.normal, face, f);
    }
  add_to_owners(f);
}

double ContactForces::add_damping(const Vector& x, const Vector& v, Vector& f) const {
  if (!planes_.damped()) return 0;
  const GhostValues of_x(x), of_v(v);
  double power = 0;
  for (const loads::Plane& plane : planes_)
    for (const Face& face : faces_) {
      const MatrixXd nodal = along(plane, plane.position, face, x);
      if (plane.damping == 0 || !may_touch(nodal)) continue;
      const MatrixXd rates = -at_points(along(plane, 0, face, v));  // ḋ, the rate of the penetration
      const MatrixXd pressures = -plane.stiffness * plane.damping *
                                 face.weights.cwiseProduct(at_points(nodal).cwiseMin(0)).cwiseProduct(rates);
      power += pressures.cwiseProduct(rates).sum();
      spread(pressures, plane.normal, face, f);
    }
  add_to_owners(f);
  return sum_over_ranks(power, space_.communicator());
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

loads::Contact ContactForces::contact(const Vector& x) const {
  const GhostValues of_x(x);
  std::vector<loads::PlaneContact> contacts(planes_.size());
  for (const Face& face : faces_) {
    std::array<MatrixXd, 3> positions;
    for (int c = 0; c < 3; ++c) positions[c] = at_points(along({.normal = Vector3d::Unit(c)}, 0, face, x));
    for (std::size_t j = 0; j < planes_.size(); ++j)
      for (Eigen::Index p = 0; p < face.weights.size(); ++p)
        contacts[j].add(planes_[j], {positions[0](p), positions[1](p), positions[2](p)}, face.weights(p));
  }
  for (loads::PlaneContact& one : contacts) {
    const auto [energy, force, area, x0, x1, x2] =
        sum_over_ranks(std::array{one.energy, one.force, one.area, one.moment[0], one.moment[1], one.moment[2]},
                       space_.communicator());
    one = {energy, force, area, least_over_ranks(one.height, space_.communicator()), {x0, x1, x2}};
  }
  return summary(planes_, of_whole_body(planes_, contacts, space_.mesh().sector().reflect));
}

}  // namespace pseudorigid::continuum
