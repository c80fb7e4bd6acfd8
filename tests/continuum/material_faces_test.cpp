/// The surfaces that a picture shows: where they lie in the undeformed body, and where an affine motion carries them.

#include "continuum/output/material_faces.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

using continuum::MaterialFaces;

class MaterialFacesOfTheBall : public ::testing::TestWithParam<int> {};

TEST_P(MaterialFacesOfTheBall, LieOnTheSphereAndThePlanesAndMoveWithTheBody) {
  for (const Sector& sector : {whole, quarter, octant}) {
    const ElasticBall ball(sector, GetParam(), 0, neo_hookean);
    std::mt19937 generator(3);
    const Matrix3d Q = admissible(sector, Matrix3d::Identity() + 0.3 * random_matrix(generator));
    const MaterialFaces faces(ball.space());
    const std::vector<std::vector<double>> rows = faces.rows(ball.affine_field(Q));
    ASSERT_EQ(rows.size(), faces.n_points());
    std::map<double, int> points_of_face;
    std::set<double> planes;
    for (const std::vector<double>& row : rows) {
      ASSERT_EQ(row.size(), MaterialFaces::columns.size());
      const double face = row[0], plane = row[1];
      const Vector3d X(&row[2]), x(&row[5]);
      ++points_of_face[face];
      planes.insert(plane);
      // On the sphere to the error of the geometry, which is that of interpolation between its nodes.
      if (plane == 0)
        EXPECT_NEAR(X.norm(), 1, GetParam() == 2 ? 2e-2 : 1e-3);
      else
        EXPECT_NEAR(X[static_cast<int>(plane) - 1], 0, 1e-12);
      EXPECT_LE(X.norm(), 1.02);
      EXPECT_LT((x - Q * X).norm(), 1e-13);
    }
    EXPECT_EQ(planes, (std::set<double>{0, 1, 2, 3}));
    // Numbered from 1 without gaps, each with as many points.
    EXPECT_EQ(points_of_face.begin()->first, 1);
    EXPECT_EQ(points_of_face.rbegin()->first, static_cast<double>(points_of_face.size()));
    for (const auto& [face, n_points] : points_of_face) EXPECT_EQ(n_points, points_of_face.at(1));
  }
}

INSTANTIATE_TEST_SUITE_P(Degree, MaterialFacesOfTheBall, ::testing::Values(2, 4));

}  // namespace
}  // namespace pseudorigid::testing
