/// Checks of a scene that need several entries, and the projection of nearly isochoric initial states.

#include "scene/validate.h"

#include <cmath>
#include <random>

#include "entries/entry_kinds.h"
#include "entries/matrix3.h"
#include "scene/initial_state.h"
#include "scene_files.h"

namespace pseudorigid::scene {
namespace {

using ValidateTest = test::SceneFiles;

std::string initial_state(const Matrix3& deformation, const Matrix3& velocity = {}) {
  return "subsection Initial state\nset Deformation = " + print_matrix(deformation) +
         "\nset Velocity = " + print_matrix(velocity) + "\nend\n";
}

Matrix3 diagonal(double a, double b, double c) { return {{{a, 0, 0}, {0, b, 0}, {0, 0, c}}}; }

struct Refused {
  const char* name;
  std::string text;
  std::vector<std::string> fragments;
};

std::ostream& operator<<(std::ostream& out, const Refused& refused) { return out << refused.name; }

class RefusedScenes : public test::SceneFiles, public ::testing::WithParamInterface<Refused> {};

TEST_P(RefusedScenes, SayWhereAndWhy) {
  const std::string message = complaint([&] {
    const ReadScene scene = read(GetParam().text);
    validate(scene.scene, scene.origins);
  });
  for (const std::string& fragment : GetParam().fragments)
    EXPECT_NE(message.find(fragment), std::string::npos) << fragment << "\nnot in\n" << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

std::string compressible(const Matrix3& deformation) {
  return "set Models = reduced\nsubsection Body\nset Incompressible = false\nend\n" + initial_state(deformation);
}

std::string equilibrium(const std::string& text) { return "set Models = reduced\nset Analysis = equilibrium\n" + text; }

INSTANTIATE_TEST_SUITE_P(
    All, RefusedScenes,
    ::testing::Values(
        Refused{
            "no_model",
            "set Models =",
            {"scene.prm:1: Models: expected at least one of " + joined(models_kind(test::test_catalogue()).allowed)}},
        Refused{"entry_of_another_system",
                "set System = top\nsubsection Body\nset Radius = 1\nend",
                {"scene.prm:3: Body/Radius: it belongs to System = ball, and the System of this scene is top"}},
        Refused{"entry_of_a_system_in_a_scene_of_the_ball",
                "subsection Top\nset Spin = 1\nend",
                {"scene.prm:2: Top/Spin: it belongs to System = top"}},
        Refused{"what_the_system_itself_refuses",
                "set System = top\nsubsection Top\nset Spin = 13\nend",
                {"scene.prm:3: Top/Spin: this top does not spin at 13"}},
        Refused{"equilibrium_of_a_system_without",
                "set System = top\nset Analysis = equilibrium",
                {"scene.prm:2: Analysis: equilibrium is not offered for System = top"}},
        Refused{"method_that_the_continuum_cannot_use",
                "subsection Time\nset Method = explicit-8\nend",
                {"scene.prm:2: Time/Method: explicit-8 is offered for", "Method = rattle"}},
        Refused{"self_gravity_in_the_continuum",
                "subsection Gravity\nset Constant = 1\nend\nsubsection Body\nset Incompressible = false\nend",
                {"scene.prm:2: Gravity/Constant: self-gravity of a compressible body", "Models = reduced"}},
        Refused{"gamma_and_constant",
                "subsection Gravity\nset Constant = 1\nset Gamma = 2\nend",
                {"scene.prm:3: Gravity/Gamma", "Gravity/Constant", "got 2 and 1"}},
        Refused{"gamma_of_a_fluid",
                "subsection Material\nset Law = none\nend\nsubsection Gravity\nset Gamma = 2\nend",
                {"scene.prm:5: Gravity/Gamma", "fluid", "Gravity/Constant"}},
        Refused{"huge_traction",
                "subsection Loads\nset Nominal traction = 0, 0, 0; 0, 1e13, 0; 0, 0, 0\nend",
                {"scene.prm:2: Loads/Nominal traction: expected values up to 1e+12 in the body's own units"}},
        Refused{"modes_under_loads",
                "set Models = continuum\nset Analysis = modes\nsubsection Material\nset Drag = 1\nend",
                {"scene.prm:4: Material/Drag: modes are those of the ball alone"}},
        Refused{"compressible_modes_of_a_law_without_rest",
                "set Models = continuum\nset Analysis = modes\nsubsection Body\nset Incompressible = false\nend\n"
                "subsection Material\nset Law = saint-venant-kirchhoff (as printed)\nend",
                {"scene.prm:7: Material/Law: saint-venant-kirchhoff (as printed) is stressed at rest"}},
        Refused{
            "fluid_continuum",
            "subsection Material\nset Law = none\nend",
            {"scene.prm:2: Material/Law: a fluid with neither self-gravity nor a positive definite Loads/Tidal matrix",
             "Models = reduced"}},
        Refused{"fluid_in_a_potential_that_lets_go",
                "subsection Material\nset Law = none\nend\n"
                "subsection Loads\nset Tidal matrix = 1, 0, 0; 0, 1, 0; 0, 0, -1\nend",
                {"scene.prm:2: Material/Law: a fluid with neither self-gravity"}},
        Refused{"free_particles_of_the_continuum",
                "subsection Body\nset Incompressible = false\nend\nsubsection Material\nset Law = none\nend\n"
                "subsection Gravity\nset Constant = 1\nend",
                {"scene.prm:5: Material/Law: none, where nothing resists a change of volume", "Models = reduced"}},
        Refused{"equilibrium_of_free_particles",
                equilibrium("subsection Body\nset Incompressible = false\nend\nsubsection Material\nset Law = none\n"
                            "end\nsubsection Gravity\nset Constant = 1\nend"),
                {"Material/Law: none has no relative equilibrium if Incompressible = false"}},
        Refused{"fluid_without_stabilisation",
                "subsection Material\nset Law = none\nend\nsubsection Gravity\nset Constant = 1\nend\n"
                "subsection Continuum\nset Volumetric stiffness = 0\nend",
                {"scene.prm:8: Continuum/Volumetric stiffness: expected a number > 0 for a fluid"}},
        Refused{"modes_of_a_fluid",
                "set Models = continuum\nset Analysis = modes\nsubsection Material\nset Law = none\nend\n"
                "subsection Gravity\nset Constant = 1\nend",
                {"scene.prm:4: Material/Law: modes are those of an elastic ball"}},
        Refused{
            "degree_1_of_an_incompressible_continuum",
            "subsection Continuum\nset Degree = 1\nend",
            {"scene.prm:2: Continuum/Degree: expected a whole number from 2 to 8 for an incompressible body, got 1"}},
        Refused{"modes_of_an_automatic_degree",
                "set Analysis = modes\nset Models = continuum\nsubsection Continuum\nset Degree = auto\nend",
                {"scene.prm:4: Continuum/Degree: auto is offered for motions"}},
        Refused{
            "modes_of_another_sector",
            "set Analysis = modes\nset Models = continuum\nsubsection Continuum\nset Degree = 3\nset Refinements = 0\n"
            "set Symmetry = xy\nend",
            {"scene.prm:6: Continuum/Symmetry: modes are computed on one octant"}},
        Refused{"equilibrium_of_an_ellipsoid",
                equilibrium("subsection Body\nset Semi-axes = 1, 1, 2\nend"),
                {"scene.prm:4: Body/Semi-axes: relative equilibria are offered for a ball"}},
        Refused{"equilibrium_in_a_tide",
                equilibrium("subsection Loads\nset Tidal matrix = 1, 0, 0; 0, 0, 0; 0, 0, 0\nend"),
                {"scene.prm:4: Loads/Tidal matrix: relative equilibria"}},
        Refused{"equilibrium_under_traction",
                equilibrium("subsection Loads\nset Nominal traction = 0, 0, 0; 0, 0, 0; 0, 0, 1\nend"),
                {"scene.prm:4: Loads/Nominal traction: relative equilibria"}},
        Refused{"equilibrium_with_drag",
                equilibrium("subsection Material\nset Drag = 0.1\nend"),
                {"scene.prm:4: Material/Drag: drag leaves no relative equilibrium"}},
        Refused{"equilibrium_of_a_fluid_without_gravity",
                equilibrium("subsection Material\nset Law = none\nend"),
                {"Gravity/Constant: a fluid without gravity"}},
        Refused{"subnormal_stiffness",
                "set Models = reduced\nsubsection Material\nset Shear modulus = 1.5e-308\nend",
                {"scene.prm:3: Material/Shear modulus: with radius 1", "choose units"}},
        Refused{"absurd_units", "subsection Body\nset Radius = 1e200\nend", {"scene.prm:2: Body/Radius: ", "1e+200"}},
        Refused{"step_beyond_end",
                "subsection Time\nset End = 1\nset Step = 2\nend",
                {"scene.prm:3: Time/Step: expected a step not longer than Time/End = 1, got 2"}},
        Refused{"frames_beyond_samples",
                "subsection Output\nset Samples = 10\nset Frames = 11\nset Graphics = vtu\nend",
                {"scene.prm:3: Output/Frames: expected at most as many frames as Output/Samples = 10, got 11"}},
        Refused{"zero_matrix", compressible(Matrix3{}), {"scene.prm:6: Initial state/Deformation: ", "got zero"}},
        Refused{"reflection",
                compressible(diagonal(1, 1, -2)),
                {"scene.prm:6: Initial state/Deformation: expected a matrix of positive determinant, got 1, 0, 0; 0, "
                 "1, 0; 0, 0, -2 with determinant -2"}},
        Refused{"singular", compressible({{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}}), {"positive determinant"}},
        Refused{"condition", compressible(diagonal(1, 1, 1e-13)), {"condition number up to 1e+12"}},
        Refused{"huge", compressible(diagonal(1e13, 1e13, 1e13)), {"largest entry between 1e-12 and 1e+12"}},
        Refused{"tiny", compressible(diagonal(1e-13, 1e-13, 1e-13)), {"largest entry between 1e-12 and 1e+12"}},
        Refused{"huge_velocity", initial_state(identity3, {{{0, 1e13, 0}}}), {"scene.prm:3: Initial state/Velocity: "}},
        Refused{
            "volume",
            initial_state(diagonal(2, 1, 1)),
            {"scene.prm:2: Initial state/Deformation: expected det = 1 within 1e-08 for an incompressible body, got "
             "det = 2; the nearest choice is \"set Deformation = 1.58740105196819",
             ", 0, 0; 0, 0.7937005259840"}},
        Refused{"divergence",
                initial_state(identity3, diagonal(1, 0, 0)),
                {"scene.prm:3: Initial state/Velocity: expected |tr(Q0^-1 Qdot0)| r/c <= 1e-08 for an incompressible "
                 "body, got 1; the nearest choice is \"set Velocity = 0.66666666666666",
                 "-0.3333333333333333"}},
        Refused{
            "octant_sheared_deformation",
            initial_state({{{1, 0.1, 0}, {0, 1, 0}, {0, 0, 1}}}) + "subsection Continuum\nset Symmetry = octant\nend",
            {"scene.prm:6: Continuum/Symmetry: the plane with normal x is no symmetry plane of this motion, as entry "
             "(1,2) of Initial state/Deformation is 0.1"}},
        Refused{"plane_broken_by_velocity",
                initial_state(identity3, {{{0, 0, 0}, {0, 0, 0}, {0, -0.5, 0}}}) +
                    "subsection Continuum\nset Symmetry = xz\nend",
                {"the plane with normal z", "entry (3,2) of Initial state/Velocity is -0.5"}},
        Refused{
            "plane_broken_by_a_load",
            "subsection Loads\nset Nominal traction = 0, 0, 2; 0, 0, 0; 0, 0, 0\nend\n"
            "subsection Continuum\nset Symmetry = xy\nend",
            {"scene.prm:5: Continuum/Symmetry: the plane with normal x", "entry (1,3) of Loads/Nominal traction is 2"}},
        Refused{"plane_broken_by_the_centre",
                "subsection Initial state\nset Center = 0, 3, 0\nend\nsubsection Continuum\nset Symmetry = y\nend",
                {"the plane with normal y", "entry 2 of Initial state/Center is 3"}}));

TEST_F(ValidateTest, TheDefaultSceneIsValid) { EXPECT_NO_THROW(validate(test::ball_scene())); }

TEST_F(ValidateTest, EquilibriaAndModesOfTheBallAreValid) {
  for (const std::string text :
       {"set Models = reduced\nset Analysis = equilibrium",
        "set Models = continuum\nset Analysis = modes\nsubsection Continuum\nset Degree = 3\nset Refinements = 0\nend",
        "set Models = continuum\nset Analysis = modes\nsubsection Continuum\nset Degree = 3\nset Refinements = 0\n"
        "set Symmetry = octant\nend"}) {
    const ReadScene scene = read(text);
    EXPECT_NO_THROW(validate(scene.scene, scene.origins)) << text;
  }
}

TEST_F(ValidateTest, ErrorsCiteOverridesAndDefaults) {
  const auto message = [&](const std::vector<std::string>& overrides) {
    return complaint([&] {
      const ReadScene scene = read("", overrides);
      validate(scene.scene, scene.origins);
    });
  };
  EXPECT_TRUE(message({"Time/Step=20"}).starts_with("--set: Time/Step: "));
  EXPECT_TRUE(message({"Output/Graphics=vtu", "Output/Samples=5"}).starts_with("scene.prm: Output/Frames: "));
}

TEST_F(ValidateTest, WhatAModelIgnoresIsNotChecked) {
  Scene scene = test::ball_scene();
  scene.models = {"reduced"};
  scene.continuum.symmetry = Symmetry::octant;
  scene.initial_state.deformation[0][1] = 1;
  scene.output.samples = 5;
  scene.output.frames = 20;
  EXPECT_NO_THROW(validate(scene));
}

/// A frequency of 1 is 1e15 in the units of a body as soft as that, but there is no tide.
TEST_F(ValidateTest, EntriesOfALoadThatDoesNotActAreNotChecked) {
  Scene scene = test::ball_scene();
  scene.material.shear_modulus = 1e-30;
  EXPECT_NO_THROW(validate(scene));
  scene.loads.get<loads::PeriodicTide>().amplitude[0][0] = 1e-30;
  EXPECT_THROW(validate(scene), UserError);
}

TEST_F(ValidateTest, ACompressibleStateIsLeftAlone) {
  Scene scene = test::ball_scene();
  scene.body.incompressible = false;
  scene.initial_state.deformation = diagonal(2, 3, 4);
  scene.initial_state.velocity = diagonal(1, 1, 1);
  const Scene valid = validate(scene);
  EXPECT_EQ(valid.initial_state.deformation, scene.initial_state.deformation);
  EXPECT_EQ(valid.initial_state.velocity, scene.initial_state.velocity);
}

TEST_F(ValidateTest, TheVelocityIsJudgedInUnitsOfTheScene) {
  Scene scene = test::ball_scene();
  scene.body.radius = 1e-3;
  scene.body.density = 1000;
  scene.material.shear_modulus = 1e9;  // r/c = 1e-6
  scene.initial_state.velocity = diagonal(0.9e-2, 0, 0);
  EXPECT_NO_THROW(validate(scene));
  scene.initial_state.velocity = diagonal(1.1e-2, 0, 0);
  EXPECT_THROW(validate(scene), UserError);
}

Matrix3 random_matrix(std::mt19937_64& random) {
  std::normal_distribution<> normal;
  Matrix3 matrix;
  for (auto& row : matrix)
    for (double& entry : row) entry = normal(random);
  return matrix;
}

/// Of positive determinant, not too near zero.
Matrix3 random_deformation(std::mt19937_64& random) {
  for (;;) {
    const Matrix3 q = random_matrix(random);
    if (det(q) > 0.05) return q;
  }
}

double divergence_of(const Matrix3& q, const Matrix3& qdot) { return inner(cofactor(q), qdot) / det(q); }

TEST_F(ValidateTest, ProjectionsAreExactAndIdempotent) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Matrix3 q = project_deformation(random_deformation(random));
    const Matrix3 qdot = project_velocity(q, random_matrix(random));
    EXPECT_NEAR(det(q), 1, 1e-15 * (1 + inner(absolute(q), absolute(cofactor(q)))));
    EXPECT_NEAR(divergence_of(q, qdot), 0, 4e-15 * inner(absolute(cofactor(q)), absolute(qdot)));
    EXPECT_EQ(project_deformation(q), q);
    EXPECT_EQ(project_velocity(q, qdot), qdot);
  }
}

TEST_F(ValidateTest, TheVelocityProjectionIsOrthogonal) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const Matrix3 q = project_deformation(random_deformation(random)), qdot = random_matrix(random);
    const Matrix3 removed = combine(1, qdot, -1, project_velocity(q, qdot));
    const Matrix3 tangent = project_velocity(q, random_matrix(random));
    EXPECT_NEAR(inner(removed, tangent), 0, 1e-13 * norm(qdot) * norm(tangent) * norm(cofactor(q)));
  }
}

