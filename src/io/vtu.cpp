#include "io/vtu.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "io/files.h"

namespace pseudorigid::io {

namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

template <class T>
constexpr const char* vtk_type = nullptr;
template <>
constexpr const char* vtk_type<double> = "Float64";
template <>
constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
constexpr const char* vtk_type<std::uint8_t> = "UInt8";

/// <DataArray> with one base64 stream: the number of bytes as UInt64, then the bytes.
template <class T>
void append_array(std::string& out, std::string_view name, int n_components, const std::vector<T>& values) {
  const std::uint64_t n_bytes = values.size() * sizeof(T);
  std::string bytes(sizeof n_bytes + n_bytes, '\0');
  std::copy_n(reinterpret_cast<const char*>(&n_bytes), sizeof n_bytes, bytes.begin());
  std::copy_n(reinterpret_cast<const char*>(values.data()), n_bytes, bytes.begin() + sizeof n_bytes);
  out += fmt::format(R"(<DataArray type="{}" Name="{}")", vtk_type<T>, name);
  // Left out for scalars, its default: given a 1, meshio makes columns of them.
  if (n_components != 1) out += fmt::format(R"( NumberOfComponents="{}")", n_components);
  out += R"( format="binary">)";
  out += base64(bytes);
  out += "</DataArray>\n";
}

void require(bool condition, const std::string& complaint) {
  if (!condition) throw std::logic_error("VTU grid: " + complaint);
}

void validate(const UnstructuredGrid& grid) {
  const auto all_finite = [](const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
  };
  const auto n_points = static_cast<std::int64_t>(grid.n_points());
  require(grid.points.size() % 3 == 0 && all_finite(grid.points), "points are not triples of finite numbers");
  require(grid.nodes_per_cell > 0 && grid.connectivity.size() % grid.nodes_per_cell == 0, "a cell is incomplete");
  require(std::ranges::all_of(grid.connectivity, [&](std::int64_t i) { return 0 <= i && i < n_points; }),
          "a cell has a point that does not exist");
  for (const auto& field : grid.fields) {
    require(field.values.size() == grid.n_points() * field.n_components, field.name + " has the wrong size");
    require(all_finite(field.values), field.name + " is not finite");
  }
}

constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

void append_cells(std::string& out, const UnstructuredGrid& grid) {
  std::vector<std::int64_t> offsets(grid.n_cells());
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] = static_cast<std::int64_t>(i + 1) * grid.nodes_per_cell;
  const std::vector<std::uint8_t> types(grid.n_cells(), static_cast<std::uint8_t>(grid.cell_type));
  out += "<Cells>\n";
  append_array(out, "connectivity", 1, grid.connectivity);
  append_array(out, "offsets", 1, offsets);
  append_array(out, "types", 1, types);
  out += "</Cells>\n";
}

}  // namespace

std::string base64(std::string_view bytes) {
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  auto out = text.begin();
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t triple = 0;
    for (std::size_t j = 0; j < 3; ++j) triple = triple << 8 | (j < n ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j <= n; ++j) out[j] = base64_digits[triple >> (18 - 6 * j) & 63];
    out += 4;
  }
  return text;
}

void write_vtu(const std::filesystem::path& path, const UnstructuredGrid& grid) {
  validate(grid);
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n"
      "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
      byte_order, grid.n_points(), grid.n_cells());
  append_array(out, "Points", 3, grid.points);
  out += "</Points>\n";
  append_cells(out, grid);
  out += "<PointData>\n";
  for (const auto& field : grid.fields) append_array(out, field.name, field.n_components, field.values);
  out += "</PointData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  write_file_atomically(path, {out});
}

void write_pvtu(const std::filesystem::path& path, const UnstructuredGrid& piece,
                const std::vector<std::filesystem::path>& files) {
  const auto declare = [](const std::string& name, int n_components) {
    return fmt::format("<PDataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\"/>\n", name, n_components);
  };
  std::string out = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n"
      "<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n{}</PPoints>\n<PPointData>\n",
      byte_order, declare("Points", 3));
  for (const auto& field : piece.fields) out += declare(field.name, field.n_components);
  out += "</PPointData>\n";
  for (const auto& file : files) out += fmt::format("<Piece Source=\"{}\"/>\n", file.filename().string());
  out += "</PUnstructuredGrid>\n</VTKFile>\n";
  write_file_atomically(path, {out});
}

}  // namespace pseudorigid::io
