#include "continuum/mesh/ball_mesh.h"

#include <deal.II/base/geometry_info.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {
namespace {

using Corner = std::array<double, 3>;
using CoarseCell = std::array<Corner, 8>;

/// The nonzero coordinates of the corners of the central block, for corners on an axis, on a diagonal of a coordinate
/// plane, and on the space diagonal. The values affect only the shapes of the cells: the map X(ξ) of ball_mesh.h gives
/// an exact sphere for all values.
constexpr double block_axis = 0.528, block_face = 0.4533, block_corner = 0.3752;

/// Returns a corner of the block, or its radial projection onto the sphere if `on_sphere` is true. bits[i] is 1 if
/// coordinate i of the corner is not 0.
Corner corner(const std::array<int, 3>& bits, bool on_sphere) {
  const int n_bits = bits[0] + bits[1] + bits[2];
  const double block[] = {0, block_axis, block_face, block_corner};
  const double length = on_sphere ? 1 / std::sqrt(static_cast<double>(n_bits)) : block[n_bits];
  return {length * bits[0], length * bits[1], length * bits[2]};
}

/// The coarse cells of the octant x_i ≥ 0. The first cell is the block. For each axis, the cell between the block and
/// the sphere follows.
std::array<CoarseCell, 4> octant() {
  std::array<CoarseCell, 4> cells;
  for (int v = 0; v < 8; ++v) cells[0][v] = corner({v & 1, v >> 1 & 1, v >> 2 & 1}, false);
  for (int axis = 0; axis < 3; ++axis)
    for (int v = 0; v < 8; ++v) {
      std::array<int, 3> bits{};
      bits[axis] = 1;
      bits[(axis + 1) % 3] = v >> 1 & 1;
      bits[(axis + 2) % 3] = v >> 2 & 1;
      cells[1 + axis][v] = corner(bits, v & 1);  // the first local direction is outwards
    }
  return cells;
}

/// The mirror image of a cell under the reflections x_d ↦ −x_d for each d with mirrored[d] = true. After an odd number
/// of reflections the first local direction is reversed, so that the cell remains right-handed.
CoarseCell image(const CoarseCell& cell, const std::array<bool, 3>& mirrored) {
  const bool odd = (mirrored[0] + mirrored[1] + mirrored[2]) % 2;
  CoarseCell result;
  for (int v = 0; v < 8; ++v) {
    result[v] = cell[odd ? v ^ 1 : v];
    for (int d = 0; d < 3; ++d)
      if (mirrored[d] && result[v][d] != 0) result[v][d] = -result[v][d];
  }
  return result;
}

/// The coarse mesh of a sector, which consists of images of the octant. Images share the vertices on their common
/// faces.
CoarseMesh sector_of_ball(const Sector& sector) {
  CoarseMesh mesh;
  std::map<Corner, unsigned int> numbers;
  const auto number = [&](const Corner& V) {
    const auto [entry, is_new] = numbers.try_emplace(V, mesh.vertices.size());
    if (is_new) mesh.vertices.emplace_back(V[0], V[1], V[2]);
    return entry->second;
  };
  for (int bits = 0; bits < 8; ++bits) {
    const std::array<bool, 3> mirrored{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
    bool wanted = true;
    for (int d = 0; d < 3; ++d) wanted = wanted && !(mirrored[d] && sector.reflect[d]);
    if (!wanted) continue;
    for (const CoarseCell& cell : octant()) {
      const CoarseCell corners = image(cell, mirrored);
      auto& numbered = mesh.cells.emplace_back();
      for (int v = 0; v < 8; ++v) numbered[v] = number(corners[v]);
    }
  }
  return mesh;
}

/// The point of the sphere with the equiangular coordinates y, which must satisfy |y|_∞ = 1. The angle of coordinate d
/// is π/4 y_d.
dealii::Point<3> onto_sphere(const dealii::Point<3>& y) {
  dealii::Point<3> direction;
  for (unsigned int d = 0; d < 3; ++d) direction[d] = std::tan(std::numbers::pi / 4 * y[d]);
  return direction / direction.norm();
}

/// True for vertices on the sphere, which have the distance 1 from the centre. The vertices of the block have at most
/// the distance √3 block_corner = 0.65.
bool is_on_sphere(const dealii::Point<3>& V) { return V.norm_square() > 0.999; }

/// The position X(ξ) in a coarse cell of the ball with these vertices, by the formula in the opening comment of
/// ball_mesh.h.
dealii::Point<3> transfinite(const std::array<dealii::Point<3>, 8>& vertices, const dealii::Point<3>& xi) {
  dealii::Point<3> inside, cube;
  double s = 0;
  for (unsigned int v = 0; v < 8; ++v) {
    const dealii::Point<3>& V = vertices[v];
    const double N = dealii::GeometryInfo<3>::d_linear_shape_function(xi, v);
    if (is_on_sphere(V)) {
      cube += N / std::max({std::abs(V[0]), std::abs(V[1]), std::abs(V[2])}) * V;
      s += N;
    } else
      inside += N * V;
  }
  return s > 0 ? inside + s * onto_sphere(cube / s) : inside;
}

dealii::Point<3> trilinear(const std::array<dealii::Point<3>, 8>& vertices, const dealii::Point<3>& xi) {
  dealii::Point<3> X;
  for (unsigned int v = 0; v < 8; ++v) X += dealii::GeometryInfo<3>::d_linear_shape_function(xi, v) * vertices[v];
  return X;
}

/// The end, 0 or 1, of a local direction of a coarse cell at which a grading makes cells small. The result is −1 if the
/// direction is not graded. In an outward direction, the small cells are at the sphere. In a direction that begins on a
/// plane x_c = 0 through the poles, they are at this plane. A direction along the axis of the poles is not graded.
int small_end(const std::array<dealii::Point<3>, 8>& vertices, unsigned int direction, unsigned int axis) {
  const dealii::Point<3>&a = vertices[0], &b = vertices[1U << direction];
  if (is_on_sphere(a) != is_on_sphere(b)) return is_on_sphere(b) ? 1 : 0;
  for (unsigned int c = 0; c < 3; ++c)
    if ((a[c] == 0) != (b[c] == 0)) return c == axis ? -1 : (a[c] == 0 ? 0 : 1);
  return -1;
}

/// Returns the exponent β of a grading with the factor g = `size`, 0 < g < 1, which satisfies β/(exp β − 1) = g.
/// Bisection on (0, 100) finds β, because the left side decreases with β.
double growth_of(double size) {
  double least = 0, most = 100;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (least + most);
    (middle / std::expm1(middle) > size ? least : most) = middle;
  }
  return 0.5 * (least + most);
}

/// Returns an empty mesh. For several ranks it is a mesh of p4est, which is distributed. For one rank the mesh does not
/// use p4est, because p4est requires MPI.
std::unique_ptr<dealii::Triangulation<3>> empty_triangulation(MPI_Comm communicator) {
  if (n_ranks(communicator) > 1) return std::make_unique<dealii::parallel::distributed::Triangulation<3>>(communicator);
  return std::make_unique<dealii::Triangulation<3>>();
}

/// Sets the ids of the boundary faces of the coarse mesh: i in a symmetry plane x_i = 0, and `surface_id` elsewhere.
void mark_boundary(dealii::Triangulation<3>& coarse, const Sector& sector) {
  for (const auto& cell : coarse.cell_iterators_on_level(0))
    for (const auto& face : cell->face_iterators()) {
      if (!face->at_boundary()) continue;
      dealii::types::boundary_id id = BallMesh::surface_id;
      for (unsigned int d = 0; d < 3; ++d) {
        bool in_plane = sector.reflect[d];
        for (unsigned int v = 0; v < 4; ++v) in_plane = in_plane && face->vertex(v)[d] == 0;
        if (in_plane) id = d;
      }
      face->set_boundary_id(id);
    }
}

/// Number of the coarse cell that contains a cell, in the order in which the mesh was created. The CellId of deal.II
/// has another number for this cell if p4est has changed the order of the coarse cells.
int coarse_index(dealii::Triangulation<3>::cell_iterator cell) {
  while (cell->level() > 0) cell = cell->parent();
  return cell->index();
}

}  // namespace

