/// What scenes need and skip, and the sector of the ball.

#include "scene/needs.h"

#include <algorithm>

#include "scene_files.h"

namespace pseudorigid::scene {
namespace {

bool mentions(const std::vector<std::string>& lines, const std::string& words) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

struct SectorCase {
  const char* name;
  std::vector<std::pair<int, int>> deformation, velocity;  ///< entries (from 1) that are not zero off the diagonal
  Symmetry symmetry;
  std::string sector;
  int n_images;
};

std::ostream& operator<<(std::ostream& out, const SectorCase& c) { return out << c.name; }

class SectorTest : public ::testing::TestWithParam<SectorCase> {};

TEST_P(SectorTest, IsTheSmallestOneOrTheOneAskedFor) {
  Scene scene = test::ball_scene();
  for (const auto& [i, j] : GetParam().deformation) scene.initial_state.deformation[i - 1][j - 1] = 1e-300;
  for (const auto& [i, j] : GetParam().velocity) scene.initial_state.velocity[i - 1][j - 1] = -1;
  scene.continuum.symmetry = GetParam().symmetry;
  const Sector result = sector(scene);
  EXPECT_EQ(result.name(), GetParam().sector);
  EXPECT_EQ(result.n_images(), GetParam().n_images);
  const bool warns = result.reason.find("motions that would break the symmetry are excluded") != std::string::npos;
  EXPECT_EQ(warns, result.n_images() > 1) << result.reason;
}

INSTANTIATE_TEST_SUITE_P(
    All, SectorTest,
    ::testing::Values(SectorCase{"diagonal", {}, {}, Symmetry::automatic, "octant", 8},
                      SectorCase{"shear_12", {{1, 2}}, {}, Symmetry::automatic, "half (plane z)", 2},
                      SectorCase{"shear_21", {{2, 1}}, {}, Symmetry::automatic, "half (plane z)", 2},
                      SectorCase{"shear_13", {{1, 3}}, {}, Symmetry::automatic, "half (plane y)", 2},
                      SectorCase{"shear_32", {{3, 2}}, {}, Symmetry::automatic, "half (plane x)", 2},
                      SectorCase{"spin_about_z", {}, {{1, 2}, {2, 1}}, Symmetry::automatic, "half (plane z)", 2},
                      SectorCase{"two_shears", {{1, 2}}, {{2, 3}}, Symmetry::automatic, "full ball", 1},
                      SectorCase{"asked_none", {}, {}, Symmetry::none, "full ball", 1},
                      SectorCase{"asked_x", {}, {}, Symmetry::x, "half (plane x)", 2},
                      SectorCase{"asked_xy", {}, {}, Symmetry::xy, "quarter (planes x, y)", 4},
                      SectorCase{"asked_xz", {}, {}, Symmetry::xz, "quarter (planes x, z)", 4},
                      SectorCase{"asked_yz", {}, {}, Symmetry::yz, "quarter (planes y, z)", 4},
                      SectorCase{"asked_octant", {}, {}, Symmetry::octant, "octant", 8}));

/// A load or a motion of the centre of mass breaks the planes that it is not symmetric to, and no others.
TEST(SectorOfLoads, IsWhatEachOfThemAdmits) {
  const auto name = [](auto&& change) {
    Scene scene = test::ball_scene();
    change(scene);
    return sector(scene).name();
  };
  EXPECT_EQ(name([](Scene& s) { s.loads.get<loads::Tide>().tensor[0][0] = 1; }), "octant");
  EXPECT_EQ(name([](Scene& s) {
              s.loads.get<loads::Tide>().tensor = {{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}};
            }),
            "half (plane z)");
  EXPECT_EQ(name([](Scene& s) { s.loads.get<loads::Traction>().nominal_stress[2][2] = 1; }), "octant");
  EXPECT_EQ(name([](Scene& s) { s.loads.get<loads::Traction>().nominal_stress[1][2] = 1; }), "half (plane x)");
  EXPECT_EQ(name([](Scene& s) { s.loads.get<loads::Acceleration>().acceleration[0] = 1; }), "quarter (planes y, z)");
  EXPECT_EQ(name([](Scene& s) { s.initial_state.center[1] = -1; }), "quarter (planes x, z)");
  EXPECT_EQ(name([](Scene& s) { s.initial_state.center_velocity = {1, 1, 1}; }), "full ball");
  EXPECT_EQ(name([](Scene& s) { s.loads = {loads::Viscosity{1}, loads::Drag{1}}; }), "octant");
}

/// Whatever the list holds: numbers break no plane, entries (i, j) of matrices those with the normals i and j, entries
/// i of vectors that with the normal i. Rigid planes, of which there are none at first, are below.
TEST(SectorOfLoads, FollowsFromTheKindsOfTheirEntries) {
  Scene scene = test::ball_scene();
  const auto broken = [&] {
    std::array<bool, 3> planes{};
    for (int i = 0; i < 3; ++i) planes[i] = breaks_plane(scene, i).has_value();
    return planes;
  };
  using Planes = std::array<bool, 3>;
  int n_entries = 0;
  loads::visit_entries(scene.loads, [&](auto& member, const auto&, const About& about) {
    SCOPED_TRACE(about.path);
    ++n_entries;
    const auto before = member;
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Matrix3>) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          member[i][j] = 1;
          Planes expected{};
          if (i != j) expected[i] = expected[j] = true;
          EXPECT_EQ(broken(), expected);
          EXPECT_EQ(keeps_diagonal(scene), i == j);
          member = before;
        }
    } else if constexpr (std::is_same_v<std::decay_t<decltype(member)>, std::vector<double>>) {
      for (int i = 0; i < static_cast<int>(member.size()); ++i) {
        member[i] = 1;
        Planes expected{};
        expected[i] = true;
        EXPECT_EQ(broken(), expected);
        EXPECT_TRUE(keeps_diagonal(scene));
        member = before;
      }
    } else {
      member = 1;
      EXPECT_EQ(broken(), Planes{});
      member = before;
    }
  });
  EXPECT_GE(n_entries, 6);
}

