/// The example of docs/adding_a_system.md through the program's own machinery: entries, refusals, a run, equilibria.

#include <gtest/gtest.h>

#include "app/run/model_files.h"
#include "app/run/refuses_method.h"
#include "app/systems/system_run.h"
#include "io/csv.h"
#include "io/log.h"
#include "scene/print_scene.h"
#include "scene/scene_files.h"
#include "scene/validate.h"
#include "systems/spherical_pendulum_scene.h"

namespace pseudorigid::app {
namespace {

using systems::SphericalPendulumScene;

/// Parameter files of a program that has the methods of the table and this system alone.
class SphericalPendulumProgram : public scene::test::SceneFiles {
 protected:
  const systems::AnySystemScene system_ = systems::any_system_scene<SphericalPendulumScene>();
  const scene::Catalogue catalogue_{.methods = {{"rattle", ""}, {"rattle-4", ""}, {"energy-momentum", ""}},
                                    .systems = {describe_system(system_)}};

  scene::Scene valid(const std::vector<std::string>& overrides) const {
    const auto file = write("scene.prm", "set System = spherical pendulum\n");
    const auto read = scene::read_scene(file, overrides, catalogue_);
    return scene::validate(read.scene, read.origins);
  }
  std::string complaint_about(const std::vector<std::string>& overrides) const {
    return complaint([&] { (void)valid(overrides); });
  }