BallMesh::BallMesh(const Sector& sector, int n_refinements, MPI_Comm communicator, const Grading& grading)
    : BallMesh(sector, sector_of_ball(sector), true, n_refinements, communicator) {
  if (grading.size == 1) return;
  growth_ = growth_of(grading.size);
  for (const auto& vertices : coarse_vertices_) {
    auto& ends = small_ends_.emplace_back();
    for (unsigned int d = 0; d < 3; ++d) ends[d] = small_end(vertices, d, static_cast<unsigned int>(grading.axis));
  }
}

BallMesh::BallMesh(const CoarseMesh& body, int n_refinements, MPI_Comm communicator)
    : BallMesh(Sector{}, body, false, n_refinements, communicator) {}

BallMesh::BallMesh(const Sector& sector, const CoarseMesh& coarse, bool on_sphere, int n_refinements,
                   MPI_Comm communicator)
    : sector_(sector), on_sphere_(on_sphere), triangulation_(empty_triangulation(communicator)) {
  std::vector<dealii::CellData<3>> cells;
  for (const auto& vertices : coarse.cells)
    std::copy(vertices.begin(), vertices.end(), cells.emplace_back().vertices.begin());
  dealii::GridTools::consistently_order_cells(cells);
  triangulation_->create_triangulation(coarse.vertices, cells, {});
  for (const auto& cell : cells) {
    auto& corners = coarse_vertices_.emplace_back();
    for (unsigned int v = 0; v < 8; ++v) corners[v] = coarse.vertices[cell.vertices[v]];
  }
  mark_boundary(*triangulation_, sector);
  triangulation_->refine_global(n_refinements);
}

std::size_t BallMesh::global_number(const dealii::Triangulation<3>::cell_iterator& cell) const {
  const dealii::CellId id = cell->id();
  std::size_t number = coarse_index(cell);
  for (const auto child : id.get_child_indices()) number = 8 * number + child;
  return number;
}

dealii::Point<3> BallMesh::position(const dealii::Triangulation<3>::cell_iterator& cell,
                                    const dealii::Point<3>& xi) const {
  const dealii::CellId id = cell->id();
  dealii::Point<3> coarse_xi = xi;
  const auto children = id.get_child_indices();
  for (std::size_t level = children.size(); level-- > 0;)
    for (unsigned int d = 0; d < 3; ++d) coarse_xi[d] = 0.5 * (coarse_xi[d] + (children[level] >> d & 1));
  if (!small_ends_.empty())
    for (unsigned int d = 0; d < 3; ++d) {
      double& x = coarse_xi[d];
      if (x == 0 || x == 1) continue;  // faces on the sphere and on symmetry planes remain exact
      const int end = small_ends_[coarse_index(cell)][d];
      if (end == 0) x = std::expm1(growth_ * x) / std::expm1(growth_);
      if (end == 1) x = 1 - std::expm1(growth_ * (1 - x)) / std::expm1(growth_);
    }
  const auto& vertices = coarse_vertices_[coarse_index(cell)];
  return on_sphere_ ? transfinite(vertices, coarse_xi) : trilinear(vertices, coarse_xi);
}

}  // namespace pseudorigid::continuum
