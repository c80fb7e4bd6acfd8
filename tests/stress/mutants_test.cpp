/// Damaged parameter files, checkpoints and meshes: each is refused in one sentence, or what was accepted is right. A
/// scene that is accepted obeys every range and prints as itself; a checkpoint that is accepted is the original; a mesh
/// that is accepted has positive Jacobians and hangs together.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "app/commands/scene_to_run.h"
#include "app/commands/sweep.h"
#include "app/models/catalogue.h"
#include "app/run/mesh_file.h"
#include "entries/matrix3.h"
#include "io/checkpoint.h"
#include "io/gmsh.h"
#include "io/largest_allocation.h"
#include "scene/needs.h"
#include "scene/print_scene.h"
#include "scene/read_scene.h"
#include "scene/user_error.h"
#include "stress/mutants.h"
#include "support/two_cubes.h"

namespace pseudorigid::testing {
namespace {

using io::test::put;
using io::test::ScratchDirectory;

/// No reader takes more than a file could mean: parameter files end at 1 MiB, the meshes here have 24 kB.
constexpr std::size_t largest_allocation = 16 << 20;

// Parameter files.

scene::Scene scene_that_runs(const scene::ReadScene& raw) {
  const scene::Scene scene = app::scene_to_run(raw.scene, raw.origins);
  app::check_sweep(raw);
  app::require_mesh_file(scene, raw.origins);
  return scene;
}

bool is_positive(double x) { return x > 0 && std::isfinite(x); }

void expect_in_range(const scene::Scene& s) {
  EXPECT_TRUE(is_positive(s.body.radius) && is_positive(s.body.density) && is_positive(s.material.shear_modulus));
  EXPECT_TRUE(is_positive(s.material.lame_lambda));
  EXPECT_TRUE(s.material.mooney_fraction >= 0 && s.material.mooney_fraction <= 1);
  loads::visit_entries(s.loads, [](const auto& member, const auto& kind, const scene::About& about) {
    auto again = member;
    EXPECT_EQ(kind.read(kind.print(member), again), std::nullopt) << about.path;
    EXPECT_EQ(again, member) << about.path;
  });
  EXPECT_TRUE(std::isfinite(scene::largest_entry(s.initial_state.velocity)));
  for (const auto* row : {&s.initial_state.center, &s.initial_state.center_velocity, &s.body.semi_axes}) {
    EXPECT_EQ(row->size(), 3u);
    for (const double x : *row) EXPECT_TRUE(std::isfinite(x));
  }
  EXPECT_TRUE(is_positive(s.time.end));
  EXPECT_TRUE(!s.time.step || (is_positive(*s.time.step) && *s.time.step <= s.time.end));
  EXPECT_TRUE(s.time.tolerance >= 1e-13 && s.time.tolerance <= 0.1);
  EXPECT_TRUE(s.continuum.tolerance >= 1e-10 && s.continuum.tolerance <= 0.1);
  EXPECT_TRUE(!s.continuum.degree || (*s.continuum.degree >= 1 && *s.continuum.degree <= 8));
  EXPECT_TRUE(!s.continuum.refinements || (*s.continuum.refinements >= 0 && *s.continuum.refinements <= 4));
  EXPECT_TRUE(s.output.samples >= 1 && s.output.samples <= 10'000'000);
  EXPECT_GE(s.output.frames, 1);
  EXPECT_FALSE(s.output.directory.empty());
  if (s.system != scene::ball) return;
  EXPECT_TRUE(is_positive(scene::det(s.initial_state.deformation)));
  if (!s.body.incompressible) return;
  // What the validation projects to: round-off of a matrix of this condition.
  const auto& Q = s.initial_state.deformation;
  const double size = scene::inner(scene::absolute(Q), scene::absolute(scene::cofactor(Q)));
  EXPECT_NEAR(scene::det(Q), 1, 1e-14 * size);
}

/// What the scene prints reads back as the same scene.
void expect_to_print_as_itself(const scene::Scene& scene, const ScratchDirectory& scratch) {
  const std::string printed = scene::to_prm(scene);
  put(scratch / "used.prm", printed);
  const auto again = scene::read_scene(scratch / "used.prm", {}, app::program_catalogue());
  EXPECT_EQ(scene::to_prm(app::scene_to_run(again.scene, again.origins)), printed);
}

TEST(Mutants, OfParameterFiles) {
  const ScratchDirectory scratch;
  const std::vector<std::string> seeds = texts_of(PARAMS, ".prm");
  ASSERT_GT(seeds.size(), 20u);
  std::mt19937_64 random(11);
  Tally tally{"parameter files"};
  for (int i = 0; i < n_mutants(); ++i) {
    const std::string text = damaged_text(seeds[i % seeds.size()], prm_words, seeds, random);
    SCOPED_TRACE("mutant " + std::to_string(i) + ":\n" + text);
    put(scratch / "scene.prm", text);
    io::test::largest_allocation = 0;
    try {
      const auto raw = scene::read_scene(scratch / "scene.prm", {}, app::program_catalogue());
      const scene::Scene scene = scene_that_runs(raw);
      ++tally.n_accepted;
      expect_in_range(scene);
      EXPECT_FALSE(scene::describe(scene, scene::needs(scene)).empty());
      if (scene.sweep.empty()) expect_to_print_as_itself(scene, scratch);
    } catch (const UserError& error) {
      ++tally.n_refused;
      EXPECT_TRUE(is_one_sentence(error.what()));
    }
    EXPECT_LT(io::test::largest_allocation, largest_allocation);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(tally.n_refused, n_mutants() / 3);
  EXPECT_GT(tally.n_accepted, n_mutants() / 20) << "of a test that accepts nothing, nothing is learnt";
}

// Checkpoints.

io::Checkpoint random_checkpoint(std::mt19937_64& random) {
  io::Checkpoint checkpoint;
  std::vector<double> values(below(3000, random));
  for (double& x : values) x = std::ldexp(static_cast<double>(random()), -64);
  checkpoint.set("q", values);
  checkpoint.set("v", std::vector<double>(below(100, random), 0.5));
  checkpoint.set("sample", static_cast<long>(below(1000, random)));
  checkpoint.set("scene", std::string(below(2000, random), 's'));
  for (std::size_t i = below(10, random); i > 0; --i) checkpoint.set("entry " + std::to_string(i), 1.0 / i);
  return checkpoint;
}

TEST(Mutants, OfCheckpoints) {
  const ScratchDirectory scratch;
  std::mt19937_64 random(12);
  Tally tally{"checkpoints"};
  std::string good;
  for (int i = 0; i < n_mutants(); ++i) {
    if (i % 10 == 0) {
      random_checkpoint(random).save(scratch / "good.bin");
      good = io::test::contents(scratch / "good.bin");
    }
    const std::string bytes = damaged_bytes(good, 0, random);
    put(scratch / "mutant.bin", bytes);
    io::test::largest_allocation = 0;
    try {
      io::Checkpoint::load(scratch / "mutant.bin");
      ++tally.n_accepted;
      ASSERT_EQ(bytes, good) << "mutant " << i;
    } catch (const UserError& error) {
      ++tally.n_refused;
      ASSERT_TRUE(is_one_sentence(error.what())) << "mutant " << i;
    }
    ASSERT_LT(io::test::largest_allocation, largest_allocation) << "mutant " << i;
  }
  EXPECT_GT(tally.n_refused, n_mutants() / 2);
}

// Meshes.

/// det ∂X/∂ξ of the trilinear map of a cell, written out.
double jacobian(const io::HexahedralMesh& mesh, const std::array<unsigned int, 8>& cell, const Eigen::Vector3d& xi) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d V = Eigen::Map<const Eigen::Vector3d>(mesh.vertices[cell[i]].data());
    for (int d = 0; d < 3; ++d) {
      double slope = i >> d & 1 ? 1 : -1;
      for (int e = 0; e < 3; ++e)
        if (e != d) slope *= i >> e & 1 ? xi[e] : 1 - xi[e];
      H.col(d) += slope * V;
    }
  }
  return H.determinant();
}

/// Positive at 5³ points of every cell, and in one piece: by vertices, which bodies joined at faces share as well.
void expect_sound(const io::HexahedralMesh& mesh) {
  std::vector<unsigned int> root(mesh.vertices.size());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](unsigned int v) {
    while (root[v] != v) v = root[v];
    return v;
  };
  for (const auto& cell : mesh.cells) {
    ASSERT_EQ(std::set<unsigned int>(cell.begin(), cell.end()).size(), 8u);
    for (const unsigned int v : cell) {
      ASSERT_LT(v, mesh.vertices.size());
      root[find(v)] = find(cell[0]);
    }
    for (int k = 0; k < 125; ++k) ASSERT_GT(jacobian(mesh, cell, 0.25 * Eigen::Vector3d(k % 5, k / 5 % 5, k / 25)), 0);
  }
  for (unsigned int v = 0; v < mesh.vertices.size(); ++v) {
    ASSERT_EQ(find(v), find(0));
    for (const double x : mesh.vertices[v]) ASSERT_TRUE(std::isfinite(x));
  }
  const io::MeshSize size = io::size_of(mesh);
  ASSERT_TRUE(is_positive(size.volume) && is_positive(size.radius));
  for (const double x : size.center) ASSERT_TRUE(std::isfinite(x));
}