/// Rigid planes admit a reflection that takes every plane to one of them.
TEST(SectorOfLoads, OfRigidPlanesNeedsTheirMirrorImages) {
  const auto name = [](std::vector<double> normals, std::vector<double> points) {
    Scene scene = test::ball_scene();
    scene.loads.get<loads::RigidPlanes>() = {
        .normals = std::move(normals), .points = std::move(points), .stiffness = {}};
    return sector(scene).name();
  };
  EXPECT_EQ(name({0, 0, 1}, {0, 0, -2}), "quarter (planes x, y)");
  EXPECT_EQ(name({0, 0, 1, 0, 0, -1}, {0, 0, -2, 0, 0, 2}), "octant");
  EXPECT_EQ(name({0, 0, 1, 0, 0, -1}, {0, 0, -2, 0, 0, 3}), "quarter (planes x, y)");
  EXPECT_EQ(name({1, 0, 1, -1, 0, 1}, {-2, 0, 0, 2, 0, 0}), "quarter (planes x, y)");
  EXPECT_EQ(name({1, 0, 1}, {-2, 0, 0}), "half (plane y)");
  EXPECT_EQ(name({0.1, 0.2, 1}, {0, 0, -3}), "full ball");
}

/// Planes in motion need images that move alike.
TEST(SectorOfLoads, OfPlanesInMotionNeedsImagesWithTheSameMotion) {
  const auto name = [](std::vector<double> speeds, std::vector<double> amplitudes) {
    Scene scene = test::ball_scene();
    auto& planes = scene.loads.get<loads::RigidPlanes>();
    planes.normals = {0, 0, 1, 0, 0, -1};
    planes.points = {0, 0, -2, 0, 0, 2};
    planes.speeds = std::move(speeds);
    planes.amplitudes = std::move(amplitudes);
    planes.frequency = 3;
    return sector(scene).name();
  };
  EXPECT_EQ(name({}, {}), "octant");
  EXPECT_EQ(name({0.1, 0.1}, {0.2, 0.2}), "octant");
  EXPECT_EQ(name({0.1, 0}, {}), "quarter (planes x, y)");
  EXPECT_EQ(name({}, {0.1, -0.1}), "quarter (planes x, y)");
}

TEST(Contact, HasItsColumnsOnlyWithPlanes) {
  Scene scene = test::ball_scene();
  EXPECT_FALSE(needs(scene).contact);
  EXPECT_FALSE(needs(scene).quantities.contact);
  scene.loads.get<loads::RigidPlanes>() = {.normals = {0, 0, 1}, .points = {0, 0, -2}, .stiffness = {}};
  EXPECT_TRUE(needs(scene).contact);
  EXPECT_TRUE(needs(scene).quantities.contact);
}

