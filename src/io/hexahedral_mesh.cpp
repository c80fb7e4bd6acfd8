#include "io/hexahedral_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "scene/user_error.h"

namespace pseudorigid::io {
namespace {

using Point = HexahedralMesh::Point;
using Face = std::array<unsigned int, 4>;

/// The corners of the six faces of a cell. The corners of a face are in an order around the face. In the coordinates ξ
/// ∈ [0,1]³ of the cell, the faces are ξ₁ = 0, ξ₁ = 1, ξ₂ = 0, ξ₂ = 1, ξ₃ = 0 and ξ₃ = 1.
constexpr std::array<std::array<int, 4>, 6> corners_of_faces{
    {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};

/// The image X in a cell of a point ξ of the cube [0,1]³, and the Jacobian at ξ. The unit of length is the size of the
/// cell (size_of_cell).
struct PointOfCell {
  Point X;          ///< image of ξ, relative to the first corner of the cell
  double jacobian;  ///< determinant det ∂X/∂ξ at ξ
};

/// The size of a cell: the largest distance in a coordinate direction between its first corner and another corner.
double size_of_cell(const HexahedralMesh& mesh, std::size_t cell) {
  const Point& V0 = mesh.vertices[mesh.cells[cell][0]];
  double size = 0;
  for (const unsigned int v : mesh.cells[cell])
    for (int c = 0; c < 3; ++c) size = std::max(size, std::abs(mesh.vertices[v][c] - V0[c]));
  return size;
}

/// The image X(ξ) in a cell and the Jacobian at ξ = `xi`, relative to the first corner and in units of the size of the
/// cell (PointOfCell). Such coordinates avoid round-off if the origin is distant, and overflow if the unit of length is
/// extreme.
PointOfCell at(const HexahedralMesh& mesh, std::size_t cell, const Point& xi) {
  const Point& V0 = mesh.vertices[mesh.cells[cell][0]];
  const double unit = size_of_cell(mesh, cell);
  Point X{};
  double H[3][3] = {};
  for (int i = 0; i < 8; ++i) {
    const Point& V = mesh.vertices[mesh.cells[cell][i]];
    double N[3], dN[3];
    for (int d = 0; d < 3; ++d) {
      N[d] = i >> d & 1 ? xi[d] : 1 - xi[d];
      dN[d] = i >> d & 1 ? 1 : -1;
    }
    for (int c = 0; c < 3; ++c) {
      const double x = (V[c] - V0[c]) / unit;
      X[c] += N[0] * N[1] * N[2] * x;
      H[c][0] += dN[0] * N[1] * N[2] * x;
      H[c][1] += N[0] * dN[1] * N[2] * x;
      H[c][2] += N[0] * N[1] * dN[2] * x;
    }
  }
  double jacobian = 0;
  for (int d = 0; d < 3; ++d)
    jacobian += H[0][d] * (H[1][(d + 1) % 3] * H[2][(d + 2) % 3] - H[1][(d + 2) % 3] * H[2][(d + 1) % 3]);
  return {X, jacobian};
}

/// A lower bound of the Jacobian of a cell in the cube of ξ with the corner ξ₀ = `xi0` and the length `edge`. The
/// Jacobian is quadratic in each ξ_d. The values f at 3³ points therefore determine its Bernstein coefficients. Let f₀,
/// f_½ and f₁ be the values at the beginning, the middle and the end of an edge. The coefficients in this direction are
/// f₀, 2f_½ − (f₀ + f₁)/2 and f₁. The Jacobian at each point is a convex combination of the coefficients, and therefore
/// the least coefficient is a bound.
double least_jacobian(const HexahedralMesh& mesh, std::size_t cell, const Point& xi0, double edge) {
  std::array<double, 27> b;
  for (int i = 0; i < 27; ++i)
    b[i] = at(mesh, cell, {xi0[0] + edge * (i % 3) / 2, xi0[1] + edge * (i / 3 % 3) / 2, xi0[2] + edge * (i / 9) / 2})
               .jacobian;
  for (const int stride : {1, 3, 9})
    for (int i = 0; i < 27; ++i)
      if (i / stride % 3 == 1) b[i] = 2 * b[i] - (b[i - stride] + b[i + stride]) / 2;
  return *std::min_element(b.begin(), b.end());
}

/// Throws UserError unless the Jacobian is positive at every point of every cell. The test uses the lower bound of
/// least_jacobian on each of the eight octants of a cell. The bound is not sharp, so the test also rejects some cells
/// with a small positive Jacobian.
void require_untangled(const HexahedralMesh& mesh) {
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (int part = 0; part < 8; ++part) {
      const Point xi0{0.5 * (part & 1), 0.5 * (part >> 1 & 1), 0.5 * (part >> 2 & 1)};
      const double least = least_jacobian(mesh, cell, xi0, 0.5);
      if (least > 0 && std::isfinite(least)) continue;
      const Point& V = mesh.vertices[mesh.cells[cell][part]];
      throw UserError(
          fmt::format("element {} is tangled or turned inside out near its node {} at ({:.6g}, {:.6g}, {:.6g}): the "
                      "Jacobian of its map must be positive",
                      mesh.cell_names[cell], mesh.vertex_names[mesh.cells[cell][part]], V[0], V[1], V[2]));
    }
}

void require_vertices_used(const HexahedralMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const auto& cell : mesh.cells)
    for (const unsigned int v : cell) used[v] = true;
  if (const auto unused = std::find(used.begin(), used.end(), false); unused != used.end())
    throw UserError(fmt::format("node {} belongs to no hexahedron", mesh.vertex_names[unused - used.begin()]));
}

using CellsOfFaces = std::map<Face, std::vector<std::size_t>>;

Face face_of(const std::array<unsigned int, 8>& cell, int face) {
  Face result;
  for (int i = 0; i < 4; ++i) result[i] = cell[corners_of_faces[face][i]];
  return result;
}

/// The indices of the one or two cells of each face. The key of a face is its sorted vertices. Throws UserError if
/// three cells share a face.
CellsOfFaces cells_of_faces(const HexahedralMesh& mesh) {
  CellsOfFaces cells_of;
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (int f = 0; f < 6; ++f) {
      Face key = face_of(mesh.cells[cell], f);
      std::sort(key.begin(), key.end());
      auto& cells = cells_of[key];
      cells.push_back(cell);
      if (cells.size() > 2)
        throw UserError(fmt::format("the elements {}, {} and {} share a face, which two elements at most can do",
                                    mesh.cell_names[cells[0]], mesh.cell_names[cells[1]], mesh.cell_names[cell]));
    }
  return cells_of;
}

/// Throws UserError if a chain of shared faces does not connect all cells. The connected components are the trees of a
/// union-find forest (`parent`).
void require_one_piece(const HexahedralMesh& mesh, const CellsOfFaces& cells_of) {
  std::vector<std::size_t> parent(mesh.cells.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t cell) {
    while (parent[cell] != cell) cell = parent[cell] = parent[parent[cell]];
    return cell;
  };
  for (const auto& [face, cells] : cells_of)
    if (cells.size() == 2) parent[root(cells[0])] = root(cells[1]);
  for (std::size_t cell = 1; cell < mesh.cells.size(); ++cell)
    if (root(cell) != root(0))
      throw UserError(fmt::format("the body is in several pieces: no chain of shared faces leads from element {} to {}",
                                  mesh.cell_names[0], mesh.cell_names[cell]));
}

/// Two vertices have the same place if their distance is at most this fraction of a reference length. The reference
/// length is the larger of the lengths that shortest_edges returns for the two vertices.
constexpr double same_place = 1e-6;

double distance(const Point& X, const Point& Y) { return std::hypot(X[0] - Y[0], X[1] - Y[1], X[2] - Y[2]); }

/// For each vertex, the length of the shortest edge that ends at the vertex.
std::vector<double> shortest_edges(const HexahedralMesh& mesh) {
  std::vector<double> shortest(mesh.vertices.size(), std::numeric_limits<double>::infinity());
  for (const auto& cell : mesh.cells)
    for (int i = 0; i < 8; ++i)
      for (int d = 0; d < 3; ++d) {
        const unsigned int a = cell[i], b = cell[i ^ 1 << d];
        shortest[a] = std::min(shortest[a], distance(mesh.vertices[a], mesh.vertices[b]));
      }
  return shortest;
}

/// Vertices sorted into cubic boxes, so that a search for near vertices visits few vertices. The length of a box is the
/// largest extent of the mesh in a coordinate direction, divided by the cube root of the number of vertices.
class Places {
 public:
  explicit Places(const HexahedralMesh& mesh) : vertices_(mesh.vertices), low_(vertices_.front()) {
    Point high = low_;
    for (const Point& V : vertices_)
      for (int d = 0; d < 3; ++d) low_[d] = std::min(low_[d], V[d]), high[d] = std::max(high[d], V[d]);
    const double extent = std::max({high[0] - low_[0], high[1] - low_[1], high[2] - low_[2]});
    box_ = extent / std::cbrt(static_cast<double>(vertices_.size()));
  }