TEST_F(ValidateTest, WhatAnErrorSuggestsIsAccepted) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 300; ++i) {
    std::string text = initial_state(random_deformation(random), random_matrix(random));
    for (const std::string setting : {"Deformation", "Velocity"}) {
      const std::string message = complaint([&] { validate(read(text).scene); });
      const std::string opening = "\"set " + setting + " = ";
      const auto begin = message.find(opening);
      ASSERT_NE(begin, std::string::npos) << message;
      const auto end = message.find('"', begin + 1);
      text += "subsection Initial state\n" + message.substr(begin + 1, end - begin - 1) + "\nend\n";
    }
    EXPECT_EQ(complaint([&] { validate(read(text).scene); }), "") << text;
  }
}

TEST_F(ValidateTest, WithinToleranceTheStateIsProjectedAndStaysSo) {
  Scene scene = test::ball_scene();
  scene.initial_state.deformation = diagonal(1.25, 0.8 * (1 + 5e-9), 1);
  scene.initial_state.velocity = diagonal(0.3, -0.192, 5e-9);
  const Scene once = validate(scene);
  EXPECT_NEAR(det(once.initial_state.deformation), 1, 4e-16);
  EXPECT_NEAR(divergence_of(once.initial_state.deformation, once.initial_state.velocity), 0, 4e-16);
  const Scene twice = validate(once);
  EXPECT_EQ(twice.initial_state.deformation, once.initial_state.deformation);
  EXPECT_EQ(twice.initial_state.velocity, once.initial_state.velocity);
}

