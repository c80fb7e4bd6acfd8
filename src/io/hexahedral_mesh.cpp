#include "io/hexahedral_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "scene/user_error.h"

namespace pseudorigid::io {
namespace {

using Point = HexahedralMesh::Point;
using Face = std::array<unsigned int, 4>;

/// Corners of the six faces; neighbours in the list are neighbours on the face.
constexpr std::array<std::array<int, 4>, 6> corners_of_faces{
    {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};

struct PointOfCell {
  Point X;
  double jacobian;  ///< det ∂X/∂ξ
};

PointOfCell at(const HexahedralMesh& mesh, std::size_t cell, const Point& xi) {
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
      X[c] += N[0] * N[1] * N[2] * V[c];
      H[c][0] += dN[0] * N[1] * N[2] * V[c];
      H[c][1] += N[0] * dN[1] * N[2] * V[c];
      H[c][2] += N[0] * N[1] * dN[2] * V[c];
    }
  }
  double jacobian = 0;
  for (int d = 0; d < 3; ++d)
    jacobian += H[0][d] * (H[1][(d + 1) % 3] * H[2][(d + 2) % 3] - H[1][(d + 2) % 3] * H[2][(d + 1) % 3]);
  return {X, jacobian};
}

/// A lower bound of the Jacobian in the cube of this edge at ξ₀. The Jacobian is quadratic in each ξ_d, so its values
/// at 3³ points give its Bernstein coefficients, b = f₀, 2f_½ − (f₀ + f₁)/2, f₁ in each direction, and is a mean of
/// them.
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

/// The Jacobian is positive at every point of every cell: shown on the eighths of a cell, so that a cell is refused
/// only if it is tangled or nearly so.
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

/// Faces by their sorted vertices, with the cells that have them.
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

/// No two vertices share a place, and none lies in the middle of a face or of an edge of the surface, as the hanging
/// nodes of a cell divided beside an undivided one would.
void require_conforming(const HexahedralMesh& mesh, const CellsOfFaces& cells_of) {
  double size = 0;
  for (const Point& V : mesh.vertices)
    for (const double x : V) size = std::max(size, std::abs(x));
  const double grid = 1e-9 * size;
  std::map<std::array<long long, 3>, std::size_t> at_place;
  const auto find = [&](const Point& X) {
    for (int shift = 0; shift < 8; ++shift) {  // the points of the grid around X
      std::array<long long, 3> key;
      for (int d = 0; d < 3; ++d) key[d] = static_cast<long long>(std::floor(X[d] / grid)) + (shift >> d & 1);
      if (const auto found = at_place.find(key); found != at_place.end()) return found;
    }
    return at_place.end();
  };
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Point& X = mesh.vertices[v];
    if (const auto found = find(X); found != at_place.end())
      throw UserError(fmt::format("the nodes {} and {} are at the same place; neighbours must share their nodes",
                                  mesh.vertex_names[found->second], mesh.vertex_names[v]));
    at_place[{std::llround(X[0] / grid), std::llround(X[1] / grid), std::llround(X[2] / grid)}] = v;
  }
  const auto require_free = [&](const Point& X, std::size_t cell) {
    if (const auto found = find(X); found != at_place.end())
      throw UserError(
          fmt::format("node {} hangs in the middle of a face or an edge of element {}; neighbours must "
                      "share whole faces",
                      mesh.vertex_names[found->second], mesh.cell_names[cell]));
  };
  const auto middle = [&](const Face& face, int i, int j, int k, int l) {
    Point X;
    for (int d = 0; d < 3; ++d)
      X[d] = (mesh.vertices[face[i]][d] + mesh.vertices[face[j]][d] + mesh.vertices[face[k]][d] +
              mesh.vertices[face[l]][d]) /
             4;
    return X;
  };
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (int f = 0; f < 6; ++f) {
      const Face face = face_of(mesh.cells[cell], f);
      Face key = face;
      std::sort(key.begin(), key.end());
      if (cells_of.at(key).size() == 2) continue;
      require_free(middle(face, 0, 1, 2, 3), cell);
      for (int i = 0; i < 4; ++i) require_free(middle(face, i, i, (i + 1) % 4, (i + 1) % 4), cell);
    }
}

}  // namespace

void require_one_body(const HexahedralMesh& mesh) {
  if (mesh.cells.empty()) throw UserError("there is no hexahedron in it");
  require_vertices_used(mesh);
  require_untangled(mesh);
  const CellsOfFaces cells_of = cells_of_faces(mesh);
  require_conforming(mesh, cells_of);
  require_one_piece(mesh, cells_of);
}

MeshSize size_of(const HexahedralMesh& mesh) {
  MeshSize size{};
  const double gauss[] = {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)};  // exact: X det is cubic in each ξ_d
  for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
    for (int q = 0; q < 8; ++q) {
      const auto [X, jacobian] = at(mesh, cell, {gauss[q & 1], gauss[q >> 1 & 1], gauss[q >> 2 & 1]});
      size.volume += jacobian / 8;
      for (int c = 0; c < 3; ++c) size.center[c] += jacobian / 8 * X[c];
    }
  for (double& x : size.center) x /= size.volume;
  for (const Point& V : mesh.vertices)
    size.radius =
        std::max(size.radius, std::hypot(V[0] - size.center[0], V[1] - size.center[1], V[2] - size.center[2]));
  return size;
}

}  // namespace pseudorigid::io
