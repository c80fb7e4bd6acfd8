#include "continuum/mesh/surface_faces.h"

#include <deal.II/base/quadrature_lib.h>

#include <array>

namespace pseudorigid::continuum {

std::vector<CellFace> free_surface(const BallSpace& space) {
  std::vector<CellFace> faces;
  visit_faces(space, [&](const CellFace& face, const auto&, bool on_surface) {
    if (on_surface) faces.push_back(face);
  });
  return faces;
}

std::vector<int> nodes_of(const CellFace& face, int n) {
  const std::array<int, 3> stride{1, n, n * n};
  const int first = face.end * (n - 1) * stride[face.direction];
  std::vector<int> nodes;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      nodes.push_back(first + i * stride[(face.direction + 1) % 3] + j * stride[(face.direction + 2) % 3]);
  return nodes;
}

namespace {

Eigen::Vector3d at_node(const Vector& u, unsigned int node) {
  return {u.local_element(3 * node), u.local_element(3 * node + 1), u.local_element(3 * node + 2)};
}

}  // namespace

Eigen::Vector3d FacePoint::value(const Vector& u) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Node& n : nodes) sum += n.value * at_node(u, n.node);
  return sum;
}

FacePoint::Jet FacePoint::jet(const Vector& u) const {
  Jet jet{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  for (const Node& n : nodes) {
    const Eigen::Vector3d u_node = at_node(u, n.node);
    jet.u += n.value * u_node;
    jet.by_p += n.by_p * u_node;
    jet.by_q += n.by_q * u_node;
  }
  return jet;
}

std::vector<FacePoint> quadrature_on(const BallSpace& space, const CellFace& face, int n_points) {
  const ReferenceCell& ref = space.reference_cell();
  const int n = ref.n;
  const dealii::QGauss<1> rule(static_cast<unsigned int>(n_points));
  Eigen::MatrixXd values(n_points, n), derivatives(n_points, n);
  for (int p = 0; p < n_points; ++p)
    for (int i = 0; i < n; ++i) {
      const double xi = rule.point(static_cast<unsigned int>(p))[0];
      values(p, i) = lagrange(ref.nodes, i, xi);
      derivatives(p, i) = lagrange_derivative(ref.nodes, i, xi);
    }
  const std::vector<int> nodes = nodes_of(face, n);
  std::vector<FacePoint> points;
  for (int p = 0; p < n_points; ++p)
    for (int q = 0; q < n_points; ++q) {
      FacePoint& point = points.emplace_back();
      point.weight = rule.weight(static_cast<unsigned int>(p)) * rule.weight(static_cast<unsigned int>(q));
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          point.nodes.push_back({space.cell_nodes(face.cell)[nodes[j * n + i]], values(p, i) * values(q, j),
                                 derivatives(p, i) * values(q, j), values(p, i) * derivatives(q, j)});
    }
  return points;
}

}  // namespace pseudorigid::continuum
