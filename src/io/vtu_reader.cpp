#include "io/vtu_reader.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>

#include "io/files.h"
#include "scene/user_error.h"

namespace pseudorigid::io {
namespace {

/// The two parts of a .vtu file: the XML and the appended arrays. The constructor and the functions throw UserError if
/// a part does not have the form that write_vtu writes.
class VtuText {
 public:
  explicit VtuText(const std::filesystem::path& path) : path_(path), text_(read_file(path)) {
    constexpr std::string_view begin = "<AppendedData encoding=\"raw\">\n_";
    const std::size_t at = text_.find(begin);
    require(at != std::string::npos);
    xml_ = std::string_view(text_).substr(0, at);
    data_ = std::string_view(text_).substr(at + begin.size());
    constexpr const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    require(attribute(element("<VTKFile "), "byte_order") == order);
    require(attribute(element("<VTKFile "), "compressor") == "vtkZLibDataCompressor");
  }

  std::string_view xml() const { return xml_; }
  /// The first element of the XML that starts with `begin`, up to its first '>'. The result is empty if there is none.
  std::string_view element(std::string_view begin) const {
    const std::size_t at = xml_.find(begin);
    return at == std::string_view::npos ? std::string_view() : xml_.substr(at, xml_.find('>', at) + 1 - at);
  }
  /// The XML element of the array with this type and name. The result is empty if there is none.
  std::string_view array(std::string_view type, std::string_view name) const {
    return element(fmt::format("<DataArray type=\"{}\" Name=\"{}\"", type, name));
  }
  /// The value of an attribute of the element. The result is empty if the element does not have the attribute.
  std::string attribute(std::string_view element, std::string_view name) const {
    const std::string begin = fmt::format(" {}=\"", name);
    const std::size_t at = element.find(begin);
    if (at == std::string_view::npos) return {};
    const std::string_view rest = element.substr(at + begin.size());
    return std::string(rest.substr(0, rest.find('"')));
  }
  /// The value of an attribute that is a natural number. Throws UserError for another value or a missing attribute.
  std::size_t number(std::string_view element, std::string_view name) const {
    const std::string text = attribute(element, name);
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    require(error == std::errc() && end == text.data() + text.size());
    return value;
  }

  /// Returns the n numbers of the appended array that the XML element `element` describes. If the array cannot have so
  /// many numbers, UserError is thrown before memory is allocated.
  template <class T>
  std::vector<T> values(std::string_view element, std::size_t n) const {
    constexpr std::size_t largest_ratio_of_zlib = 1100;  // deflate compresses at most by the factor 1032
    require(n <= data_.size() * largest_ratio_of_zlib / sizeof(T));
    std::vector<T> result(n);
    decompress(number(element, "offset"), std::as_writable_bytes(std::span(result)));
    return result;
  }

  /// Throws UserError if the condition is false.
  void require(bool condition) const {
    if (!condition) throw UserError(fmt::format("{}: expected a picture as a run writes it", path_.native()));
  }

 private:
  /// Decompresses the array at the position `offset` of the appended data into `target`. The function `compressed` in
  /// vtu.cpp defines the form of an array. Throws UserError unless the blocks fill `target` exactly.
  void decompress(std::size_t offset, std::span<std::byte> target) const {
    std::array<std::uint64_t, 3> head;  // number of blocks, size of a block, size of a shorter last block or 0
    copy(offset, head.data(), sizeof head);
    const auto [n_blocks, size, last] = head;
    require(n_blocks <= data_.size());
    std::vector<std::uint64_t> sizes(n_blocks);
    copy(offset + sizeof head, sizes.data(), n_blocks * sizeof(std::uint64_t));
    std::size_t at = offset + sizeof head + n_blocks * sizeof(std::uint64_t);
    for (std::size_t block = 0; block < n_blocks; ++block) {
      const std::size_t wanted = block + 1 == n_blocks && last > 0 ? last : size;
      require(wanted <= target.size() && sizes[block] <= data_.size() && at <= data_.size() - sizes[block]);
      uLongf found = wanted;
      const int status = uncompress(reinterpret_cast<Bytef*>(target.data()), &found,
                                    reinterpret_cast<const Bytef*>(data_.data() + at), sizes[block]);
      require(status == Z_OK && found == wanted);
      target = target.subspan(wanted);
      at += sizes[block];
    }
    require(target.empty());
  }
  void copy(std::size_t offset, void* target, std::size_t n_bytes) const {
    require(offset <= data_.size() && n_bytes <= data_.size() - offset);
    if (n_bytes > 0) std::memcpy(target, data_.data() + offset, n_bytes);
  }

  std::filesystem::path path_;
  std::string text_;
  std::string_view xml_, data_;
};

/// The number of components of an array, from its XML element `array`. Without the attribute, which write_vtu omits for
/// scalars, the number is 1.
int n_components(const VtuText& file, std::string_view array) {
  return file.attribute(array, "NumberOfComponents").empty()
             ? 1
             : static_cast<int>(file.number(array, "NumberOfComponents"));
}

/// The constants of the whole grid, which the XML contains as text.
std::vector<UnstructuredGrid::Field> constants_of(const VtuText& file) {
  std::vector<UnstructuredGrid::Field> constants;
  std::string_view rest = file.xml().substr(0, file.xml().find("</FieldData>"));
  if (rest.size() == file.xml().size()) return {};
  for (std::size_t at; (at = rest.find("<DataArray ")) != std::string_view::npos;) {
    rest.remove_prefix(at);
    const std::size_t end = rest.find('>');
    file.require(end != std::string_view::npos);
    const std::string_view head = rest.substr(0, end + 1);
    rest.remove_prefix(end + 1);
    std::istringstream text(std::string(rest.substr(0, rest.find('<'))));
    UnstructuredGrid::Field field{file.attribute(head, "Name"), n_components(file, head), {}};
    for (double value; text >> value;) field.values.push_back(value);
    file.require(field.values.size() == static_cast<std::size_t>(field.n_components));
    constants.push_back(std::move(field));
  }
  return constants;
}

}  // namespace

UnstructuredGrid read_vtu(const std::filesystem::path& path, std::span<const std::string> fields) {
  const VtuText file(path);
  const std::string_view piece = file.element("<Piece ");
  const std::size_t n_points = file.number(piece, "NumberOfPoints"), n_cells = file.number(piece, "NumberOfCells");
  file.require(n_points < std::size_t{1} << 40 && n_cells < std::size_t{1} << 40);

  UnstructuredGrid grid;
  grid.points = file.values<double>(file.array("Float64", "Points"), 3 * n_points);
  const auto offsets = file.values<std::int64_t>(file.array("Int64", "offsets"), n_cells);
  const auto types = file.values<std::uint8_t>(file.array("UInt8", "types"), n_cells);
  file.require(n_cells > 0 && offsets[0] > 0 && offsets[0] < 100000);
  grid.cell_type = static_cast<CellType>(types[0]);
  grid.nodes_per_cell = static_cast<int>(offsets[0]);
  grid.connectivity = file.values<std::int64_t>(file.array("Int64", "connectivity"), n_cells * offsets[0]);
  const auto n = static_cast<std::int64_t>(n_points);
  file.require(std::ranges::all_of(grid.connectivity, [n](std::int64_t i) { return 0 <= i && i < n; }));
  grid.constants = constants_of(file);
  for (const std::string& name : fields)
    if (const std::string_view array = file.array("Float64", name); !array.empty()) {
      const int width = n_components(file, array);
      grid.fields.push_back({name, width, file.values<double>(array, n_points * width)});
    }
  return grid;
}

}  // namespace pseudorigid::io
