/// used.prm and the lists of entries, all of which must read back.

#include "scene/print_scene.h"

#include <cmath>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "scene/entries.h"
#include "scene_files.h"

namespace pseudorigid::scene {
namespace {

using PrintScene = test::SceneFiles;

/// The values of all entries; numbers as their bits, so that equal lists mean equal to the last bit.
std::vector<std::string> bits(const Scene& scene) {
  std::vector<std::string> result;
  const auto bits_of = [](double value) {
    std::uint64_t pattern = 0;
    std::memcpy(&pattern, &value, sizeof pattern);
    return std::to_string(pattern);
  };
  visit_entries(scene, [&](const auto& member, const auto& kind, const About& about) {
    std::string value;
    if constexpr (std::is_same_v<decltype(member), const double&>)
      value = bits_of(member);
    else if constexpr (std::is_same_v<decltype(member), const std::optional<double>&>)
      value = member ? bits_of(*member) : "auto";
    else if constexpr (std::is_same_v<decltype(member), const Matrix3&>)
      for (const auto& row : member)
        for (const double entry : row) value += bits_of(entry) + " ";
    else
      value = kind.print(member);
    result.push_back(std::string(about.path) + "=" + value);
  });
  return result;
}

/// Any finite double, over all exponents.
double any_number(std::mt19937_64& random) {
  for (;;) {
    const std::uint64_t pattern = random();
    double value = 0;
    std::memcpy(&value, &pattern, sizeof value);
    if (std::isfinite(value)) return value;
  }
}

Scene any_scene(std::mt19937_64& random) {
  Scene scene = default_scene(test::test_catalogue());
  const auto positive_number = [&] { return std::max(std::abs(any_number(random)), 1e-300); };
  scene.title = "Number " + std::to_string(random());
  scene.models.clear();
  for (const ModelDescription& model : test::test_catalogue().models)
    if (random() % 2 == 0) scene.models.emplace_back(model.name);
  scene.body = {positive_number(),
                positive_number(),
                random() % 2 == 0,
                {positive_number(), positive_number(), positive_number()},
                {}};
  if (random() % 2 == 0) scene.body.inertia = Matrix3{{{any_number(random), 0, 1}, {0, 2, 0}, {1, 0, 3}}};
  loads::visit_entries(scene.loads, [&]<class Kind>(auto& member, const Kind& kind, const About&) {
    if constexpr (std::is_same_v<Kind, Number>)
      member = kind.low == 0 ? positive_number() : any_number(random);
    else if constexpr (std::is_same_v<Kind, Matrix>)
      for (auto& row : member) row = {any_number(random), any_number(random), any_number(random)};
    else if constexpr (std::is_same_v<Kind, AutoOrNumber>)
      member = positive_number();
    else if constexpr (std::is_same_v<Kind, Boolean>)
      member = random() % 2 == 0;
    else if constexpr (std::is_same_v<Kind, Numbers>)
      for (double& entry : member = {1, 2, 3}) entry = kind.number.low == 0 ? positive_number() : any_number(random);
    else
      member = {any_number(random), any_number(random), any_number(random)};
  });
  scene.initial_state.equilibrium = initial_family_kind.table[random() % initial_family_kind.table.size()].second;
  scene.initial_state.equilibrium_parameter = any_number(random);
  scene.initial_state.center = {any_number(random), 0, any_number(random)};
  scene.equilibria = {family_kind.table[random() % family_kind.table.size()].second, any_number(random),
                      any_number(random), 1 + static_cast<int>(random() % 1000), positive_number()};
  if (random() % 2 == 0)
    scene.sweep = {{"x", {any_number(random), any_number(random)}, 2 + static_cast<int>(random() % 9)},
                   {"y_2", {any_number(random), any_number(random), any_number(random)}, {}}};
  scene.material.law = materials::law_table[random() % std::size(materials::law_table)].name;
  for (const materials::LawEntry& entry : materials::law_entries)
    scene.material.*entry.member =
        std::isinf(entry.high) ? positive_number() : std::uniform_real_distribution<>(entry.low, entry.high)(random);
  for (auto* matrix : {&scene.initial_state.deformation, &scene.initial_state.velocity})
    for (auto& row : *matrix)
      for (double& entry : row) entry = random() % 3 ? any_number(random) : -0.0;
  scene.time.end = positive_number();
  if (random() % 2) scene.time.step = positive_number();
  const auto methods = method_kind(test::test_catalogue()).allowed;
  scene.time.method = methods[random() % methods.size()];
  scene.time.tolerance = std::uniform_real_distribution<>(1e-13, 1e-1)(random);
  scene.continuum = {static_cast<int>(1 + random() % 8),
                     static_cast<int>(random() % 5),
                     std::uniform_real_distribution<>(1e-10, 1e-1)(random),
                     error_estimate_kind.table[random() % error_estimate_kind.table.size()].second,
                     static_cast<int>(2 + random() % 15),
                     std::uniform_real_distribution<>(0, 10)(random),
                     random() % 2 ? std::string(builtin_mesh) : "/meshes/a body.msh",
                     symmetry_kind.table[random() % symmetry_kind.table.size()].second,
                     static_cast<int>(2 + random() % 15),
                     std::uniform_real_distribution<>(0.05, 1)(random)};
  if (random() % 2) scene.continuum.degree.reset();
  if (random() % 2) scene.continuum.refinements.reset();
  if (random() % 2) scene.continuum.gravity_points.reset();
  if (random() % 2) scene.continuum.contact_points.reset();
  if (random() % 2) scene.continuum.volumetric_stiffness.reset();
  const auto coin = [&] { return random() % 2 == 0; };
  scene.output = {"out/" + std::to_string(random()),
                  static_cast<int>(1 + random() % 10'000'000),
                  {coin(), coin(), coin(), coin(), coin(), coin()},
                  coin() ? Graphics::none : Graphics::vtu,
                  static_cast<int>(1 + random() % 1'000'000),
                  {},
                  coin() ? Cells::linear : Cells::lagrange,
                  coin()};
  for (const auto& [name, member] : fields_kind.table) scene.output.fields.*member = coin();
  scene.polynomial = {{1 + static_cast<int>(random() % 3), 4, 5 + static_cast<int>(random() % 9)},
                      std::uniform_real_distribution<>(1e-10, 0.1)(random),
                      static_cast<int>(2 + random() % 23),
                      static_cast<int>(2 + random() % 23),
                      static_cast<int>(2 + random() % 23)};
  if (coin()) scene.polynomial.degrees.clear();
  if (coin()) scene.polynomial.gravity_points.reset();
  if (coin()) scene.polynomial.quadrature_points.reset();
  return scene;
}

TEST_F(PrintScene, UsedPrmReadsBackBitForBit) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 500; ++i) {
    const Scene scene = any_scene(random);
    ASSERT_EQ(bits(read(to_prm(scene)).scene), bits(scene)) << to_prm(scene);
  }
}