TEST(Mutants, OfMeshes) {
  const ScratchDirectory scratch;
  std::vector<std::string> seeds = texts_of(MESHES, ".msh");
  ASSERT_EQ(seeds.size(), 2u);
  // Where the file is small, changes hit its structure.
  seeds.insert(seeds.end(), {two_cubes, two_cubes, two_cubes});
  const std::vector<std::string> words{"$EndNodes\n", "$Nodes\n", "\n",    "$", "$Elements\n", "5 2 0 1 ",
                                       " 1 2 3 4",    "1e99",     "-0.5 ", "1", "0.25 "};
  std::mt19937_64 random(13);
  Tally tally{"meshes"};
  for (int i = 0; i < n_mutants(); ++i) {
    const std::string text = damaged_text(seeds[i % seeds.size()], words, seeds, random);
    put(scratch / "body.msh", text);
    io::test::largest_allocation = 0;
    try {
      const io::HexahedralMesh mesh = io::read_gmsh(scratch / "body.msh");
      ++tally.n_accepted;
      expect_sound(mesh);
    } catch (const UserError& error) {
      ++tally.n_refused;
      EXPECT_TRUE(is_one_sentence(error.what()));
    }
    EXPECT_LT(io::test::largest_allocation, largest_allocation);
    if (::testing::Test::HasFailure()) {
      put(::testing::TempDir() + "refused_by_nobody.msh", text);
      FAIL() << "mutant " << i << " is kept as refused_by_nobody.msh";
    }
  }
  EXPECT_GT(tally.n_refused, n_mutants() / 3);
  EXPECT_GT(tally.n_accepted, n_mutants() / 100) << "of a test that accepts nothing, nothing is learnt";
}

}  // namespace
}  // namespace pseudorigid::testing
