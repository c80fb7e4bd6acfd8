/// Meshes from files of Gmsh: what is read, what is refused and where, and that no damaged file does harm.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <utility>

#include "io/files.h"
#include "io/gmsh.h"
#include "scene/user_error.h"
#include "scratch.h"
#include "support/two_cubes.h"

namespace pseudorigid::io {
namespace {

using pseudorigid::testing::two_cubes;
using ::testing::HasSubstr;

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const auto place = text.find(old);
  EXPECT_NE(place, std::string::npos) << old;
  return text.replace(place, old.size(), by);
}

class Gmsh : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    test::put(scratch_ / "mesh.msh", text);
    return scratch_ / "mesh.msh";
  }
  HexahedralMesh read(const std::string& text) const { return read_gmsh(write(text)); }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const UserError& error) {
      return error.what();
    }
    return "read";
  }

  test::ScratchDirectory scratch_;
};

TEST_F(Gmsh, ReadsTwoCubes) {
  const HexahedralMesh mesh = read(two_cubes);
  EXPECT_EQ(mesh.vertices.size(), 12u);
  ASSERT_EQ(mesh.cells.size(), 2u);
  for (int i = 0; i < 8; ++i)
    for (int d = 0; d < 3; ++d) {
      EXPECT_EQ(mesh.vertices[mesh.cells[0][i]][d], i >> d & 1) << i;
      EXPECT_EQ(mesh.vertices[mesh.cells[1][i]][d], (i >> d & 1) + (d == 0)) << i;
    }
  const MeshSize size = size_of(mesh);
  EXPECT_NEAR(size.volume, 2, 1e-15);
  EXPECT_NEAR(size.center[0], 1, 1e-15);
  EXPECT_NEAR(size.center[1], 0.5, 1e-15);
  EXPECT_NEAR(size.radius, std::sqrt(1.5), 1e-15);
}

TEST_F(Gmsh, PassesOverBoundariesConstructionNodesAndOtherSections) {
  std::string text = replaced(two_cubes, "12\n1 0 0 0", "13\n99 5 5 5\n1 0 0 0");
  text = replaced(text, "$Elements\n2\n", "$Elements\n4\n7 15 0 99\n8 3 2 0 1 1 2 5 4\n");
  text = replaced(text, "$Nodes", "$PhysicalNames\n1\n3 1 \"body\"\n$EndPhysicalNames\n$Nodes");
  const HexahedralMesh mesh = read(text);
  EXPECT_EQ(mesh.vertices.size(), 12u);
  EXPECT_EQ(mesh.cells, read(two_cubes).cells);
}

TEST_F(Gmsh, ReadsLineEndsOfOtherSystems) {
  std::string text;
  for (const char c : two_cubes) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(text).cells, read(two_cubes).cells);
}

TEST_F(Gmsh, ReadsWhatOtherProgramsWrite) {
  const HexahedralMesh plain = read(two_cubes);
  std::string old;
  for (const char c : two_cubes) old += c == '\n' ? '\r' : c;
  const std::pair<const char*, std::string> texts[] = {
      {"byte order mark", "\xEF\xBB\xBF" + two_cubes},
      {"comments first", "$Comments\nby hand\n$EndComments\n\n" + two_cubes},
      {"line ends of old machines", old},
      {"Fortran", replaced(two_cubes, "12 2 1 1", "12 2.0D+00 1.0d0 0.1D1")},
      {"plus", replaced(two_cubes, "12 2 1 1", "+12 +2.0 1 +1e0")},
  };
  for (const auto& [name, text] : texts) {
    SCOPED_TRACE(name);
    const HexahedralMesh mesh = read(text);
    EXPECT_EQ(mesh.vertices, plain.vertices);
    EXPECT_EQ(mesh.cells, plain.cells);
  }
}

/// Every cell with its lower face above the upper one.
TEST_F(Gmsh, TurnsAMeshThatIsInvertedAsAWhole) {
  std::string text = replaced(two_cubes, "1 2 5 4 7 8 11 10", "7 8 11 10 1 2 5 4");
  text = replaced(text, "2 3 6 5 8 9 12 11", "8 9 12 11 2 3 6 5");
  EXPECT_NEAR(size_of(read(text)).volume, 2, 1e-15);
  EXPECT_NEAR(size_of(read(text)).center[0], 1, 1e-15);
}

/// The two cubes with other lengths and in another place.
std::string cubes_at(double length, double thickness, double x0) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n12\n";
  for (int i = 0; i < 12; ++i)
    text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", i + 1, x0 + length * (i % 3), length * (i / 3 % 2),
                        thickness * (i / 6));
  return text + two_cubes.substr(two_cubes.find("$EndNodes"));
}

