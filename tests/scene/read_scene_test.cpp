/// From a file and overrides to a Scene: values, names, origins.

#include "scene/read_scene.h"

#include "scene_files.h"

namespace pseudorigid::scene {
namespace {

using ReadSceneTest = test::SceneFiles;

const char* const full_text = R"(
set Title    = Stretched ball  # with a comment
set Models   = reduced
set System   = ball
set Analysis = motion
subsection Body
  set Radius = 2
  set Density = 1.5e3
  set Incompressible = false
end
subsection Material
  set Law = ciarlet-geymonat
  set Shear modulus = +4
  set Lame   lambda = .5
end
subsection Initial state
  set Deformation = 1, 0.5, 0; \
                    0, 1,   0; \
                    0, 0,   1
  set Velocity = 0,0,0;0,0,-1e-3;0,0,0
end
subsection Time
  set End = 3
  set Step = 0.25
  set Method = rattle-4
  set Tolerance = 1e-13
end
subsection Continuum
  set Degree = 2
  set Refinements = 4
  set Mesh = builtin
  set Symmetry = xz
end
subsection Output
  set Directory = some where
  set Samples = 7
  set Quantities = state,  axes
  set Graphics = vtu
  set Frames = 5
end
)";

TEST_F(ReadSceneTest, ReadsEveryEntry) {
  const Scene scene = read(full_text).scene;
  EXPECT_EQ(scene.title, "Stretched ball");
  EXPECT_EQ(scene.models, std::vector<std::string>{"reduced"});
  EXPECT_EQ(scene.body.radius, 2);
  EXPECT_EQ(scene.body.density, 1500);
  EXPECT_FALSE(scene.body.incompressible);
  EXPECT_EQ(scene.material.law, "ciarlet-geymonat");
  EXPECT_EQ(scene.material.shear_modulus, 4);
  EXPECT_EQ(scene.material.lame_lambda, 0.5);
  EXPECT_EQ(scene.initial_state.deformation, (Matrix3{{{1, 0.5, 0}, {0, 1, 0}, {0, 0, 1}}}));
  EXPECT_EQ(scene.initial_state.velocity, (Matrix3{{{0, 0, 0}, {0, 0, -1e-3}, {0, 0, 0}}}));
  EXPECT_EQ(scene.time.end, 3);
  EXPECT_EQ(scene.time.step, 0.25);
  EXPECT_EQ(scene.time.method, "rattle-4");
  EXPECT_EQ(scene.time.tolerance, 1e-13);
  EXPECT_EQ(scene.continuum.degree, 2);
  EXPECT_EQ(scene.continuum.refinements, 4);
  EXPECT_EQ(scene.continuum.symmetry, Symmetry::xz);
  EXPECT_EQ(scene.output.directory, "some where");
  EXPECT_EQ(scene.output.samples, 7);
  EXPECT_TRUE(scene.output.quantities.state && scene.output.quantities.axes);
  EXPECT_FALSE(scene.output.quantities.energies || scene.output.quantities.momenta ||
               scene.output.quantities.multiplier || scene.output.quantities.nonaffine);
  EXPECT_EQ(scene.output.graphics, Graphics::vtu);
  EXPECT_EQ(scene.output.frames, 5);
}

TEST_F(ReadSceneTest, AnEmptyFileGivesTheDefaults) {
  const ReadScene read_back = read("");
  EXPECT_EQ(read_back.scene.body.radius, Scene().body.radius);
  EXPECT_EQ(read_back.scene.time.step, std::nullopt);
  EXPECT_EQ(read_back.scene.models, (std::vector<std::string>{"reduced", "continuum"}));
  EXPECT_EQ(read_back.name, "scene");
  EXPECT_EQ(read_back.origins.of("Body/Radius"), (folder_ / "scene.prm").string());
}

TEST_F(ReadSceneTest, NameIsTheFileNameWithoutPrm) {
  EXPECT_EQ(read_scene(write("a.b.prm", ""), {}, test::test_catalogue()).name, "a.b");
  EXPECT_EQ(read_scene(write("plain", ""), {}, test::test_catalogue()).name, "plain");
  EXPECT_EQ(read_scene(write("v1.5", ""), {}, test::test_catalogue()).name, "v1.5");
}

TEST_F(ReadSceneTest, TheLastSettingWins) {
  const char* const twice = "subsection Body\nset Radius = 2\nend\nsubsection Body\nset Radius = 3\nend";
  const ReadScene from_file = read(twice);
  EXPECT_EQ(from_file.scene.body.radius, 3);
  EXPECT_EQ(from_file.origins.of("Body/Radius"), (folder_ / "scene.prm").string() + ":5");
  const ReadScene overridden = read(twice, {"Body/Radius=4", " Body / Radius = 5 "});
  EXPECT_EQ(overridden.scene.body.radius, 5);
  EXPECT_EQ(overridden.origins.of("Body/Radius"), "--set");
}

TEST_F(ReadSceneTest, AnEntryThatAFileSetsTwiceIsWarnedOf) {
  const std::string file = (folder_ / "scene.prm").string();
  EXPECT_EQ(read("subsection Body\nset Radius = 2\nset Density = 1\nset Radius = 3\nend").warnings,
            std::vector{file + ":4: Body/Radius has a value already, from line 2; this one counts"});
  EXPECT_TRUE(read("set Title = a", {"Title=b", "Title=c"}).warnings.empty()) << "overrides are there to override";
  write("base.prm", "set Title = base");
  EXPECT_TRUE(read("include base.prm\nset Title = own").warnings.empty()) << "an included file is there to build on";
}

TEST_F(ReadSceneTest, OverridesReachEntriesOutsideSubsectionsAndMayHoldEqualsSigns) {
  EXPECT_EQ(read("", {"Title=a = b"}).scene.title, "a = b");
  EXPECT_EQ(read("", {"Initial  state/Velocity = 0,1,0; 1,0,0; 0,0,0"}).scene.initial_state.velocity[0][1], 1);
  EXPECT_EQ(read("set Title = x", {"Title="}).scene.title, "");
}

TEST_F(ReadSceneTest, SwitchesOfQuantitiesAndModels) {
  EXPECT_TRUE(read("", {"Output/Quantities=all"}).scene.output.quantities.momenta);
  EXPECT_FALSE(read("", {"Output/Quantities="}).scene.output.quantities.momenta);
  EXPECT_FALSE(read("", {"Output/Quantities=all"}).scene.output.quantities.bipolar);
  const auto more = read("", {"Output/Quantities=all, bipolar"}).scene.output.quantities;
  EXPECT_TRUE(more.momenta && more.bipolar && !more.pressure);
  EXPECT_EQ(read("", {"Models=continuum"}).scene.models, std::vector<std::string>{"continuum"});
  EXPECT_EQ(read("set Models = reduced", {"Models=continuum,reduced"}).scene.models.size(), 2);
}

TEST_F(ReadSceneTest, ExpressionsWaitForTheParametersOfTheSweep) {
  const ReadScene waiting =
      read("subsection Body\nset Radius = $(2*a)\nend\nsubsection Sweep\nset Parameters = a: 1, 2\nend");
  ASSERT_TRUE(waiting.scene.expressions.contains("Body/Radius"));
  EXPECT_EQ(waiting.scene.expressions.at("Body/Radius"), "$(2*a)");
  EXPECT_EQ(waiting.scene.body.radius, 2) << "that of the first run";
  EXPECT_EQ(read("set Title = $(x)").scene.title, "$(x)") << "a text is not computed";
  EXPECT_FALSE(
      read("subsection Body\nset Radius = $(2*a)\nend", {"Body/Radius=3"}).scene.expressions.contains("Body/Radius"));
}

TEST_F(ReadSceneTest, StepMayReturnToAuto) {
  EXPECT_EQ(read("subsection Time\nset Step = 0.1\nend", {"Time/Step=auto"}).scene.time.step, std::nullopt);
}

}  // namespace
}  // namespace pseudorigid::scene
