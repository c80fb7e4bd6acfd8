#include "continuum/mesh/surface_interpolation.h"

#include <deal.II/base/quadrature_lib.h>

namespace pseudorigid::continuum {
namespace {

using Eigen::MatrixXd;

/// A matrix with the values of one component at the n × n points of one face. Row a and column b belong to point a
/// along ξ_p and point b along ξ_q.
auto on_face(std::vector<double>& component, std::size_t face, Eigen::Index n) {
  return Eigen::Map<MatrixXd>(component.data() + face * n * n, n, n);
}
auto on_face(const std::vector<double>& component, std::size_t face, Eigen::Index n) {
  return Eigen::Map<const MatrixXd>(component.data() + face * n * n, n, n);
}

SurfaceInterpolation::Field field_of(std::size_t n_points) {
  const std::vector<double> component(n_points);
  return {component, component, component};
}

}  // namespace

SurfaceInterpolation::SurfaceInterpolation(const BallSpace& space, int n_points) {
  const ReferenceCell& ref = space.reference_cell();
  const dealii::QGauss<1> rule(static_cast<unsigned int>(n_points));
  values_.resize(n_points, ref.n);
  derivatives_.resize(n_points, ref.n);
  for (int p = 0; p < n_points; ++p)
    for (int i = 0; i < ref.n; ++i) {
      const double xi = rule.point(static_cast<unsigned int>(p))[0];
      values_(p, i) = lagrange(ref.nodes, i, xi);
      derivatives_(p, i) = lagrange_derivative(ref.nodes, i, xi);
    }
  for (const CellFace& face : free_surface(space)) {
    std::vector<unsigned int>& nodes = face_nodes_.emplace_back();
    for (const int node : nodes_of(face, ref.n)) nodes.push_back(space.cell_nodes(face.cell)[node]);
    for (const double w_q : rule.get_weights())
      for (const double w_p : rule.get_weights()) weights_.push_back(face.end == 1 ? w_p * w_q : -w_p * w_q);
  }
}

// `lazyProduct` avoids Eigen's algorithm for large matrices, whose preparation takes longer than one of these small
// products.
SurfaceInterpolation::Jets SurfaceInterpolation::jets(const Vector& u) const {
  const Eigen::Index n = values_.cols(), m = values_.rows();
  Jets jets{field_of(n_points()), field_of(n_points()), field_of(n_points())};
  MatrixXd nodal(n, n), value(m, n), by_p(m, n);
  for (std::size_t face = 0; face < face_nodes_.size(); ++face)
    for (int c = 0; c < 3; ++c) {
      for (Eigen::Index k = 0; k < n * n; ++k) nodal(k) = u.local_element(3 * face_nodes_[face][k] + c);
      value.noalias() = values_.lazyProduct(nodal);
      by_p.noalias() = derivatives_.lazyProduct(nodal);
      on_face(jets.u[c], face, m).noalias() = value.lazyProduct(values_.transpose());
      on_face(jets.by_p[c], face, m).noalias() = by_p.lazyProduct(values_.transpose());
      on_face(jets.by_q[c], face, m).noalias() = value.lazyProduct(derivatives_.transpose());
    }
  return jets;
}

void SurfaceInterpolation::subtract_derivative(const Jets& by_jets, Vector& f) const {
  const Eigen::Index n = values_.cols(), m = values_.rows();
  MatrixXd nodal(n, n), by_value(m, n), by_p(m, n);
  for (std::size_t face = 0; face < face_nodes_.size(); ++face)
    for (int c = 0; c < 3; ++c) {
      by_value.noalias() = on_face(by_jets.u[c], face, m).lazyProduct(values_);
      by_value.noalias() += on_face(by_jets.by_q[c], face, m).lazyProduct(derivatives_);
      by_p.noalias() = on_face(by_jets.by_p[c], face, m).lazyProduct(values_);
      nodal.noalias() = values_.transpose().lazyProduct(by_value);
      nodal.noalias() += derivatives_.transpose().lazyProduct(by_p);
      for (Eigen::Index k = 0; k < n * n; ++k) f.local_element(3 * face_nodes_[face][k] + c) -= nodal(k);
    }
}

}  // namespace pseudorigid::continuum