  /// The file that a run of the scene writes.
  io::Table result(const scene::Scene& scene, const char* name) const {
    const auto needs = scene::needs(scene);
    const io::RunDirectory directory(folder_ / "run");
    directory.prepare_fresh();
    const RunContext context{.scene = scene,
                             .needs = needs,
                             .directory = directory,
                             .units = {},
                             .log = io::make_logger(io::Verbosity::silent, {}),
                             .sink_of = files_of_models()};
    const ModelOutcome outcome = run_system(system_, context);
    EXPECT_EQ(outcome.end, mechanics::Outcome::finished) << outcome.message;
    return io::read_csv(directory.csv(name));
  }
};

TEST_F(SphericalPendulumProgram, ListsItsEntriesWithTheirDefaults) {
  const std::string page = scene::parameters(scene::Format::markdown, catalogue_);
  for (const char* text : {"Spherical pendulum", "Gravity", "9.81", "length/time^2", "angular momentum"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
}

TEST_F(SphericalPendulumProgram, RefusesWhatCannotBeMeant) {
  EXPECT_EQ(complaint_about({}), "");
  EXPECT_EQ(complaint_about({"Spherical pendulum/Mass=0"}),
            "--set: Spherical pendulum/Mass: expected a number > 0, got \"0\"");
  EXPECT_EQ(complaint_about({"Spherical pendulum/Angles=0, 0"}),
            "scene.prm: Spherical pendulum/Rates: expected no rate of phi where the rod is vertical and has no phi");
  EXPECT_EQ(complaint_about({"Time/Method=energy-momentum"}), "");
  EXPECT_NE(complaint_about({"Time/Method=energy-momentum", "Spherical pendulum/Drag=1"}).find("Method = rattle"),
            std::string::npos);
}

/// What a system leaves out is known at run time alone, and refused in the same words.
TEST_F(SphericalPendulumProgram, RefusesAMethodThatNeedsMoreThanTheSystemHas) {
  struct WithoutEnergies : systems::SphericalPendulum {
    using SphericalPendulum::SphericalPendulum;
    double kinetic_energy(const Vector&) const = delete;
  };
  const auto refusal_of = [](const auto& system, const char* method) {
    scene::Scene scene;
    scene.time.method = method;
    const auto refusal = refuses_method(scene, mechanics::AnySystem<mechanics::dynamic_constraints>(system));
    return refusal ? refusal->sentence : "";
  };
  EXPECT_EQ(refusal_of(systems::SphericalPendulum({}), "energy-momentum"), "");
  EXPECT_EQ(refusal_of(WithoutEnergies(systems::SphericalPendulum::Parameters{}), "energy-momentum"),
            "energy-momentum cannot integrate this form of the system");
  EXPECT_EQ(refusal_of(WithoutEnergies(systems::SphericalPendulum::Parameters{}), "rattle"), "");
}

/// A method of the table that does not fit the ball is refused as it is by other systems.
TEST_F(SphericalPendulumProgram, AMethodThatCannotRunTheBallIsRefused) {
  auto catalogue = catalogue_;
  const auto nothing = [](const scene::Scene&) { return std::string(); };
  const auto refuses = [](const scene::Scene& scene) -> std::optional<scene::Refusal> {
    if (scene.time.method != "rattle-4") return {};
    return scene::Refusal{"Time/Method", "it cannot"};
  };
  catalogue.models = {{.name = "reduced",
                       .adjective = "small",
                       .documentation = "",
                       .discretized = false,
                       .has_nonaffine = false,
                       .columns = {},
                       .header = {},
                       .needed = nothing,
                       .skipped = nothing,
                       .refuses = refuses}};
  const auto file = write("ball.prm", "set Models = reduced\n");
  const auto complaint_with = [&](const std::string& method) {
    return complaint([&] {
      const auto read = scene::read_scene(file, {"Time/Method=" + method}, catalogue);
      (void)scene::validate(read.scene, read.origins);
    });
  };
  EXPECT_EQ(complaint_with("rattle"), "");
  EXPECT_EQ(complaint_with("rattle-4"), "--set: Time/Method: it cannot");
}

/// Sample by sample in the user's units: 2 m, 3 kg, 9.81 m/s².
TEST_F(SphericalPendulumProgram, RunsAndKeepsEnergyAndMomentum) {
  const auto table = result(valid({"Spherical pendulum/Mass=3", "Spherical pendulum/Length=2", "Time/End=10",
                                   "Time/Tolerance=1e-8", "Output/Samples=100"}),
                            "spherical_pendulum");
  ASSERT_EQ(table.n_rows(), 101u);
  const auto energy = table.column("energy"), momentum = table.column("momentum"), x = table.column("x"),
             y = table.column("y"), z = table.column("z");
  // θ = 1, θ̇ = 0, φ̇ = 1: E = ½ m l² sin²θ − m g l cos θ, momentum m l² sin²θ.
  const double sine2 = std::sin(1.0) * std::sin(1.0);
  EXPECT_NEAR(energy[0], 6 * sine2 - 3 * 9.81 * 2 * std::cos(1.0), 1e-13);
  EXPECT_NEAR(momentum[0], 12 * sine2, 1e-13);
  for (std::size_t k = 0; k < table.n_rows(); ++k) {
    EXPECT_NEAR(energy[k], energy[0], 1e-6) << "about the tolerance times the energy";
    EXPECT_NEAR(momentum[k], momentum[0], 1e-6);
    EXPECT_NEAR(x[k] * x[k] + y[k] * y[k] + z[k] * z[k], 4, 1e-14 * 4);
  }
}

TEST_F(SphericalPendulumProgram, FindsTheEquilibria) {
  const auto table =
      result(valid({"Analysis=equilibrium", "Spherical pendulum/Mass=3", "Spherical pendulum/Length=2"}), "equilibria");
  ASSERT_EQ(table.n_rows(), 2u);
  EXPECT_EQ(table.column("morse_index"), (std::vector<double>{0, 2}));
  const auto z = table.column("z"), V = table.column("potential");
  for (const int k : {0, 1}) {
    EXPECT_NEAR(z[k], 2 * (2 * k - 1), 1e-12);
    EXPECT_NEAR(V[k], 3 * 9.81 * 2 * (2 * k - 1), 1e-10);
  }
}

}  // namespace
}  // namespace pseudorigid::app