TEST(DiscretizationErrorOfNeeds, IsACompanionWhereTheModelsAreComparedOnAGivenMesh) {
  Scene scene = test::ball_scene();
  EXPECT_TRUE(needs(scene).companion);
  EXPECT_TRUE(
      mentions(needs(scene).needed, "discretisation error: estimated by a companion run (degree 3, unrefined)"));
  scene.continuum.error_estimate = ErrorEstimate::none;
  EXPECT_FALSE(needs(scene).companion);
  EXPECT_TRUE(mentions(needs(scene).skipped, "Continuum/Error estimate is none; no companion run"));
  scene.continuum.degree.reset();
  EXPECT_FALSE(needs(scene).companion);
  EXPECT_TRUE(mentions(needs(scene).needed, "discretisation error: estimated by runs on coarser discretisations"));
  EXPECT_TRUE(mentions(needs(scene).needed, "degree auto, refinements 0: the cheapest"));
  scene = test::ball_scene();
  scene.models = {"continuum"};
  EXPECT_FALSE(needs(scene).companion);
  EXPECT_TRUE(mentions(needs(scene).skipped, "discretisation error: a scene without a comparison does not need it"));
}

TEST(QuadratureErrorOfNeeds, IsThatOfPolynomialBodiesWhoseMotionIsPrinted) {
  Scene scene = test::ball_scene();
  EXPECT_FALSE(needs(scene).quadrature_error);
  scene.models = {"reduced", "polynomial"};
  EXPECT_TRUE(needs(scene).quadrature_error);
  EXPECT_TRUE(mentions(needs(scene).needed, "error of the quadrature"));
  scene.analysis = Analysis::modes;
  EXPECT_FALSE(needs(scene).quadrature_error);
  scene.analysis = Analysis::motion;
  scene.models = {"polynomial"};
  scene.sweep = {{"x", {0, 1}, 3}};
  EXPECT_FALSE(needs(scene).quadrature_error);
}

TEST(DiscretizationErrorOfNeeds, IsThatOfTheRichestModel) {
  Scene scene = test::ball_scene();
  scene.models = {"reduced", "polynomial"};
  scene.polynomial.degrees = {3, 5};
  EXPECT_TRUE(needs(scene).companion);
  EXPECT_TRUE(mentions(needs(scene).needed, "discretisation error: estimated by a companion run (degree 7)"));
  scene.polynomial.degrees.clear();
  EXPECT_FALSE(needs(scene).companion);
  EXPECT_TRUE(mentions(needs(scene).needed, "discretisation error: estimated by runs on coarser discretisations"));
  scene.models = {"reduced"};
  EXPECT_FALSE(needs(scene).companion);
  EXPECT_FALSE(mentions(needs(scene).skipped, "discretisation error"));
}

TEST(NegativeZero, IsZeroForTheSector) {
  Scene scene = test::ball_scene();
  scene.initial_state.deformation[0][1] = -0.0;
  EXPECT_EQ(sector(scene).name(), "octant");
}

TEST(Needs, BothModelsAreCompared) {
  const Needs result = needs(test::ball_scene());
  EXPECT_TRUE(result.models.size() == 2 && result.discretized && result.constraint && result.pressure_space &&
              result.comparison);
  EXPECT_FALSE(result.graphics);
  EXPECT_EQ(result.sector.name(), "octant");
  EXPECT_TRUE(mentions(result.needed, "octant, one of 8"));
  EXPECT_TRUE(mentions(result.needed, "motions that would break the symmetry are excluded"));
  EXPECT_TRUE(mentions(result.needed, "comparison"));
  EXPECT_TRUE(mentions(result.skipped, "graphics"));
}

TEST(Needs, AReducedSceneNeedsNothingOfTheContinuum) {
  Scene scene = test::ball_scene();
  scene.models = {"reduced"};
  const Needs result = needs(scene);
  EXPECT_FALSE(result.discretized || result.pressure_space || result.comparison || result.quantities.nonaffine);
  EXPECT_TRUE(result.quantities.state);
  EXPECT_TRUE(mentions(result.skipped, "no deal.II, MPI or PETSc"));
  EXPECT_TRUE(mentions(result.skipped, "quantities: nonaffine (not among Output/Quantities, or of the models"));
  EXPECT_FALSE(mentions(result.needed, "continuum"));
}

TEST(Needs, ACompressibleBodyHasNoConstraint) {
  Scene scene = test::ball_scene();
  scene.body.incompressible = false;
  const Needs result = needs(scene);
  EXPECT_FALSE(result.constraint || result.pressure_space);
  EXPECT_TRUE(mentions(result.skipped, "pressure space: the body is compressible"));
  EXPECT_TRUE(mentions(result.skipped, "constraint: the body is compressible"));
}

