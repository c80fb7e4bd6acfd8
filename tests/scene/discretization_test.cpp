/// The order in which discretisations are tried.

#include "scene/discretization.h"

#include <gtest/gtest.h>

#include "scene_files.h"

#include "scene/entries.h"

namespace pseudorigid::scene {
namespace {

Scene open(std::optional<int> degree, std::optional<int> refinements) {
  Scene scene = test::ball_scene();
  scene.continuum.degree = degree;
  scene.continuum.refinements = refinements;
  return scene;
}

TEST(Ladder, RisesInCostAndResolution) {
  const auto rungs = ladder(open({}, {}));
  EXPECT_EQ(rungs.front(), (Discretization{2, 0}));
  EXPECT_EQ(rungs.back(), (Discretization{largest_degree, largest_refinements_of_search}));
  for (std::size_t i = 1; i < rungs.size(); ++i) {
    EXPECT_GT(cost(rungs[i]), cost(rungs[i - 1]));
    EXPECT_GE(resolution(rungs[i]), 1.1 * resolution(rungs[i - 1]));
  }
}

/// On few curved cells high degree is the cheaper way to the same error (measured), so refinement comes last.
TEST(Ladder, RaisesTheDegreeFirst) {
  const auto rungs = ladder(open({}, {}));
  for (int k = 2; k <= largest_degree; ++k) EXPECT_EQ(rungs[static_cast<std::size_t>(k - 2)], (Discretization{k, 0}));
  EXPECT_EQ(rungs[static_cast<std::size_t>(largest_degree - 1)].refinements, 1);
}

TEST(Ladder, HonoursWhatIsGiven) {
  const auto degrees = ladder(open({}, 3));
  EXPECT_EQ(degrees.size(), static_cast<std::size_t>(largest_degree - 1));
  for (const auto& d : degrees) EXPECT_EQ(d.refinements, 3);
  EXPECT_EQ(ladder(open(3, {})), (std::vector<Discretization>{{3, 0}, {3, 1}, {3, 2}}));
}

TEST(FixedDiscretization, IsThereIfBothAreGiven) {
  EXPECT_EQ(fixed_discretization(open(5, 1)), (Discretization{5, 1}));
  EXPECT_FALSE(fixed_discretization(open({}, 1)));
  EXPECT_FALSE(fixed_discretization(open(5, {})));
}

TEST(Companion, IsCoarserWhereThereIsACoarserOne) {
  EXPECT_EQ(companion({4, 1}), (Discretization{3, 1}));
  EXPECT_EQ(companion({2, 2}), (Discretization{2, 1}));
  EXPECT_EQ(companion({2, 0}), (Discretization{3, 0}));
}

/// In steps of two, to a richer body while that is cheap.
TEST(Companion, OfAPolynomialBodyIsAnotherWhichTheProgramHas) {
  for (int N = 1; N <= largest_polynomial_degree; ++N) {
    EXPECT_EQ(std::abs(companion_degree(N) - N), 2);
    EXPECT_GE(companion_degree(N), 1);
    EXPECT_LE(companion_degree(N), largest_polynomial_degree);
  }
}

TEST(Descriptions, AreForPeople) {
  EXPECT_EQ(describe(Discretization{4, 0}), "degree 4, unrefined");
  EXPECT_EQ(describe(Discretization{4, 1}), "degree 4, refined once");
  EXPECT_EQ(describe(Discretization{4, 2}), "degree 4, refined 2 times");
}

}  // namespace
}  // namespace pseudorigid::scene
