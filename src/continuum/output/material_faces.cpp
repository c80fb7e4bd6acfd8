#include "continuum/output/material_faces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "continuum/kernels/node_gradients.h"
#include "continuum/parallel/gather.h"
#include "continuum/parallel/ghost_values.h"

namespace pseudorigid::continuum {
namespace {

/// Returns the number 1, 2 or 3 of the coordinate plane x_1 = 0, x_2 = 0 or x_3 = 0 that contains the given nodes of a
/// cell. The result is empty if there is no such plane, or if the cell is on the negative side of the plane. Each face
/// in a plane is therefore found once.
std::optional<int> coordinate_plane(const Eigen::Matrix3Xd& X, const std::vector<int>& nodes) {
  constexpr double round_off = 1e-10;
  for (int d = 0; d < 3; ++d) {
    const bool on_plane = std::all_of(nodes.begin(), nodes.end(), [&](int i) { return std::abs(X(d, i)) < round_off; });
    if (on_plane && X.row(d).mean() > 0) return d + 1;
  }
  return std::nullopt;
}

/// Approximate number of squares of all lattices on the whole ball. With more squares, outlines are smoother and the
/// report is larger. The number m of intervals per direction is between 1 and largest_m.
constexpr double wanted_squares = 1700;
constexpr int largest_m = 6;

}  // namespace

MaterialFaces::MaterialFaces(const BallSpace& space) : space_(space) {
  find_faces();
  choose_lattice();
}

void MaterialFaces::find_faces() {
  visit_faces(space_, [&](const CellFace& face, const auto& cell, bool on_surface) {
    const Eigen::Matrix3Xd X = nodal_values(space_, space_.reference_positions(), face.cell);
    const std::optional<int> plane = on_surface ? 0 : coordinate_plane(X, nodes_of(face, space_.reference_cell().n));
    if (plane) faces_.push_back({face, *plane, 6 * space_.mesh().global_number(cell) + face.number()});
  });
  n_faces_ = std::lround(sum_over_ranks(static_cast<double>(faces_.size()), space_.communicator()));
}

void MaterialFaces::choose_lattice() {
  const double n_on_ball = static_cast<double>(n_faces_) * space_.mesh().sector().n_images();
  m_ = std::clamp(static_cast<int>(std::sqrt(wanted_squares / n_on_ball)), 1, largest_m);
  for (int a = 0; a <= m_; ++a)
    for (std::size_t i = 0; i < space_.reference_cell().nodes.size(); ++i)
      interpolate_.push_back(lagrange(space_.reference_cell().nodes, i, static_cast<double>(a) / m_));
}

Eigen::Matrix3Xd MaterialFaces::lattice(const Vector& x, const Face& face) const {
  const int n = space_.reference_cell().n;
  const Eigen::Matrix3Xd of_cell = nodal_values(space_, x, face.place.cell);
  const std::vector<int> nodes = nodes_of(face.place, n);
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, (m_ + 1) * (m_ + 1));
  for (int b = 0; b <= m_; ++b)
    for (int a = 0; a <= m_; ++a)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          points.col(b * (m_ + 1) + a) +=
              interpolate_[a * n + i] * interpolate_[b * n + j] * of_cell.col(nodes[j * n + i]);
  return points;
}

std::vector<double> MaterialFaces::own_rows(const Vector& position) const {
  const GhostValues ghosts(position);
  std::vector<double> rows;
  for (const Face& face : faces_) {
    const Eigen::Matrix3Xd X = lattice(space_.reference_positions(), face), x = lattice(position, face);
    for (int k = 0; k < X.cols(); ++k)
      rows.insert(rows.end(), {static_cast<double>(face.key), static_cast<double>(face.plane), X(0, k), X(1, k),
                               X(2, k), x(0, k), x(1, k), x(2, k)});
  }
  return rows;
}

std::vector<std::vector<double>> MaterialFaces::rows(const Vector& position) const {
  std::vector<std::vector<double>> all;
  for (const std::vector<double>& rows : gather(space_.communicator(), own_rows(position)))
    for (auto row = rows.begin(); row != rows.end(); row += n_columns) all.emplace_back(row, row + n_columns);
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
  const std::size_t n_on_face = (m_ + 1) * (m_ + 1);
  for (std::size_t k = 0; k < all.size(); ++k) all[k][0] = static_cast<double>(k / n_on_face + 1);
  return all;
}

}  // namespace pseudorigid::continuum