TEST(Needs, LoadsAreNamedOrSkipped) {
  Scene scene = test::ball_scene();
  EXPECT_TRUE(mentions(needs(scene).skipped, "traction: Loads/Nominal traction is 0"));
  scene.loads.get<loads::Traction>().nominal_stress[0][0] = 1;
  EXPECT_TRUE(mentions(needs(scene).needed, "dead traction"));
}

TEST(Needs, ContinuumAloneIsNotCompared) {
  Scene scene = test::ball_scene();
  scene.models = {"continuum"};
  const Needs result = needs(scene);
  EXPECT_FALSE(result.models.size() > 1 || result.comparison);
  EXPECT_TRUE(result.quantities.nonaffine);
  EXPECT_TRUE(mentions(result.skipped, "only one model"));
}

TEST(Needs, ModesHaveNeitherTimeLoopNorObservables) {
  Scene scene = test::ball_scene();
  scene.analysis = Analysis::modes;
  scene.models = {"continuum"};
  EXPECT_TRUE(mentions(needs(scene).skipped, "time loop, initial state and observables"));
  EXPECT_FALSE(mentions(needs(scene).needed, "quantities: "));
  scene.analysis = Analysis::motion;
  EXPECT_FALSE(mentions(needs(scene).skipped, "time loop"));
  EXPECT_TRUE(mentions(needs(scene).needed, "quantities: "));
}

TEST(Needs, SweepsAreCounted) {
  Scene scene = test::ball_scene();
  EXPECT_FALSE(mentions(needs(scene).needed, "sweep"));
  scene.sweep = {{"x", {0, 1}, 3}, {"y", {2, 4, 7, 8}, {}}};
  EXPECT_TRUE(mentions(needs(scene).needed, "sweep: 12 runs"));
}

TEST(Needs, OnlyQuantitiesAskedForAreEvaluated) {
  Scene scene = test::ball_scene();
  scene.output.quantities = {
      .state = true, .energies = false, .momenta = false, .multiplier = false, .axes = true, .nonaffine = false};
  scene.output.graphics = Graphics::vtu;
  const Needs result = needs(scene);
  EXPECT_TRUE(result.graphics && result.quantities.axes);
  EXPECT_FALSE(result.quantities.energies || result.quantities.nonaffine);
  EXPECT_TRUE(mentions(result.needed, "quantities: state, axes"));
  EXPECT_TRUE(mentions(result.needed, "graphics: 20 frames"));
  EXPECT_TRUE(
      mentions(result.skipped, "quantities: energies, momenta, multiplier, nonaffine (not among Output/Quantities)"));
}

TEST(Needs, LawsThatAreSeldomMeantAreWarnedOf) {
  const auto warnings = [](std::string_view law, bool incompressible) {
    Scene scene = test::ball_scene();
    scene.models = {"reduced"};
    scene.material.law = law;
    scene.body.incompressible = incompressible;
    const Needs result = needs(scene);
    EXPECT_EQ(describe(scene, result).find("Warnings:") != std::string::npos, !result.warnings.empty());
    return result.warnings;
  };
  for (const bool incompressible : {false, true}) {
    for (const materials::NamedLaw& law : materials::law_table) {
      const std::string_view expected = incompressible ? law.warning_incompressible : law.warning_compressible;
      EXPECT_EQ(warnings(law.name, incompressible).size(), expected.empty() ? 0u : 1u) << law.name;
      EXPECT_TRUE(expected.empty() || mentions(warnings(law.name, incompressible), std::string(expected)));
    }
    EXPECT_TRUE(mentions(warnings("saint-venant-kirchhoff", incompressible), "loses stability in compression"));
  }
  EXPECT_TRUE(mentions(warnings("ciarlet-geymonat (as printed)", true), "of no effect"));
  EXPECT_TRUE(mentions(warnings("saint-venant-kirchhoff (as printed)", false), "contracts by itself"));
}

TEST(Needs, DescriptionHoldsBothLists) {
  Scene scene = test::ball_scene();
  scene.title = "My ball";
  const Needs result = needs(scene);
  const std::string text = describe(scene, result);
  EXPECT_TRUE(text.starts_with("My ball\nmotion of an incompressible ball of radius 1, ")) << text;
  for (const auto* lines : {&result.needed, &result.skipped})
    for (const std::string& line : *lines) EXPECT_NE(text.find("  " + line + "\n"), std::string::npos) << line;
  EXPECT_LT(text.find("Needed:"), text.find("Skipped:"));
}

}  // namespace
}  // namespace pseudorigid::scene
