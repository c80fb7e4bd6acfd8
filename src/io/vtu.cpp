#include "io/vtu.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <future>
#include <iterator>
#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "io/files.h"

namespace pseudorigid::io {

namespace {

constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

template <class T>
constexpr const char* vtk_type = nullptr;
template <>
constexpr const char* vtk_type<double> = "Float64";
template <>
constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
constexpr const char* vtk_type<std::uint8_t> = "UInt8";

std::string bytes_of(std::span<const std::uint64_t> numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

/// Returns the bytes of an array, compressed in VTK's format. A header contains the number of blocks, the size of a
/// block, the size of the last block, and the compressed size of each block. If the last block has the full size, its
/// size is written as 0. The compressed blocks follow the header.
std::string compressed(std::string_view bytes) {
  // A block is much larger than the window of zlib (32 KiB), so that the division into blocks hardly increases the
  // size.
  constexpr std::size_t block_size = std::size_t{1} << 18;
  // The last digits of coordinates are nearly random, so that coordinates can hardly be compressed. In measurements, a
  // higher level needed twice the time and reduced the size by only 1 %.
  constexpr int level = 1;
  std::vector<std::uint64_t> header{(bytes.size() + block_size - 1) / block_size, block_size,
                                    bytes.size() % block_size};
  std::string blocks, block(compressBound(block_size), '\0');
  for (std::size_t begin = 0; begin < bytes.size(); begin += block_size) {
    const std::string_view source = bytes.substr(begin, block_size);
    uLongf size = block.size();
    if (compress2(reinterpret_cast<Bytef*>(block.data()), &size, reinterpret_cast<const Bytef*>(source.data()),
                  source.size(), level) != Z_OK)
      throw std::bad_alloc();  // the buffer is large enough, so the only possible error is a lack of memory
    blocks.append(block, 0, size);
    header.push_back(size);
  }
  return bytes_of(header) + blocks;
}

/// The text of a .vtu file: the XML, and the appended arrays to which the XML refers by offsets. The arrays must
/// outlive the document.
class Document {
 public:
  void add(std::string_view xml) { parts_.push_back({.xml = std::string(xml)}); }
  /// Adds an array, and its element in the XML. `n_components` is the number of values per point for the points and the
  /// fields, and 1 for the three arrays of cells.
  template <class T>
  void add_array(std::string_view name, int n_components, std::span<const T> values) {
    parts_.push_back({.xml = fmt::format(R"(<DataArray type="{}" Name="{}"{} format="appended" offset=")", vtk_type<T>,
                                         name, components(n_components)),
                      .array = std::as_bytes(values)});
  }
  /// Adds a constant of the whole grid, written as text in the XML.
  void add_constant(const UnstructuredGrid::Field& constant) {
    add(fmt::format(R"(<DataArray type="Float64" Name="{}"{} NumberOfTuples="1" format="ascii">{:.17g}</DataArray>)"
                    "\n",
                    constant.name, components(constant.n_components), fmt::join(constant.values, " ")));
  }

  void write(const std::filesystem::path& path) {
    compress();
    std::string xml, data;
    for (const Part& part : parts_) {
      xml += part.xml;
      if (part.array) xml += fmt::format("{}\"/>\n", data.size());
      data += part.compressed;
    }
    write_file_atomically(path, {xml, data, "\n</AppendedData>\n</VTKFile>\n"});
  }

 private:
  struct Part {
    std::string xml;
    std::optional<std::span<const std::byte>> array{};
    std::string compressed{};
  };

  /// Compresses the arrays in several threads, because the compression takes most of the time for writing a picture.
  void compress() {
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t i; (i = next++) < parts_.size();)
        if (const auto& array = parts_[i].array)
          parts_[i].compressed = compressed({reinterpret_cast<const char*>(array->data()), array->size()});
    };
    constexpr unsigned most = 8;  // a picture has about 15 arrays, so that more threads would gain little
    std::vector<std::future<void>> helpers;
    try {
      for (unsigned n = 1; n < std::min(most, std::thread::hardware_concurrency()); ++n)
        helpers.push_back(std::async(std::launch::async, work));
    } catch (const std::system_error&) {  // continue with the threads that exist
    }
    work();
    for (auto& helper : helpers) helper.get();
  }

  /// The XML attribute for the number of components. The attribute is omitted for scalars, because its default is 1. If
  /// a file contains the number 1, meshio reads a scalar as a matrix with one column.
  static std::string components(int n) { return n == 1 ? "" : fmt::format(R"( NumberOfComponents="{}")", n); }

  std::vector<Part> parts_;
};

void require(bool condition, const std::string& complaint) {
  if (!condition) throw std::logic_error("VTU grid: " + complaint);
}

/// Throws std::logic_error in the cases that the comment of write_vtu lists.
void validate(const UnstructuredGrid& grid) {
  const auto all_finite = [](const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double x) { return std::isfinite(x); });
  };
  const auto n_points = static_cast<std::int64_t>(grid.n_points());
  require(grid.points.size() % 3 == 0 && all_finite(grid.points), "points are not triples of finite numbers");
  require(grid.nodes_per_cell > 0 && grid.connectivity.size() % grid.nodes_per_cell == 0, "a cell is incomplete");
  require(std::ranges::all_of(grid.connectivity, [&](std::int64_t i) { return 0 <= i && i < n_points; }),
          "a cell has a point that does not exist");
  const auto validate_fields = [&](const std::vector<UnstructuredGrid::Field>& fields, std::size_t n_tuples) {
    for (const auto& field : fields) {
      require(field.values.size() == n_tuples * field.n_components, field.name + " has the wrong size");
      require(all_finite(field.values), field.name + " is not finite");
    }
  };
  validate_fields(grid.fields, grid.n_points());
  validate_fields(grid.constants, 1);
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const UnstructuredGrid& grid) {
  validate(grid);
  std::vector<std::int64_t> offsets(grid.n_cells());
  for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] = static_cast<std::int64_t>(i + 1) * grid.nodes_per_cell;
  const std::vector<std::uint8_t> types(grid.n_cells(), static_cast<std::uint8_t>(grid.cell_type));

  Document document;
  document.add(
      fmt::format("<?xml version=\"1.0\"?>\n"
                  "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\" "
                  "compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n",
                  byte_order));
  if (!grid.constants.empty()) {
    document.add("<FieldData>\n");
    for (const auto& constant : grid.constants) document.add_constant(constant);
    document.add("</FieldData>\n");
  }
  document.add(
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n", grid.n_points(), grid.n_cells()));
  document.add_array<double>("Points", 3, grid.points);
  document.add("</Points>\n<Cells>\n");
  document.add_array<std::int64_t>("connectivity", 1, grid.connectivity);
  document.add_array<std::int64_t>("offsets", 1, offsets);
  document.add_array<std::uint8_t>("types", 1, types);
  document.add("</Cells>\n<PointData>\n");
  for (const auto& field : grid.fields) document.add_array<double>(field.name, field.n_components, field.values);
  document.add("</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
  document.write(path);
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
