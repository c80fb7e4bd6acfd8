#include "io/report_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "io/block_cells.h"
#include "io/files.h"
#include "io/pvd.h"
#include "io/vtu_reader.h"
#include "scene/user_error.h"

namespace pseudorigid::io {
namespace {

constexpr const char *reference = "reference_coordinates", *stress = "von_mises";
constexpr std::size_t most_times = 8;     ///< largest number of pictures in the table of a motion that is not affine
constexpr std::size_t most_rows = 60000;  ///< largest number of rows of this table; a row has about 70 bytes

/// The values of the field `name`. The result is null if the grid does not have this field.
const std::vector<double>* field(const UnstructuredGrid& grid, std::string_view name) {
  const auto found = std::ranges::find(grid.fields, name, &UnstructuredGrid::Field::name);
  return found == grid.fields.end() ? nullptr : &found->values;
}

/// The points of a face of a block with n³ points, as indices in the block. In the face, the lattice index in
/// `direction` is 0, or n − 1 if `is_far` is true. The lattice index in the direction (direction + 1) mod 3 varies
/// fastest.
std::vector<std::size_t> lattice_of_face(std::size_t n, int direction, bool is_far) {
  const std::array<std::size_t, 3> stride{1, n, n * n};
  const std::size_t a = stride[(direction + 1) % 3], b = stride[(direction + 2) % 3];
  std::vector<std::size_t> places;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) places.push_back(i * a + j * b + (is_far ? (n - 1) * stride[direction] : 0));
  return places;
}

/// A face of a block, and the number of blocks that have this face (`n_elements`). A face of only one block is on the
/// surface.
struct Candidate {
  PictureFace face;
  int n_elements = 0;
};

/// The largest absolute value, or 0 for an empty list.
double largest(const std::vector<double>& values) {
  double size = 0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

/// The number 1, 2 or 3 of the coordinate plane that contains all points of a face in the undeformed body, within
/// `tolerance`. The result is 0 if there is no such plane.
int plane_of(const PictureFace& face, const std::vector<UnstructuredGrid>& pieces, double tolerance) {
  for (int d = 0; d < 3; ++d)
    if (std::ranges::all_of(face.points, [&](const auto& point) {
          return std::abs((*field(pieces[point.first], reference))[3 * point.second + d]) <= tolerance;
        }))
      return d + 1;
  return 0;
}

/// The key of a face: the mean of its points in the undeformed body, rounded to multiples of `tolerance`. Two blocks
/// share a face if they have a face with the same key.
std::array<long, 3> key_of(const PictureFace& face, const std::vector<UnstructuredGrid>& pieces, double tolerance) {
  std::array<double, 3> sum{};
  for (const auto& [piece, point] : face.points)
    for (int d = 0; d < 3; ++d) sum[d] += (*field(pieces[piece], reference))[3 * point + d];
  std::array<long, 3> key;
  for (int d = 0; d < 3; ++d) key[d] = std::lround(sum[d] / static_cast<double>(face.points.size()) / tolerance);
  return key;
}

/// The files with the grids of the picture `path`. The .pvtu file of a parallel run lists these files. A picture with
/// another extension is a grid itself.
std::vector<std::filesystem::path> pieces_of(const std::filesystem::path& path) {
  if (path.extension() != ".pvtu") return {path};
  std::vector<std::filesystem::path> files;
  const std::string text = read_file(path);
  constexpr std::string_view begin = "<Piece Source=\"";
  for (std::size_t at = text.find(begin); at != text.npos; at = text.find(begin, at)) {
    at += begin.size();
    files.push_back(path.parent_path() / text.substr(at, text.find('"', at) - at));
  }
  return files;
}

std::vector<UnstructuredGrid> read_picture(const std::filesystem::path& path) {
  const std::array<std::string, 2> wanted{reference, stress};
  std::vector<UnstructuredGrid> pieces;
  for (const std::filesystem::path& file : pieces_of(path)) pieces.push_back(read_vtu(file, wanted));
  return pieces;
}

bool has_fields(const std::vector<UnstructuredGrid>& pieces) {
  return !pieces.empty() &&
         std::ranges::all_of(pieces, [](const auto& grid) { return field(grid, reference) && field(grid, stress); });
}

/// True if the grids of a picture have all points of the faces. The faces are those of the first picture of a run, and
/// a later picture may have fewer points.
bool have_the_points(const std::vector<UnstructuredGrid>& pieces, const std::vector<PictureFace>& faces) {
  return std::ranges::all_of(faces, [&](const PictureFace& face) {
    return std::ranges::all_of(face.points, [&](const auto& point) {
      return static_cast<std::size_t>(point.first) < pieces.size() && point.second < pieces[point.first].n_points();
    });
  });
}

/// Appends a row of table_of_frames for the point with the index `point` in the grid. The row has the time, the number
/// and plane of the face, and the reference position, the position and the von Mises stress of the point.
void add_row(std::string& text, double time, std::size_t number, int plane, const UnstructuredGrid& grid,
             std::size_t point) {
  const auto row = std::back_inserter(text);
  fmt::format_to(row, "{:.17g},{},{}", time, number, plane);
  for (const double X : std::span(*field(grid, reference)).subspan(3 * point, 3)) fmt::format_to(row, ",{:.7g}", X);
  for (const double x : std::span(grid.points).subspan(3 * point, 3)) fmt::format_to(row, ",{:.7g}", x);
  fmt::format_to(row, ",{:.5g}\n", (*field(grid, stress))[point]);
}

/// Returns n ≥ 2 pictures at about equal distances in the list, including the first and the last picture. If the list
/// has at most n pictures, the result is the list.
std::vector<PvdCollection::Frame> some_of(const std::vector<PvdCollection::Frame>& frames, std::size_t n) {
  if (frames.size() <= n) return frames;
  std::vector<PvdCollection::Frame> chosen;
  for (std::size_t k = 0; k < n; ++k) chosen.push_back(frames[(2 * k * (frames.size() - 1) + n - 1) / (2 * (n - 1))]);
  return chosen;
}

/// The rows of table_of_frames without the header. The text is empty if a picture does not have all points of the
/// faces, or lacks one of the fields reference_coordinates and von_mises. If `is_affine` is false, the text is also
/// empty if the first picture has no faces, or if two pictures would have more than most_rows rows. `frames` must not
/// be empty. Throws UserError if a picture cannot be read.
std::string rows_of_frames(std::vector<PvdCollection::Frame> frames, bool is_affine) {
  std::string text;
  std::vector<PictureFace> faces;
  if (!is_affine) {
    const std::vector<UnstructuredGrid> first = read_picture(frames.front().file);
    if (!has_fields(first)) return {};
    faces = faces_of(first);
    std::size_t n_rows = 0;
    for (const PictureFace& face : faces) n_rows += face.points.size();
    if (n_rows == 0 || 2 * n_rows > most_rows) return {};
    frames = some_of(frames, std::min(most_times, most_rows / n_rows));
  }
  for (const PvdCollection::Frame& frame : frames) {
    const std::vector<UnstructuredGrid> pieces = read_picture(frame.file);
    if (!has_fields(pieces) || !have_the_points(pieces, faces)) return {};
    if (is_affine) add_row(text, frame.time, 1, 0, pieces.front(), 0);
    for (std::size_t number = 0; number < faces.size(); ++number)
      for (const auto& [piece, point] : faces[number].points)
        add_row(text, frame.time, number + 1, faces[number].plane, pieces[piece], point);
  }
  return text;
}

}  // namespace

std::vector<PictureFace> faces_of(const std::vector<UnstructuredGrid>& pieces) {
  std::map<std::array<long, 3>, Candidate> candidates;
  std::vector<std::array<long, 3>> in_order;
  double size = 0;
  for (const UnstructuredGrid& grid : pieces) {
    if (!field(grid, reference)) return {};
    size = std::max(size, largest(*field(grid, reference)));
  }
  const double tolerance = 1e-6 * size;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    const auto blocks = blocks_of(pieces[piece]);
    if (!blocks) return {};
    const std::size_t n = static_cast<std::size_t>(blocks->degree) + 1;
    for (std::size_t block = 0; block < blocks->n_blocks(); ++block)
      for (int side = 0; side < 6; ++side) {
        PictureFace face{0, {}};
        for (const std::size_t place : lattice_of_face(n, side / 2, side % 2 == 1))
          face.points.emplace_back(piece, blocks->points[block * n * n * n + place]);
        const auto [found, is_new] = candidates.try_emplace(key_of(face, pieces, tolerance), Candidate{face});
        if (is_new) in_order.push_back(found->first);
        ++found->second.n_elements;
      }
  }
  std::vector<PictureFace> faces;
  for (const auto& key : in_order) {
    Candidate& candidate = candidates.at(key);
    candidate.face.plane = plane_of(candidate.face, pieces, tolerance);
    if (candidate.face.plane > 0 || candidate.n_elements == 1) faces.push_back(std::move(candidate.face));
  }
  return faces;
}

std::string table_of_frames(const std::filesystem::path& pvd, bool is_affine) try {
  const PvdCollection list = PvdCollection::resume(pvd, std::numeric_limits<double>::infinity());
  if (list.frames().empty()) return {};
  const std::string rows = rows_of_frames(list.frames(), is_affine);
  if (rows.empty()) return {};
  return fmt::format("time,{},von_mises\n{}", fmt::join(mechanics::shape_columns, ","), rows);
} catch (const UserError&) {
  return {};  // a killed run may lack files; the report then omits the faces
}

}  // namespace pseudorigid::io