TEST_F(Gmsh, MindsNeitherPlaceNorUnitNorThickness) {
  for (const auto& [length, thickness, x0] :
       {std::array{1e150, 1e150, 0.0}, {1e-150, 1e-150, 0.0}, {1.0, 1.0, 1e9}, {1.0, 1e-9, 0.0}, {1e-9, 1.0, 0.0}}) {
    SCOPED_TRACE(fmt::format("{} {} {}", length, thickness, x0));
    const HexahedralMesh mesh = read(cubes_at(length, thickness, x0));
    EXPECT_EQ(mesh.cells.size(), 2u);
    const MeshSize size = size_of(mesh);
    EXPECT_NEAR((size.center[0] - x0) / length, 1, 1e-6);
    EXPECT_NEAR(size.radius / std::hypot(length, length / 2, thickness / 2), 1, 1e-6);
  }
}

TEST_F(Gmsh, SaysHowToSaveSuchAMesh) {
  const auto first = [](const char* other) { return replaced(two_cubes, "1 5 2 0 1 1 2 5 4 7 8 11 10", other); };
  const std::tuple<const char*, std::string, const char*> cases[] = {
      {"edges of second order", first("1 8 2 0 1 1 2 3"),
       ":21: expected hexahedra of 8 nodes (type 5), got an element of "
       "type 8, which is of second order; save the mesh with -order 1"},
      {"cells of second order", first("1 12 2 0 1 1 2 3"), "-order 1"},
      {"cells of third order", first("1 92 2 0 1 1 2 3"), "-order 1"},
      {"tetrahedra", first("1 4 2 0 1 1 2 5 7"), "a tetrahedron; Gmsh divides it"},
      {"triangles", first("1 2 2 0 1 1 2 5"), "a triangle; Gmsh divides it"},
      {"parameters", replaced(two_cubes, "$Nodes", "$ParametricNodes"), ":4: expected nodes without parameters"},
      {"binary", replaced(two_cubes, "2.2 0 8", "2.2 1 8"), ":2: expected an ASCII file, this one is binary; \"gmsh"},
      {"another version", replaced(two_cubes, "2.2 0 8", "4.1 0 8"), "got 4.1; \"gmsh FILE -format msh22 -save\""},
      {"version 1", "$NOD\n1\n1 0 0 0\n$ENDNOD\n",
       ":1: expected $MeshFormat, with which a file of Gmsh begins, got "
       "\"$NOD\"; expected version 2.2"},
      {"UTF-16", std::string("\xFF\xFE$\0M\0", 6), "this file is in UTF-16"},
      {"UTF-16, the other way", std::string("\xFE\xFF\0$\0M", 6), "this file is in UTF-16"},
      {"a word", replaced(two_cubes, "2 1 0 0", "2 1 zero 0"),
       ":7: expected three finite coordinates after the number of "
       "the node, got \"zero\""},
      {"a minus sign", replaced(two_cubes, "2 1 0 0", "2 \u22121 0 0"), "the minus sign U+2212"},
  };
  for (const auto& [name, text, message] : cases) EXPECT_THAT(refusal(text), HasSubstr(message)) << name;
}

TEST_F(Gmsh, RefusesWhatIsNotSuchAMesh) {
  EXPECT_THAT(refusal(""), HasSubstr("mesh.msh:1: expected $MeshFormat"));
  EXPECT_THAT(refusal("\x7f"
                      "ELF"),
              HasSubstr("expected $MeshFormat"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2.2 0 8", "4.1 0 8")), HasSubstr(":2: expected version 2.2"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2.2 0 8", "2.2 1 8")), HasSubstr(":2: expected an ASCII file"));
  EXPECT_THAT(refusal(replaced(two_cubes, "1 5 2 0 1 1 2 5 4 7 8 11 10", "1 4 2 0 1 1 2 5 7")),
              HasSubstr(":21: expected hexahedra of 8 nodes (type 5), got an element of type 4"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2 1 0 0", "2 nan 0 0")), HasSubstr(":7: expected three finite coordinates"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2 1 0 0", "2 1e999 0 0")), HasSubstr(":7: expected three finite"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2 1 0 0", "2 1 0")), HasSubstr(":7: expected three finite"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2 1 0 0", "1 1 0 0")), HasSubstr(":7: there are two nodes 1"));
  EXPECT_THAT(refusal(replaced(two_cubes, "8 11 10", "8 11 77")), HasSubstr(":21: there is no node 77"));
  EXPECT_THAT(refusal(replaced(two_cubes, "8 11 10", "8 11 11")), HasSubstr(":21: element 1 has a node twice"));
  EXPECT_THAT(refusal(replaced(two_cubes, "8 11 10", "8 11 10 12")), HasSubstr(":21: there is more on this line"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2\n1 5", "3\n1 5")), HasSubstr("expected the number of an element"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2\n1 5", "1\n1 5")), HasSubstr(":22: expected $EndElements"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2\n1 5", "99999999999999\n1 5")), HasSubstr("expected the number"));
  EXPECT_THAT(refusal(two_cubes.substr(0, two_cubes.find("2 5 2"))), HasSubstr("ends within $Elements; is it trunc"));
  EXPECT_THAT(refusal(two_cubes.substr(0, two_cubes.find("$Elements"))), HasSubstr("without the section $Elements"));
  EXPECT_THROW(read_gmsh(scratch_.path()), UserError);
  EXPECT_THROW(read_gmsh(scratch_ / "nowhere.msh"), UserError);
}