  /// Adds a vertex of the mesh to its box. Only added vertices can be found.
  void add(std::size_t vertex) { boxes_[box_of(vertices_[vertex], 0)].push_back(vertex); }

  /// Returns an added vertex for which `is_same(vertex, distance)` is true. The argument `distance` is the distance of
  /// the vertex from X. The search covers all boxes that contain points at most `reach` from X in each coordinate
  /// direction. The result is empty if there is no such vertex.
  template <class IsSame>
  std::optional<std::size_t> find(const Point& X, double reach, const IsSame& is_same) const {
    const Box first = box_of(X, -reach), last = box_of(X, reach);
    for (long i = first[0]; i <= last[0]; ++i)
      for (long j = first[1]; j <= last[1]; ++j)
        for (long k = first[2]; k <= last[2]; ++k)
          if (const auto box = boxes_.find({i, j, k}); box != boxes_.end())
            for (const std::size_t vertex : box->second)
              if (is_same(vertex, distance(X, vertices_[vertex]))) return vertex;
    return std::nullopt;
  }

 private:
  using Box = std::array<long, 3>;
  Box box_of(const Point& X, double shift) const {
    Box box;
    for (int d = 0; d < 3; ++d) box[d] = std::lround(std::floor((X[d] - low_[d] + shift) / box_));
    return box;
  }

