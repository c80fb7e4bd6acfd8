/// The form in which the reduced body of a scene is integrated, and that a form changes nothing.

#include <gtest/gtest.h>

#include "app/models/catalogue.h"
#include "app/reduced/reduced_scene.h"
#include "scene/entries.h"

namespace pseudorigid::app {
namespace {

/// A diagonal scene in which something of everything acts.
scene::Scene diagonal_scene() {
  scene::Scene scene = scene::default_scene(program_catalogue());
  scene.initial_state.deformation = {{{1.25, 0, 0}, {0, 1, 0}, {0, 0, 0.8}}};
  scene.initial_state.velocity = {{{0.25, 0, 0}, {0, -0.2, 0}, {0, 0, 0}}};
  scene.body.inertia = scene::Matrix3{{{1, 0, 0}, {0, 1.2, 0}, {0, 0, 1.1}}};
  scene.loads = {loads::Tide{{{{0.3, 0, 0}, {0, 0.1, 0}, {0, 0, -0.2}}}},
                 loads::Traction{{{{0.1, 0, 0}, {0, 0.2, 0}, {0, 0, 0.3}}}}};
  return scene;
}

ReducedForm form_of_scene(const scene::Scene& scene) { return form_of(reduced_scene(scene)); }

TEST(ReducedForm, IsDiagonalOnlyWhereEveryMatrixIs) {
  EXPECT_EQ(form_of_scene(diagonal_scene()), ReducedForm::diagonal);
  const auto matrices = [](scene::Scene& s) {
    return std::vector<scene::Matrix3*>{&s.initial_state.deformation, &s.initial_state.velocity, &*s.body.inertia,
                                        &s.loads.get<loads::Tide>().tensor,
                                        &s.loads.get<loads::Traction>().nominal_stress};
  };
  for (std::size_t which = 0; which < 5; ++which)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        if (i == j) continue;
        scene::Scene scene = diagonal_scene();
        (*matrices(scene)[which])[i][j] = 1e-12;
        EXPECT_EQ(form_of_scene(scene), ReducedForm::general) << which << ": " << i << j;
      }
}

/// The centre of mass moves apart from Q, in closed form.
TEST(ReducedForm, IsDiagonalWhereverTheCentreOfMassGoes) {
  scene::Scene scene = diagonal_scene();
  scene.initial_state.center = {1, 2, 3};
  scene.initial_state.center_velocity = {-1, 0.5, 2};
  scene.loads.get<loads::Acceleration>().acceleration = {0.1, 0.2, -9.81};
  EXPECT_EQ(form_of_scene(scene), ReducedForm::diagonal);
}

/// Two loads whose forces cancel at the start, T₁₂ E₀ = Vol P̄₁₂, are not absent.
TEST(ReducedForm, IsNotDiagonalWhereLoadsBalanceAtTheStart) {
  scene::Scene scene = scene::default_scene(program_catalogue());
  scene.loads = {loads::Tide{{{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}}}},
                 loads::Traction{{{{0, 0.2, 0}, {0.2, 0, 0}, {0, 0, 0}}}}};
  scene.initial_state.velocity = {{{0.1, 0, 0}, {0, -0.1, 0}, {0, 0, 0}}};
  const ReducedScene reduced = reduced_scene(scene);
  const auto body = general_body<true>(reduced);
  Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
  GeneralBody<true>::Workspace workspace;
  ASSERT_TRUE(body.force(0, reduced.start.q, reduced.start.v, workspace, f));
  EXPECT_NEAR(f(0, 1), 0, 1e-15);
  EXPECT_EQ(form_of(reduced), ReducedForm::general);
}

TEST(ReducedForm, IsElasticForStoredEnergyAlone) {
  scene::Scene scene = scene::default_scene(program_catalogue());
  scene.initial_state.velocity = {{{0, 0.1, 0}, {0, 0, 0}, {0, 0, 0}}};
  EXPECT_EQ(form_of_scene(scene), ReducedForm::elastic);
  scene.loads.get<loads::SelfGravity>().constant = 1e-12;
  EXPECT_EQ(form_of_scene(scene), ReducedForm::general);
  scene.loads.get<loads::Drag>().drag = 1e-12;
  EXPECT_EQ(form_of_scene(scene), ReducedForm::dissipative);
}

TEST(ReducedForm, IsLoadedWithACompanion) {
  scene::Scene scene = diagonal_scene();
  auto& companions = scene.loads.get<loads::CompanionMasses>();
  companions.masses = {3};
  companions.positions = {5, 0, 0};
  EXPECT_EQ(form_of_scene(scene), ReducedForm::loaded);
}

}  // namespace
}  // namespace pseudorigid::app
