#include "io/gmsh.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "entries/entry_kinds.h"
#include "entries/wording.h"
#include "scene/user_error.h"

namespace pseudorigid::io {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 28;  // in bytes; 256 MiB
constexpr int hexahedron = 5;                               // Gmsh's type of the hexahedron with 8 nodes

/// Number of nodes of a boundary element, by Gmsh's type 15 (point), 1 (line) or 3 (quadrangle). The result is empty
/// for other types.
std::optional<std::size_t> n_nodes_of_boundary(int type) {
  switch (type) {
    case 15:
      return 1;
    case 1:
      return 2;
    case 3:
      return 4;
    default:
      return std::nullopt;
  }
}

/// The end of the message about an element with a type of Gmsh that the reader does not accept. The text describes the
/// element, and names an option of Gmsh that avoids such elements. The result is empty for a type below 1.
std::string other_element(int type) {
  constexpr std::string_view divided = "Gmsh divides it into hexahedra if Mesh.SubdivisionAlgorithm = 2",
                             straight = "save the mesh with -order 1";
  constexpr std::pair<int, std::string_view> plain[] = {
      {2, "a triangle"}, {4, "a tetrahedron"}, {6, "a prism"}, {7, "a pyramid"}};
  constexpr int second_order[] = {8, 9, 10, 11, 12, 13, 14, 16, 17, 18, 19};
  for (const auto& [number, name] : plain)
    if (type == number) return fmt::format(", {}; {}", name, divided);
  if (std::ranges::find(second_order, type) != std::end(second_order))
    return fmt::format(", which is of second order; {}", straight);
  return type > 19 ? fmt::format(", which is not of first order; {}", straight) : "";
}

/// The contents of the file. Throws UserError if the file cannot be read, is not a regular file, or is larger than
/// largest_file.
std::string text_of(const std::filesystem::path& file) {
  std::error_code ignored;
  std::ifstream stream;
  // Only a regular file is opened, because opening a pipe waits until another program writes to it.
  if (std::filesystem::is_regular_file(file, ignored)) stream.open(file, std::ios::binary);
  if (!stream.is_open()) throw UserError(fmt::format("cannot open the mesh {}", file.string()));
  std::string text;
  while (stream && text.size() <= largest_file) {
    const std::size_t n_before = text.size();
    text.resize(n_before + (std::size_t{1} << 20));
    stream.read(text.data() + n_before, static_cast<std::streamsize>(text.size() - n_before));
    text.resize(n_before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw UserError(fmt::format("cannot read the mesh {}", file.string()));
  if (text.size() > largest_file) throw UserError(fmt::format("{}: expected a mesh of at most 256 MiB", file.string()));
  return text;
}

/// The text without a byte order mark of UTF-8 at its beginning. Throws UserError if the text begins with a byte order
/// mark of UTF-16.
std::string_view without_mark(std::string_view text, const std::string& file) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw UserError(fmt::format("{}: expected plain text (ASCII or UTF-8), this file is in UTF-16", file));
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

/// Reads a mesh line by line. The constructor throws UserError if it cannot read the file as text. `read` throws
/// UserError at the first error of the file.
class GmshReader {
 public:
  explicit GmshReader(const std::filesystem::path& file)
      : file_(file.string()), text_(text_of(file)), rest_(without_mark(text_, file_)) {}

  HexahedralMesh read() {
    read_format();
    bool has_nodes = false, has_elements = false;
    while (next_line()) {
      if (line_.empty()) continue;
      const std::string_view section = line_;
      if (!section.starts_with('$')) refuse("expected the beginning of a section, $Nodes or $Elements");
      if (section == "$Nodes" && !has_nodes)
        has_nodes = true, read_nodes();
      else if (section == "$Elements" && has_nodes && !has_elements)
        has_elements = true, read_elements();
      else if (section == "$ParametricNodes")
        refuse("expected nodes without parameters ($Nodes); save the mesh without -parametric");
      else if (section == "$Nodes" || section == "$Elements")
        refuse(fmt::format("expected one section $Nodes and after it one section $Elements, got {} here", section));
      else
        skip(section);
    }
    if (!has_nodes || !has_elements)
      throw UserError(fmt::format("{}: the file ends without the section {}; is it truncated?", file_,
                                  has_nodes ? "$Elements" : "$Nodes"));
    check();
    return std::move(mesh_);
  }

 private:
  /// Throws UserError "FILE:line: sentence" with the name of the file and the number of the current line.
  [[noreturn]] void refuse(const std::string& sentence) const {
    throw UserError(fmt::format("{}:{}: {}", file_, n_lines_, sentence));
  }

  /// Sets `line_` to the next line without white space at its ends. Lines end with LF, CR LF or CR. Returns false at
  /// the end of the file.
  bool next_line() {
    if (rest_.empty()) return false;
    const auto end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
    const auto first = std::min(line_.find_first_not_of(" \t"), line_.size());
    line_ = line_.substr(first, line_.find_last_not_of(" \t") + 1 - first);
    ++n_lines_;
    return true;
  }

  /// Reads the next line. Throws UserError if the file ends; the message names the section `within`.
  void require_line(std::string_view within) {
    if (!next_line()) throw UserError(fmt::format("{}: the file ends within {}; is it truncated?", file_, within));
  }

  /// Reads the next number of the line and removes it from `line_`. The exponent may have the letter D, which Fortran
  /// writes (1.0D+00). Throws UserError if the next word is not a finite number of type T. In the message, `what`
  /// describes the expected number.
  template <class T>
  T take(const char* what) {
    line_.remove_prefix(std::min(line_.find_first_not_of(" \t"), line_.size()));
    const std::string_view word = line_.substr(0, line_.find_first_of(" \t"));
    std::string number(word.substr(word.starts_with('+') && !word.starts_with("+-") ? 1 : 0));
    if constexpr (std::is_floating_point_v<T>)
      if (const auto at = number.find_first_of("dD"); at != number.npos) number[at] = 'e';
    T value{};
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    bool good = error == std::errc() && end == number.data() + number.size();
    if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
    if (!good) refuse(fmt::format("expected {}, {}", what, scene::got(word)));
    line_.remove_prefix(word.size());
    return value;
  }

  void require_end_of_line() {
    if (line_.find_first_not_of(" \t") != line_.npos) refuse("there is more on this line than expected");
  }

  /// Reads the next line, which must be `keyword`. Throws UserError for another line, or if the file ends.
  void require(std::string_view keyword) {
    require_line(keyword);
    if (line_ != keyword) refuse(fmt::format("expected {}", keyword));
  }

  /// Reads the section $MeshFormat. The section $Comments and empty lines may come before it. Throws UserError if the
  /// section is missing or incomplete, for binary files, and for versions other than 2.2.
  void read_format() {
    constexpr const char* convert = "\"gmsh FILE -format msh22 -save\" writes it";
    bool found = next_line();
    while (found && line_ != "$MeshFormat" && (line_.empty() || line_ == "$Comments")) {
      if (!line_.empty()) skip(line_);
      found = next_line();
    }
    if (!found || line_ != "$MeshFormat")
      throw UserError(fmt::format(
          "{}:{}: expected $MeshFormat, with which a file of Gmsh begins, {}{}", file_, std::max(n_lines_, 1),
          scene::got(line_), line_ == "$NOD" ? fmt::format("; expected version 2.2 of the format, {}", convert) : ""));
    require_line("$MeshFormat");
    const auto version = take<double>("the version of the format, 2.2");
    if (version != 2.2)
      refuse(fmt::format("expected version 2.2 of the format, got {}; {}", scene::print_number(version), convert));
    if (take<int>("0 for ASCII") != 0)
      refuse(fmt::format("expected an ASCII file, this one is binary; {} if Mesh.Binary = 0", convert));
    take<int>("the size of a number");
    require_end_of_line();
    require("$EndMeshFormat");
  }

  /// Reads the line with the number of nodes or elements of the section, and returns this number. Throws UserError if
  /// the line contains further text or if the file ends.
  std::size_t read_count(std::string_view section) {
    require_line(section);
    const auto n = take<std::size_t>("how many lines the section has");
    require_end_of_line();
    return n;
  }

  void read_nodes() {
    const std::size_t n = read_count("$Nodes");
    for (std::size_t i = 0; i < n; ++i) {
      require_line("$Nodes");
      const auto name = take<long>("the number of a node");
      HexahedralMesh::Point X;
      for (double& x : X) x = take<double>("three finite coordinates after the number of the node");
      require_end_of_line();
      if (!vertex_of_.try_emplace(name, static_cast<unsigned int>(i)).second)
        refuse(fmt::format("there are two nodes {}", name));
      mesh_.vertices.push_back(X);
      mesh_.vertex_names.push_back(name);
    }
    require("$EndNodes");
  }

  unsigned int take_node() {
    const auto name = take<long>("the nodes of the element");
    const auto found = vertex_of_.find(name);
    if (found == vertex_of_.end()) refuse(fmt::format("there is no node {}", name));
    return found->second;
  }

  void read_elements() {
    const std::size_t n = read_count("$Elements");
    std::unordered_set<long> names;
    for (std::size_t i = 0; i < n; ++i) {
      require_line("$Elements");
      const auto name = take<long>("the number of an element");
      if (!names.insert(name).second) refuse(fmt::format("there are two elements {}", name));
      const int type = take<int>("the type of the element");
      const auto n_tags = take<unsigned int>("the number of tags");
      for (unsigned int tag = 0; tag < n_tags; ++tag) take<long>("as many tags as announced");
      if (type == hexahedron)
        read_hexahedron(name);
      else if (const auto n_nodes = n_nodes_of_boundary(type))
        for (std::size_t node = 0; node < *n_nodes; ++node) on_boundary_.insert(take_node());
      else
        refuse(fmt::format("expected hexahedra of 8 nodes (type 5), got an element of type {}{}", type,
                           other_element(type)));
      require_end_of_line();
    }
    require("$EndElements");
  }

  /// Reads the nodes of the cell with the number `name`. Gmsh lists the nodes around the lower face and then the nodes
  /// around the upper face. In a HexahedralMesh, the corner (i₁, i₂, i₃) has the place i₁ + 2 i₂ + 4 i₃. Throws
  /// UserError if a node is missing or does not exist, or if the cell has a node twice.
  void read_hexahedron(long name) {
    auto& cell = mesh_.cells.emplace_back();
    for (const int i : {0, 1, 3, 2, 4, 5, 7, 6}) cell[i] = take_node();
    auto sorted = cell;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      refuse(fmt::format("element {} has a node twice", name));
    mesh_.cell_names.push_back(name);
  }

  /// Skips the lines of an unused section up to the line "$End…". Throws UserError if the file ends before this line.
  void skip(std::string_view section) {
    const std::string end = "$End" + std::string(section.substr(1)), within = scene::quote(section);
    do require_line(within);
    while (line_ != end);
  }

  /// Removes nodes that belong to point, line or quadrangle elements but not to a cell, such as the centre of an arc.
  void drop_construction_nodes() {
    std::vector<bool> used(mesh_.vertices.size(), false);
    for (const auto& cell : mesh_.cells)
      for (const unsigned int v : cell) used[v] = true;
    std::vector<unsigned int> place(used.size());
    unsigned int n_kept = 0;
    for (unsigned int v = 0; v < used.size(); ++v) {
      if (!used[v] && on_boundary_.contains(v)) continue;
      mesh_.vertices[n_kept] = mesh_.vertices[v];
      mesh_.vertex_names[n_kept] = mesh_.vertex_names[v];
      place[v] = n_kept++;
    }
    mesh_.vertices.resize(n_kept);
    mesh_.vertex_names.resize(n_kept);
    for (auto& cell : mesh_.cells)
      for (unsigned int& v : cell) v = place[v];
  }

  /// Removes construction nodes, and reverses the orientation of the cells if all of them are left-handed. Throws
  /// UserError "FILE: …" if the mesh is not one body.
  void check() {
    drop_construction_nodes();
    turn_right_handed(mesh_);
    try {
      require_one_body(mesh_);
    } catch (const UserError& error) {
      throw UserError(fmt::format("{}: {}", file_, error.what()));
    }
  }

  std::string file_, text_;
  std::string_view rest_, line_;                      ///< the text after the current line; the rest of the current line
  int n_lines_ = 0;                                   ///< number of the current line, from 1
  std::unordered_map<long, unsigned int> vertex_of_;  ///< index of a vertex, by the number of its node in the file
  std::unordered_set<unsigned int> on_boundary_;      ///< indices of the vertices of boundary elements
  HexahedralMesh mesh_;
};

}  // namespace

HexahedralMesh read_gmsh(const std::filesystem::path& file) { return GmshReader(file).read(); }

}  // namespace pseudorigid::io
