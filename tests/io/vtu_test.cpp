#include "io/vtu.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "io/ball_blocks.h"
#include "io/block_cells.h"
#include "io/body_picture.h"
#include "io/files.h"
#include "io/pvd.h"
#include "io/report_frames.h"
#include "io/vtu_reader.h"
#include "scene/user_error.h"
#include "scratch.h"

namespace pseudorigid::io::test {
namespace {

UnstructuredGrid triangle() {
  return {.points = {0, 0, 0, 1, 0, 0, 0, 1, 0},
          .cell_type = CellType::triangle,
          .nodes_per_cell = 3,
          .connectivity = {0, 1, 2},
          .fields = {{"height", 1, {1, 2, 3}}},
          .constants = {{"TimeValue", 1, {0.1}}}};
}

TEST(Vtu, SameGridSameBytesAndNothingOfTheMachine) {
  const ScratchDirectory scratch;
  write_vtu(scratch / "a.vtu", triangle());
  write_vtu(scratch / "b.vtu", triangle());
  const std::string text = contents(scratch / "a.vtu");
  EXPECT_EQ(text, contents(scratch / "b.vtu"));
  EXPECT_NE(text.find("version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
                      "compressor=\"vtkZLibDataCompressor\""),
            text.npos);
  EXPECT_NE(text.find("Name=\"height\" format=\"appended\" offset="), text.npos);
  EXPECT_NE(text.find("<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">"
                      "0.10000000000000001</DataArray>"),
            text.npos);
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
  refused([](auto& grid) { grid.constants[0].values[0] = NAN; });
  refused([](auto& grid) { grid.constants[0].values.push_back(0); });
  EXPECT_THROW(write_vtu(scratch / "none/a.vtu", triangle()), WriteError);
}

TEST(Vtu, IsReadAsItWasWritten) {
  const ScratchDirectory scratch;
  UnstructuredGrid grid = triangle();
  grid.fields.push_back({"vector", 3, std::vector<double>(9, -2.5)});
  write_vtu(scratch / "a.vtu", grid);
  const std::vector<std::string> fields{"vector", "absent", "height"};
  const UnstructuredGrid read = read_vtu(scratch / "a.vtu", fields);
  EXPECT_EQ(read.points, grid.points);
  EXPECT_EQ(read.connectivity, grid.connectivity);
  EXPECT_EQ(read.cell_type, grid.cell_type);
  EXPECT_EQ(read.nodes_per_cell, 3);
  ASSERT_EQ(read.fields.size(), 2u);
  EXPECT_EQ(read.fields[0].name, "vector");
  EXPECT_EQ(read.fields[0].values, grid.fields[1].values);
  EXPECT_EQ(read.fields[1].values, grid.fields[0].values);
  ASSERT_EQ(read.constants.size(), 1u);
  EXPECT_EQ(read.constants[0].values, std::vector{0.1});
}

TEST(Vtu, DamagedFilesAreRefused) {
  const ScratchDirectory scratch;
  write_vtu(scratch / "a.vtu", triangle());
  const std::string whole = contents(scratch / "a.vtu");
  const std::vector<std::string> fields{"height"};  // the last array of the file
  EXPECT_THROW(read_vtu(scratch / "none.vtu", fields), UserError);
  const std::size_t end_of_arrays = whole.find("\n</AppendedData>");
  for (std::size_t length = 0; length < end_of_arrays; length += 7) {
    put(scratch / "b.vtu", whole.substr(0, length));
    EXPECT_THROW(read_vtu(scratch / "b.vtu", fields), UserError) << length;
  }
  // Any other byte gives a grid or an error, and never leaves the file.
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string other = whole;
    other[at] = static_cast<char>(other[at] ^ 0x55);
    put(scratch / "b.vtu", other);
    try {
      read_vtu(scratch / "b.vtu", fields);
    } catch (const UserError&) {
    }
  }
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
}

TEST(Pvd, GoesOnWithWhatAnEarlierRunHasLeft) {
  const ScratchDirectory scratch;
  EXPECT_TRUE(PvdCollection::resume(scratch / "none.pvd", 1).frames().empty());
  PvdCollection whole(scratch / "whole.pvd");
  for (const int j : {0, 1, 2}) whole.add(0.1 * j, scratch / fmt::format("graphics/{}.vtu", j));
  std::filesystem::copy(scratch / "whole.pvd", scratch / "parts.pvd");
  PvdCollection resumed = PvdCollection::resume(scratch / "parts.pvd", 0.15);
  ASSERT_EQ(resumed.frames().size(), 2u);
  resumed.add(0.2, scratch / "graphics/2.vtu");
  EXPECT_EQ(contents(scratch / "parts.pvd"), contents(scratch / "whole.pvd"));
}

/// Sum over the linear hexahedra of their volumes, each from the Jacobian at its centre; all must be positive.
double volume(const UnstructuredGrid& grid) {
  constexpr int signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                               {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  double sum = 0;
  for (std::size_t cell = 0; cell < grid.n_cells(); ++cell) {
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (int corner = 0; corner < 8; ++corner)
      jacobian += Eigen::Vector3d::Map(&grid.points[3 * grid.connectivity[8 * cell + corner]]) *
                  Eigen::RowVector3d(signs[corner][0], signs[corner][1], signs[corner][2]) / 4;
    EXPECT_GT(jacobian.determinant(), 0) << "cell " << cell;
    sum += jacobian.determinant();
  }
  return sum;
}

/// The unit ball at x = x_c + QX with ẋ = HX, all of it under one stress.
mechanics::BodyFields affine_fields(const BallBlocks& ball, const Eigen::Matrix3d& Q, const Eigen::Matrix3d& H,
                                    const Eigen::Matrix3d& stress, const Eigen::Vector3d& center) {
  mechanics::BodyFields fields;
  for (const Eigen::Vector3d& X : ball.points) fields.add(X, center + Q * X, H * X, Q, stress, 0.25);
  fields.center = center;
  fields.moment = 4 * std::numbers::pi / 15 * Q;
  return fields;
}

TEST(BallBlocks, FillTheBallAndShareTheirPoints) {
  for (const auto& [degree, n] : {std::pair{1, 1}, std::pair{1, 12}, std::pair{4, 2}, std::pair{3, 1}}) {
    const BallBlocks ball = ball_blocks(degree, n);
    const auto m = static_cast<std::size_t>(degree * n), layers = static_cast<std::size_t>(degree);
    EXPECT_EQ(ball.points.size(), (m + 1) * (m + 1) * (m + 1) + layers * (6 * m * m + 2));
    EXPECT_EQ(ball.blocks.n_blocks(), std::size_t(n * n * n + 6 * n * n));
    EXPECT_EQ(std::ranges::count_if(ball.points, [](const auto& X) { return std::abs(X.norm() - 1) < 1e-15; }),
              6 * m * m + 2);
    UnstructuredGrid grid;
    for (const auto& X : ball.points) grid.points.insert(grid.points.end(), X.begin(), X.end());
    set_cells(grid, ball.blocks, scene::Cells::linear);
    EXPECT_EQ(grid.n_cells(), m * m * m + 6 * m * m * layers);
    const double inside = volume(grid);
    // Hexahedra with straight edges are inscribed in the ball, and the rule of one point sees them smaller: a twentieth
    // with eight of them along a quarter of a circle and one layer or four between the cube and the surface.
    if (m >= 8) {
      EXPECT_NEAR(inside, 4 * std::numbers::pi / 3, 0.05 * 4 * std::numbers::pi / 3);
    }
  }
}

TEST(BallBlocks, AreFoundAgainInTheirCells) {
  for (const auto& [degree, n] : {std::pair{1, 1}, std::pair{2, 1}, std::pair{4, 2}, std::pair{3, 2}, std::pair{5, 1}})
    for (const auto cells : {scene::Cells::linear, scene::Cells::lagrange}) {
      const BallBlocks ball = ball_blocks(degree, n);
      UnstructuredGrid grid;
      set_cells(grid, ball.blocks, cells);
      const auto found = blocks_of(grid);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->degree, degree) << n;
      EXPECT_EQ(found->points, ball.blocks.points) << degree << ' ' << n;
    }
  UnstructuredGrid flat = triangle();
  EXPECT_FALSE(blocks_of(flat));
}

TEST(PictureFaces, AreTheSurfaceAndThePlanesOnce) {
  const BallBlocks ball = ball_blocks(3, 2);
  const Eigen::Matrix3d Id = Eigen::Matrix3d::Identity(), Q = Eigen::Vector3d(1.2, 1, 0.9).asDiagonal();
  const UnstructuredGrid grid =
      body_picture(ball.blocks, affine_fields(ball, Q, Id, Id, Eigen::Vector3d::Zero()), 0, {},
                   {.displacement = true, .velocity = false, .stress = true}, scene::Cells::linear);
  const std::vector<PictureFace> faces = faces_of({grid});
  const auto& X = grid.fields[2];
  ASSERT_EQ(X.name, "reference_coordinates");
  std::map<int, int> numbers;
  for (const PictureFace& face : faces) {
    ++numbers[face.plane];
    ASSERT_EQ(face.points.size(), 16u);
    for (const auto& [piece, point] : face.points) {
      const auto at = Eigen::Vector3d::Map(&X.values[3 * point]);
      if (face.plane == 0)
        EXPECT_NEAR(at.norm(), 1, 1e-14);
      else
        EXPECT_NEAR(at[face.plane - 1], 0, 1e-14);
    }
  }
  // Of the six shells four faces each are on the surface. A plane cuts four faces of the cube and two of each of four
  // shells.
  EXPECT_EQ(numbers, (std::map<int, int>{{0, 24}, {1, 12}, {2, 12}, {3, 12}}));
  EXPECT_TRUE(faces_of({triangle()}).empty());
}

TEST(BodyPicture, ShowsWhatTheFieldsOfAnAffineMotionAre) {
  const BallBlocks ball = ball_blocks(2, 1);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, 2, -2) / 3).toRotationMatrix();
  const Eigen::Matrix3d U = Eigen::Vector3d(1.5, 0.8, 0.6).asDiagonal(), Q = R * U;
  Eigen::Matrix3d H, stress;
  H << 0, 1, 2, 3, 4, 5, 6, 7, 8;
  stress << 3, 0, 0, 0, 1, 0, 0, 0, -1;  // deviator (2, 0, -2)
  const Eigen::Vector3d center(10, 20, 30);
  const Units units{.length = 2, .mass = 3, .time = 5};
  const UnstructuredGrid grid =
      body_picture(ball.blocks, affine_fields(ball, Q, H, stress, center), 0.7, units, {}, scene::Cells::linear);
  const auto values = [&](const std::vector<UnstructuredGrid::Field>& fields, const std::string& name) {
    return std::ranges::find(fields, name, &UnstructuredGrid::Field::name)->values;
  };
  const auto vector = [&](const std::string& name, std::size_t i) {
    return Eigen::Vector3d(&values(grid.fields, name)[3 * i]);
  };
  ASSERT_EQ(grid.n_points(), ball.points.size());
  for (std::size_t i = 0; i < ball.points.size(); ++i) {
    const Eigen::Vector3d X = 2 * ball.points[i], x(&grid.points[3 * i]);
    EXPECT_LT((x - 2 * center - Q * X).norm(), 1e-13);
    EXPECT_LT((vector("displacement", i) - (x - X)).norm(), 1e-13);
    EXPECT_LT((vector("displacement_without_rotation", i) - R * (U * X - X)).norm(), 1e-13);
    EXPECT_LT((vector("reference_coordinates", i) - X).norm(), 1e-15);
    EXPECT_LT((vector("velocity", i) - H * X / 5).norm(), 1e-13);
    EXPECT_LT((vector("principal_stretches", i) - Eigen::Vector3d(1.5, 0.8, 0.6)).norm(), 1e-14);
    EXPECT_NEAR(values(grid.fields, "jacobian")[i], 0.72, 1e-14);
    const double pressure_unit = units.stress();
    EXPECT_NEAR(values(grid.fields, "pressure")[i], -pressure_unit, 1e-15);
    EXPECT_NEAR(values(grid.fields, "von_mises")[i], std::sqrt(12.) * pressure_unit, 1e-14);
    EXPECT_NEAR(values(grid.fields, "energy_density")[i], 0.25 * pressure_unit, 1e-15);
    for (int j = 0; j < 9; ++j) {
      EXPECT_DOUBLE_EQ(values(grid.fields, "deformation_gradient")[9 * i + j], Q(j / 3, j % 3));
      EXPECT_DOUBLE_EQ(values(grid.fields, "cauchy_stress")[9 * i + j], pressure_unit * stress(j / 3, j % 3));
    }
  }
  EXPECT_EQ(values(grid.constants, "TimeValue"), std::vector{0.7});
  EXPECT_EQ(values(grid.constants, "center_of_mass"), (std::vector<double>{20, 40, 60}));
  for (int j = 0; j < 9; ++j) EXPECT_NEAR(values(grid.constants, "rotation")[j], R(j / 3, j % 3), 1e-14);
}

