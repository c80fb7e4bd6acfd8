/// The program's own catalogue of methods and systems, and the reference page made from it.

#include "app/models/catalogue.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "app/run/scene_to_model.h"
#include "materials/eigen_tensor.h"
#include "scene/entries.h"
#include "scene/print_scene.h"

namespace pseudorigid::app {
namespace {

TEST(Catalogue, EveryDefaultIsAllowedAndEverythingIsDocumented) {
  scene::Scene scene = scene::default_scene(program_catalogue());
  std::set<std::string_view> paths;
  scene::visit_entries(scene, [&](auto& member, const auto& kind, const scene::About& about) {
    EXPECT_TRUE(paths.insert(about.path).second) << about.path << " occurs twice";
    EXPECT_EQ(kind.read(kind.print(member), member), std::nullopt) << about.path;
    EXPECT_FALSE(kind.expected().empty()) << about.path;
    EXPECT_TRUE(about.documentation.ends_with(".")) << about.path;
  });
  for (const scene::NamedMethod& method : program_catalogue().methods) EXPECT_FALSE(method.documentation.empty());
}

/// The law in internal units is that of the scene in its own units: a modulus has the unit of a pressure, other numbers
/// have none.
TEST(Catalogue, EveryLawIsTheSameInEveryUnit) {
  const materials::Tensor<double> F =
      materials::to_tensor((Eigen::Matrix3d() << 1.2, 0.1, -0.05, 0.02, 0.9, 0.1, -0.1, 0.05, 1.1).finished());
  for (const materials::NamedLaw& law : materials::law_table)
    for (const bool incompressible : {true, false}) {
      scene::Scene scene;
      scene.material.law = law.name;
      scene.material.shear_modulus = 3;
      scene.material.lame_lambda = 5;
      scene.body.incompressible = incompressible;
      const materials::AnyLaw own = law.make(scene.material, incompressible), internal = internal_law(scene);
      const auto stress = [&F](const materials::AnyLaw& l) {
        return std::visit([&F](const auto& one) { return materials::to_matrix(one.stress(F)); }, l);
      };
      const Eigen::Matrix3d P = stress(own);
      EXPECT_LT((units_of(scene).stress() * stress(internal) - P).norm(), 1e-14 * P.norm() + 1e-300) << law.name;
      EXPECT_NE(scene::documentation_of_laws().find(law.energy), std::string_view::npos) << law.name;
    }
}

scene::ModelDescription some_model() { return reduced_model().description; }
ModelOutcome runs_nothing(const RunContext&) { return {}; }

/// A model that leaves out a part does not come into a program, whose scenes would meet the gap one day.
TEST(Catalogue, AModelIsComplete) {
  EXPECT_NO_THROW(BallModel(some_model(), runs_nothing));
  EXPECT_THROW(BallModel(some_model(), nullptr), std::logic_error);
  const auto without = [](auto scene::ModelDescription::*part) {
    scene::ModelDescription model = some_model();
    model.*part = std::remove_reference_t<decltype(model.*part)>();
    return model;
  };
  using Model = scene::ModelDescription;
  EXPECT_THROW(BallModel(without(&Model::name), runs_nothing), std::logic_error);
  EXPECT_THROW(BallModel(without(&Model::adjective), runs_nothing), std::logic_error);
  EXPECT_THROW(BallModel(without(&Model::columns), runs_nothing), std::logic_error);
  EXPECT_THROW(BallModel(without(&Model::header), runs_nothing), std::logic_error);
  EXPECT_THROW(BallModel(without(&Model::needed), runs_nothing), std::logic_error);
  EXPECT_THROW(BallModel(without(&Model::skipped), runs_nothing), std::logic_error);
  EXPECT_THROW(BallModel(without(&Model::refuses), runs_nothing), std::logic_error);
}

TEST(Catalogue, EveryModelButThoseWithElementsRunsWithoutTheLibrary) {
  for (const BallModel& model : ball_models()) EXPECT_EQ(!model.run, bool(model.description.discretized));
}

TEST(Catalogue, EverySystemHasItsOwnNamesAndDocumentedColumns) {
  std::set<std::string_view> names{scene::ball}, files{"comparison", "equilibria", "modes"};
  for (const scene::ModelDescription& model : program_catalogue().models) files.insert(model.name);
  for (const scene::SystemDescription& system : program_catalogue().systems) {
    EXPECT_TRUE(names.insert(system.name).second) << system.name;
    EXPECT_TRUE(files.insert(system.file).second) << system.file;
    EXPECT_TRUE(system.documentation.ends_with(".")) << system.name;
    std::set<std::string> columns{"time"};
    for (const scene::Column& column : system.columns) {
      EXPECT_TRUE(columns.insert(column.name).second) << system.name << ": " << column.name << " occurs twice";
      EXPECT_FALSE(column.documentation.empty()) << system.name << ": " << column.name;
    }
    for (const scene::SystemEntry& entry : system.entries)
      EXPECT_TRUE(entry.about.path.starts_with(std::string(system.section) + "/")) << entry.about.path;
  }
}

/// Each system's scene of defaults can be run with Method = auto.
TEST(Catalogue, TheDefaultsOfEverySystemAreAScene) {
  for (const scene::SystemDescription& system : program_catalogue().systems) {
    scene::Scene scene = scene::default_scene(program_catalogue());
    scene.system = system.name;
    const auto refusal = system.refuses(scene);
    EXPECT_FALSE(refusal) << refusal->path << ": " << refusal->sentence;
  }
}

TEST(Catalogue, TheCommittedPageOfParametersIsUpToDate) {
  std::ifstream file(PARAMETERS_PAGE);
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_EQ(page.str(), scene::parameters(scene::Format::markdown, program_catalogue()))
      << "write the page anew: pseudorigid parameters --format markdown > docs/parameters.md";
}

}  // namespace
}  // namespace pseudorigid::app