TEST_F(PrintScene, UsedPrmOfASystemHoldsItsOwnEntriesAlone) {
  const ReadScene top = read("set System = top", {"Top/Axis = 0.1, -2, 1e-300", "Top/Spin=3"});
  const std::string text = to_prm(top.scene, top.origins);
  EXPECT_NE(text.find("  set Axis = 0.1, -2, 1e-300  # from --set\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("Radius"), std::string::npos) << text;
  EXPECT_EQ(bits(read(text).scene), bits(top.scene));
}

TEST_F(PrintScene, AwkwardTextsReadBack) {
  for (const char* title : {"", "a  b", "ends with \\", "a = b", "set X = 1", "end", "über Größe", "\"quoted\""}) {
    Scene scene = default_scene(test::test_catalogue());
    scene.title = title;
    EXPECT_EQ(read(to_prm(scene)).scene.title, title);
    EXPECT_EQ(bits(read(to_prm(scene)).scene), bits(scene));
  }
}

TEST_F(PrintScene, UsedPrmMarksOverrides) {
  const ReadScene overridden = read("set Title = x", {"Body/Radius=0.1"});
  const std::string text = to_prm(overridden.scene, overridden.origins);
  EXPECT_NE(text.find("  set Radius = 0.1  # from --set\n"), std::string::npos) << text;
  EXPECT_NE(text.find("set Title = x\n"), std::string::npos) << text;
  EXPECT_EQ(bits(read(text).scene), bits(overridden.scene));
}

TEST_F(PrintScene, ParametersAsPrmAreTheDefaults) {
  const Catalogue& catalogue = test::test_catalogue();
  EXPECT_EQ(bits(read(parameters(Format::prm, catalogue)).scene), bits(default_scene(catalogue)));
}

TEST_F(PrintScene, EveryDefaultIsAllowedAndEveryEntryIsDocumented) {
  Scene scene = default_scene(test::test_catalogue());
  int n_entries = 0;
  visit_entries(scene, [&](auto& member, const auto& kind, const About& about) {
    ++n_entries;
    EXPECT_EQ(kind.read(kind.print(member), member), std::nullopt) << about.path;
    EXPECT_FALSE(kind.expected().empty()) << about.path;
    EXPECT_TRUE(about.documentation.ends_with(".")) << about.path;
  });
  EXPECT_GT(n_entries, 0);
}

TEST_F(PrintScene, JsonHoldsEveryEntry) {
  const auto json = nlohmann::json::parse(parameters(Format::json, test::test_catalogue()));
  const Scene scene = default_scene(test::test_catalogue());
  std::size_t i = 0;
  visit_entries(std::as_const(scene), [&](const auto& member, const auto& kind, const About& about) {
    ASSERT_LT(i, json.size());
    EXPECT_EQ(json[i]["entry"], about.path);
    EXPECT_EQ(json[i]["type"], kind.type);
    EXPECT_EQ(json[i]["default"], kind.print(member));
    EXPECT_EQ(json[i]["expected"], kind.expected());
    EXPECT_EQ(json[i]["words"].size(), kind.words().size());
    EXPECT_EQ(json[i]["unit"], std::string_view(about.unit));
    EXPECT_EQ(json[i]["documentation"], about.documentation);
    ++i;
  });
  EXPECT_EQ(i, json.size());
}

TEST_F(PrintScene, JsonSaysTheTypeOfTheEntriesOfSystemsToo) {
  for (const auto& about : nlohmann::json::parse(parameters(Format::json, test::test_catalogue()))) {
    EXPECT_NE(about["type"], "") << about["entry"];
    if (about["entry"] == "Top/Spin") {
      EXPECT_EQ(about["type"], Number::type);
    }
  }
}

TEST_F(PrintScene, MarkdownTablesAreWellFormed) {
  std::istringstream lines(parameters(Format::markdown, test::test_catalogue()));
  int bars_of_table = 0;
  for (std::string line; std::getline(lines, line);) {
    int bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    if (bars_of_table > 0 && bars > 0) {
      EXPECT_EQ(bars, bars_of_table) << line;
    }
    bars_of_table = bars;
  }
  EXPECT_EQ(bars_of_table, 4) << "the columns of the last system come last";
}

}  // namespace
}  // namespace pseudorigid::scene
