#include "continuum/modes/linear_problem.h"

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <span>

#include "continuum/modes/parity_sector.h"
#include "continuum/modes/surface_harmonics.h"

namespace pseudorigid::continuum {
namespace {

/// The nodes on the free surface. A node of several faces is repeated.
std::vector<unsigned int> nodes_at_surface(const BallSpace& space) {
  std::vector<unsigned int> nodes;
  for (const CellFace& face : free_surface(space))
    for (const int local : nodes_of(face, space.reference_cell().n))
      nodes.push_back(space.cell_nodes(face.cell)[static_cast<std::size_t>(local)]);
  return nodes;
}

}  // namespace

void LinearProblem::set_constraint(const CellKernels& kernels, const Vector& x) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  constraint.clear();
  kernels.constraint_rows(x, [&](unsigned int, std::span<const double> rows) {
    constraint.emplace_back(Eigen::Map<const RowMajor>(rows.data(), space.n_pressure(), 3 * space.nodes_per_cell()));
  });
}

void LinearProblem::set_stiffness(const std::function<Eigen::MatrixXd(unsigned int cell)>& of_cell) {
  stiffness.clear();
  std::vector<bool> has_cell(space.n_nodes(), false);
  is_shared.assign(space.n_nodes(), false);
  for (unsigned int cell = 0; cell < space.n_cells(); ++cell) {
    stiffness.push_back(of_cell(cell));
    for (const unsigned int node : space.cell_nodes(cell)) {
      if (has_cell[node]) is_shared[node] = true;
      has_cell[node] = true;
    }
  }
}

void LinearProblem::couple_surface() {
  for (const unsigned int node : nodes_at_surface(space)) is_shared[node] = true;
}

std::vector<Eigen::Index> LinearProblem::unknowns_at_surface(const ParitySector& sector) const {
  Vector marks = space.make_vector();
  for (const unsigned int node : nodes_at_surface(space))
    for (unsigned int c = 0; c < 3; ++c) marks.local_element(3 * node + c) = 1;
  const Eigen::VectorXd of_unknowns = sector.entries_of(marks);
  std::vector<Eigen::Index> indices;
  for (Eigen::Index i = 0; i < of_unknowns.size(); ++i)
    if (of_unknowns[i] == 1) indices.push_back(i);
  return indices;
}

void LinearProblem::add_springs(const std::vector<FaceSprings>& springs) {
  for (const FaceSprings& of_face : springs)
    stiffness[of_face.cell](of_face.places, of_face.places) += of_face.rows.transpose() * of_face.rows;
}

std::vector<FaceSprings> springs_at_surface(const BallSpace& space,
                                            const std::function<Eigen::Vector3d(const FacePoint& point)>& along) {
  std::vector<FaceSprings> springs;
  for (const CellFace& face : free_surface(space)) {
    const auto& nodes = space.cell_nodes(face.cell);
    FaceSprings of_face{face.cell, {}, {}};
    std::map<unsigned int, Eigen::Index> first;  // the first entry of each node in a row
    for (const int local : nodes_of(face, space.reference_cell().n)) {
      first[nodes[static_cast<std::size_t>(local)]] = static_cast<Eigen::Index>(of_face.places.size());
      for (int c = 0; c < 3; ++c) of_face.places.push_back(3 * local + c);
    }
    const auto points = harmonic_quadrature(space, face);
    of_face.rows.setZero(static_cast<Eigen::Index>(points.size()), static_cast<Eigen::Index>(of_face.places.size()));
    Eigen::Index row = 0;
    for (const FacePoint& point : points) {
      const Eigen::Vector3d spring = std::sqrt(point.weight) * along(point);
      for (const FacePoint::Node& n : point.nodes)
        of_face.rows.row(row).segment<3>(first.at(n.node)) += n.value * spring;
      ++row;
    }
    springs.push_back(std::move(of_face));
  }
  return springs;
}

}  // namespace pseudorigid::continuum