TEST_F(ValidateTest, BeyondToleranceItIsRefused) {
  Scene scene = test::ball_scene();
  scene.initial_state.deformation = diagonal(1 + 0.9e-8, 1, 1);
  EXPECT_NO_THROW(validate(scene));
  scene.initial_state.deformation = diagonal(1 + 1.1e-8, 1, 1);
  EXPECT_THROW(validate(scene), UserError);
}

TEST_F(ValidateTest, ExactStatesAreNotTouched) {
  for (const Matrix3& q : {identity3, diagonal(2, 0.5, 1), diagonal(4, 0.5, 0.5),
                           Matrix3{{{1, 0.7, 0}, {0, 1, 0}, {0, 0, 1}}}, Matrix3{{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}})
    EXPECT_EQ(project_deformation(q), q);
  const Matrix3 spin{{{0, -0.1, 0.3}, {0.1, 0, 0.2}, {-0.3, -0.2, 0}}};
  EXPECT_EQ(project_velocity(identity3, spin), spin);
  const double l = 1.1;  // an axisymmetric stretch, exact up to round-off
  const Matrix3 stretch = diagonal(1 / std::sqrt(l), 1 / std::sqrt(l), l);
  EXPECT_EQ(project_deformation(stretch), stretch);
}

TEST_F(ValidateTest, ZerosStayZero) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    Matrix3 q = random_deformation(random), qdot = random_matrix(random);
    const int axis = i % 3;
    const bool is_diagonal = i % 2 == 0;
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        if (j != k && (is_diagonal || j == axis || k == axis)) q[j][k] = qdot[j][k] = 0;
    if (det(q) <= 0.05) continue;
    const Matrix3 projected = project_deformation(q), rate = project_velocity(projected, qdot);
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        if (q[j][k] != 0) continue;
        EXPECT_EQ(projected[j][k], 0);
        EXPECT_EQ(rate[j][k], 0);
      }
  }
}

}  // namespace
}  // namespace pseudorigid::scene