/// The body is an ellipsoid. As in curved elements, only the corners of its block faces are exactly on the surface.
TEST(BodyPicture, HasThePressureOfPlanesOnTheSurfaceOnly) {
  const BallBlocks ball = ball_blocks(2, 1);
  const Eigen::Vector3d axes(1, 0.9, 1.2);
  const Eigen::Matrix3d Id = Eigen::Matrix3d::Identity(), H = Eigen::Vector3d(0, 0, 0.5).asDiagonal();
  mechanics::BodyFields fields = affine_fields(ball, axes.asDiagonal(), H, Id, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < ball.points.size(); ++i) {
    const bool is_corner = (ball.points[i].cwiseAbs().array() > 1e-12).all();
    Eigen::Vector3d::Map(&fields.X[3 * i]) = (is_corner ? 1 : 1 - 1e-4) * axes.cwiseProduct(ball.points[i]);
  }
  const loads::Plane floor{.position = -0.8, .stiffness = 50, .damping = 2};
  const loads::Plane roof{.normal = -Eigen::Vector3d::UnitZ(), .position = -1.1, .stiffness = 30};
  const Units units{.length = 2, .mass = 3, .time = 5};
  const UnstructuredGrid grid = body_picture(ball.blocks, fields, 0, units, {}, scene::Cells::linear,
                                             {.planes = {floor, roof}, .semi_axes = axes});
  const auto field = std::ranges::find(grid.fields, "contact_pressure", &UnstructuredGrid::Field::name);
  ASSERT_NE(field, grid.fields.end());
  int n_pressed = 0;
  for (std::size_t i = 0; i < ball.points.size(); ++i) {
    const bool is_outside = ball.points[i].norm() > 1 - 1e-12;
    const double z = 1.2 * ball.points[i][2], rate = -0.5 * ball.points[i][2];  // of the penetration
    const double expected = z < -0.8 ? 50 * (-0.8 - z) * (1 + 2 * rate) : z > 1.1 ? 30 * (z - 1.1) : 0;
    EXPECT_NEAR(field->values[i], is_outside ? units.stress() * expected : 0, 1e-12) << i;
    n_pressed += is_outside && expected > 0;
  }
  EXPECT_GT(n_pressed, 2);
  const UnstructuredGrid free = body_picture(ball.blocks, fields, 0, units, {}, scene::Cells::linear);
  EXPECT_EQ(std::ranges::find(free.fields, "contact_pressure", &UnstructuredGrid::Field::name), free.fields.end());
}

TEST(BodyPicture, HoldsTheGroupsOfFieldsThatAreAskedFor) {
  const BallBlocks ball = ball_blocks(1, 1);
  const Eigen::Matrix3d Id = Eigen::Matrix3d::Identity();
  const scene::Fields wanted{
      .displacement = false, .velocity = true, .stress = false, .deformation = false, .energy = false};
  const UnstructuredGrid grid = body_picture(ball.blocks, affine_fields(ball, Id, Id, Id, Eigen::Vector3d::Zero()), 0,
                                             {}, wanted, scene::Cells::linear);
  ASSERT_EQ(grid.fields.size(), 1u);
  EXPECT_EQ(grid.fields[0].name, "velocity");
}

}  // namespace
}  // namespace pseudorigid::io::test