  const std::vector<Point>& vertices_;
  Point low_;
  double box_;
  std::map<Box, std::vector<std::size_t>> boxes_;
};

/// Throws UserError if two vertices have the same place (same_place). Returns the vertices sorted into boxes.
Places require_own_places(const HexahedralMesh& mesh) {
  const std::vector<double> shortest = shortest_edges(mesh);
  const double reach = same_place * *std::max_element(shortest.begin(), shortest.end());
  Places places(mesh);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto is_same = [&](std::size_t other, double apart) {
      return apart <= same_place * std::max(shortest[v], shortest[other]);
    };
    if (const auto found = places.find(mesh.vertices[v], reach, is_same))
      throw UserError(fmt::format("the nodes {} and {} are at the same place; neighbours must share their nodes",
                                  mesh.vertex_names[*found], mesh.vertex_names[v]));
    places.add(v);
  }
  return places;
}

/// Throws UserError if two vertices have the same place (same_place). Also throws UserError if a vertex is in the
/// middle of a face that belongs to only one cell, or in the middle of an edge of such a face. Such a hanging node
/// occurs if a divided cell is next to an undivided cell.
void require_conforming(const HexahedralMesh& mesh, const CellsOfFaces& cells_of) {
  const Places places = require_own_places(mesh);
  const auto require_free = [&](const Point& X, double edge, std::size_t cell) {
    const auto is_same = [&](std::size_t, double apart) { return apart <= same_place * edge; };
    if (const auto found = places.find(X, same_place * edge, is_same))
      throw UserError(
          fmt::format("node {} hangs in the middle of a face or an edge of element {}; neighbours must "
                      "share whole faces",
                      mesh.vertex_names[*found], mesh.cell_names[cell]));
  };
  const auto middle = [&](const Point& A, const Point& B) {
    Point X;
    for (int d = 0; d < 3; ++d) X[d] = A[d] + (B[d] - A[d]) / 2;
    return X;
  };
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (int f = 0; f < 6; ++f) {
      const Face face = face_of(mesh.cells[cell], f);
      Face key = face;
      std::sort(key.begin(), key.end());
      if (cells_of.at(key).size() == 2) continue;
      std::array<Point, 4> V;
      for (int i = 0; i < 4; ++i) V[i] = mesh.vertices[face[i]];
      double shortest = std::numeric_limits<double>::infinity();
      for (int i = 0; i < 4; ++i) {
        const Point &A = V[i], &B = V[(i + 1) % 4];
        require_free(middle(A, B), distance(A, B), cell);
        shortest = std::min(shortest, distance(A, B));
      }
      require_free(middle(middle(V[0], V[2]), middle(V[1], V[3])), shortest, cell);
    }
}

}  // namespace

void turn_right_handed(HexahedralMesh& mesh) {
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    if (!(at(mesh, cell, {0.5, 0.5, 0.5}).jacobian < 0)) return;
  for (auto& cell : mesh.cells)
    for (const int i : {0, 2, 4, 6}) std::swap(cell[i], cell[i + 1]);
}

void require_one_body(const HexahedralMesh& mesh) {
  if (mesh.cells.empty()) throw UserError("there is no hexahedron in it");
  require_vertices_used(mesh);
  require_untangled(mesh);
  const CellsOfFaces cells_of = cells_of_faces(mesh);
  require_conforming(mesh, cells_of);
  require_one_piece(mesh, cells_of);
}

MeshSize size_of(const HexahedralMesh& mesh) {
  const Point origin = mesh.vertices.front();
  double unit = 0;
  for (const Point& V : mesh.vertices) unit = std::max(unit, distance(V, origin));
  // Two Gauss points in each direction are exact, because X det ∂X/∂ξ is cubic in each ξ_d.
  const double gauss[] = {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)};
  double volume = 0;
  Point moment{};
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
    const Point& V0 = mesh.vertices[mesh.cells[cell][0]];
    const double size = size_of_cell(mesh, cell) / unit;
    for (int q = 0; q < 8; ++q) {
      const auto [X, jacobian] = at(mesh, cell, {gauss[q & 1], gauss[q >> 1 & 1], gauss[q >> 2 & 1]});
      const double part = jacobian * size * size * size / 8;
      volume += part;
      for (int c = 0; c < 3; ++c) moment[c] += part * ((V0[c] - origin[c]) / unit + X[c] * size);
    }
  }
  MeshSize size{.volume = volume * unit * unit * unit, .center = origin, .radius = 0};
  for (int c = 0; c < 3; ++c) size.center[c] += moment[c] / volume * unit;
  for (const Point& V : mesh.vertices) size.radius = std::max(size.radius, distance(V, size.center));
  return size;
}

}  // namespace pseudorigid::io