TEST_F(Gmsh, RefusesWhatIsNotOneBody) {
  EXPECT_THAT(refusal(replaced(two_cubes, "12 2 1 1", "12 0.2 1 1")), HasSubstr("element 2 is tangled"));
  EXPECT_THAT(refusal(replaced(two_cubes, "1 2 5 4 7 8 11 10", "7 8 11 10 1 2 5 4")),
              HasSubstr("element 1 is tangled"));
  EXPECT_THAT(refusal(replaced(two_cubes, "12\n1 0 0 0", "13\n99 5 5 5\n1 0 0 0")),
              HasSubstr("node 99 belongs to no hexahedron"));
  EXPECT_THAT(refusal(replaced(two_cubes, "2\n1 5", "3\n3 5 0 1 2 5 4 7 8 11 10\n1 5")), HasSubstr("share a face"));
  // The second cube has its own copy of node 11.
  std::string copied = replaced(two_cubes, "12\n1 0 0 0", "13\n99 1 1 1\n1 0 0 0");
  EXPECT_THAT(refusal(replaced(copied, "9 12 11", "9 12 99")), HasSubstr("the nodes 99 and 11 are at the same place"));
  // The second cube moved away.
  std::string apart = replaced(two_cubes, "12\n1 0 0 0", "16\n21 1.5 0 0\n22 1.5 1 0\n23 1.5 0 1\n24 1.5 1 1\n1 0 0 0");
  EXPECT_THAT(refusal(replaced(apart, "2 3 6 5 8 9 12 11", "21 3 6 22 23 9 12 24")), HasSubstr("in several pieces"));
}

/// The second cube is halved, and the first is not: its face has hanging nodes on two of its edges.
TEST_F(Gmsh, RefusesHangingNodes) {
  std::string text = replaced(two_cubes, "12\n1 0 0 0", "16\n21 1 0 0.5\n22 2 0 0.5\n23 2 1 0.5\n24 1 1 0.5\n1 0 0 0");
  text = replaced(text, "$Elements\n2\n", "$Elements\n3\n");
  text = replaced(text, "2 5 2 0 1 2 3 6 5 8 9 12 11", "2 5 0 2 3 6 5 21 22 23 24\n3 5 0 21 22 23 24 8 9 12 11");
  EXPECT_THAT(refusal(text), HasSubstr("hangs in the middle"));
}

/// Every damaged file is refused in one line or read as a body whose volume is positive; none is let through otherwise.
TEST_F(Gmsh, DamagedFilesDoNoHarm) {
  std::mt19937 generator(7);
  int n_refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string text = two_cubes;
    if (i % 2 == 0)
      text.resize(generator() % (text.size() - 1));
    else
      for (int n = 0; n <= i % 3; ++n) text[generator() % text.size()] = static_cast<char>(generator() % 256);
    try {
      const MeshSize size = size_of(read(text));
      EXPECT_GT(size.volume, 0);
      EXPECT_TRUE(std::isfinite(size.volume) && std::isfinite(size.radius));
    } catch (const UserError& error) {
      ++n_refused;
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  // All truncations but those in the last line's end, and most of the mutations.
  EXPECT_GT(n_refused, 300);
}

TEST(MeshFiles, AreBodiesOfTheirShapes) {
  const HexahedralMesh ellipsoid = read_gmsh(MESHES "/ellipsoid.msh"), rough = read_gmsh(MESHES "/rough_ball.msh");
  EXPECT_EQ(ellipsoid.cells.size(), 256u);
  EXPECT_EQ(rough.cells.size(), 256u);
  // Flat faces cut off what is between them and the surface: 6.5 % with 4 × 4 faces to a side of the cube.
  const double volume = 4 * std::numbers::pi / 3;
  EXPECT_NEAR(size_of(ellipsoid).volume / (volume * 1.3 * 0.8), 0.935, 1e-3);
  EXPECT_NEAR(size_of(rough).volume / volume, 0.935, 1e-2);
  EXPECT_NEAR(size_of(ellipsoid).radius, 1.3, 1e-12);
}

}  // namespace
}  // namespace pseudorigid::io
