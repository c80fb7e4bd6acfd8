#include "io/vtu.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/ellipsoid_surface.h"
#include "io/files.h"
#include "io/pvd.h"
#include "scratch.h"

namespace pseudorigid::io::test {
namespace {

UnstructuredGrid triangle() {
  return {.points = {0, 0, 0, 1, 0, 0, 0, 1, 0},
          .cell_type = CellType::triangle,
          .nodes_per_cell = 3,
          .connectivity = {0, 1, 2},
          .fields = {{"height", 1, {1, 2, 3}}}};
}

/// Volume inside a closed surface of quads, as the sum of two signed tetrahedra each; positive if they look outward.
double enclosed_volume(const std::vector<Eigen::Vector3d>& x, const std::vector<std::int64_t>& cells) {
  double volume = 0;
  for (std::size_t c = 0; c < cells.size(); c += 4)
    for (const auto& [i, j] : {std::pair{1, 2}, std::pair{2, 3}})
      volume += x[cells[c]].dot(x[cells[c + i]].cross(x[cells[c + j]])) / 6;
  return volume;
}

TEST(Base64, AgreesWithTheVectorsOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\x00\xff\xfe\xfb", 4)), "AP/++w==");
}

TEST(Vtu, SameGridSameBytesAndNothingOfTheMachine) {
  const ScratchDirectory scratch;
  write_vtu(scratch / "a.vtu", triangle());
  write_vtu(scratch / "b.vtu", triangle());
  const std::string text = contents(scratch / "a.vtu");
  EXPECT_EQ(text, contents(scratch / "b.vtu"));
  EXPECT_NE(text.find("version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\""), text.npos);
  EXPECT_NE(text.find("Name=\"height\" format=\"binary\">GAAAAAAAAAAAAAAAAADwPw"), text.npos);
}

TEST(Vtu, GridsThatDoNotFitTogetherAreDefects) {
  const ScratchDirectory scratch;
  const auto refused = [&](auto&& spoil) {
    UnstructuredGrid grid = triangle();
    spoil(grid);
    EXPECT_THROW(write_vtu(scratch / "a.vtu", grid), std::logic_error);
    EXPECT_FALSE(std::filesystem::exists(scratch / "a.vtu"));
  };
  refused([](auto& grid) { grid.points.pop_back(); });
  refused([](auto& grid) { grid.points[4] = NAN; });
  refused([](auto& grid) { grid.connectivity[2] = 3; });
  refused([](auto& grid) { grid.connectivity[0] = -1; });
  refused([](auto& grid) { grid.connectivity.pop_back(); });
  refused([](auto& grid) { grid.fields[0].values.push_back(0); });
  refused([](auto& grid) { grid.fields[0].n_components = 3; });
  refused([](auto& grid) { grid.fields[0].values[1] = INFINITY; });
  EXPECT_THROW(write_vtu(scratch / "none/a.vtu", triangle()), WriteError);
}

TEST(Pvd, ListsFramesRelativeToItself) {
  const ScratchDirectory scratch;
  PvdCollection first(scratch / "reduced.pvd");
  first.add(0, scratch / "graphics/reduced-000000.vtu");
  first.add(0.1, scratch / "graphics/reduced-000001.vtu");
  const std::string text = contents(scratch / "reduced.pvd");
  EXPECT_NE(text.find("<DataSet timestep=\"0.10000000000000001\" part=\"0\" file=\"graphics/reduced-000001.vtu\"/>"),
            text.npos)
      << text;
  PvdCollection resumed(scratch / "again.pvd", {{0, scratch / "graphics/reduced-000000.vtu"}});
  resumed.add(0.1, scratch / "graphics/reduced-000001.vtu");
  EXPECT_EQ(resumed.n_frames(), 2u);
  EXPECT_EQ(contents(scratch / "again.pvd"), text);
}

TEST(CubedSphere, IsClosedOutwardAndOnTheSphere) {
  for (const int n : {1, 2, 5, 8}) {
    const CubedSphere sphere(n);
    EXPECT_EQ(sphere.points.size(), std::size_t(6 * n * n + 2));
    EXPECT_EQ(sphere.connectivity.size(), std::size_t(4 * 6 * n * n));
    for (const auto& X : sphere.points) EXPECT_NEAR(X.norm(), 1, 1e-15);
    std::vector<int> n_cells_at(sphere.points.size());
    for (const auto i : sphere.connectivity) ++n_cells_at[i];
    EXPECT_EQ(std::ranges::count(n_cells_at, 3), 8);  // the corners of the cube; elsewhere four cells meet
    EXPECT_EQ(std::ranges::count(n_cells_at, 4), 6 * n * n - 6);
    for (std::size_t c = 0; c < sphere.connectivity.size(); c += 4) {
      const auto X = [&](int i) { return sphere.points[sphere.connectivity[c + i]]; };
      EXPECT_GT((X(2) - X(0)).cross(X(3) - X(1)).dot(X(0) + X(2)), 0);
    }
  }
  const CubedSphere fine(64);
  EXPECT_NEAR(enclosed_volume(fine.points, fine.connectivity), 4 * std::numbers::pi / 3, 2e-3);
}

TEST(EllipsoidSurface, IsTheImageOfTheSphereWithHomogeneousFields) {
  const CubedSphere sphere(6);
  HomogeneousState state;
  state.Q << 1.5, 0.2, 0, 0, 0.8, 0.1, 0.3, 0, 0.9;
  state.cauchy_stress << 3, 0, 0, 0, 1, 0, 0, 0, -1;  // deviator (2, 0, -2)
  state.center << 10, 20, 30;
  state.radius = 2;
  const UnstructuredGrid grid = ellipsoid_surface(sphere, state);
  ASSERT_EQ(grid.n_points(), sphere.points.size());
  ASSERT_EQ(grid.n_cells(), 6u * 36);
  const auto field = [&](const std::string& name) {
    return std::ranges::find(grid.fields, name, &UnstructuredGrid::Field::name)->values;
  };
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    const Eigen::Vector3d x(&grid.points[3 * i]), u(&field("displacement")[3 * i]);
    EXPECT_NEAR((state.Q.inverse() * (x - state.center)).norm(), 2, 1e-13);  // on the ellipsoid
    EXPECT_NEAR((x - u - 2 * sphere.points[i]).norm(), 0, 1e-13);
    EXPECT_DOUBLE_EQ(field("pressure")[i], -1);
    EXPECT_DOUBLE_EQ(field("jacobian")[i], state.Q.determinant());
    EXPECT_DOUBLE_EQ(field("von_mises")[i], std::sqrt(12.));
  }
}

}  // namespace
}  // namespace pseudorigid::io::test
