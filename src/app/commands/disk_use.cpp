#include "app/commands/disk_use.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands/compared_runs.h"
#include "app/commands/kept_trajectories.h"
#include "app/commands/table_runs.h"
#include "app/run/mesh_file.h"
#include "app/search/effort.h"
#include "io/ball_blocks.h"
#include "scene/discretization.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

namespace fs = std::filesystem;

/// Usual and largest number of characters of a number in a table. The longest number has a sign, 17 digits, a point and
/// an exponent with three digits, such as e-105. A comma follows it.
constexpr double bytes_per_value = 20, most_bytes_per_value = 25;
/// Usual number of bytes of a number in a compressed picture, measured for motions without symmetry.
constexpr double bytes_per_value_of_picture = 5;
constexpr double bytes_of_small_checkpoint = 1e4;  // mainly the text of the scene

/// Bytes of the files of a run by kind.
struct DiskUse {
  double tables = 0, pictures = 0, checkpoints = 0;
  double total() const { return tables + pictures + checkpoints; }
};

double n_samples(const scene::Scene& scene) { return scene.output.samples + 1.0; }

/// Number of entries in sweep.csv and trajectories.csv for the runs in Sweep/Part.
double values_of_sweep(const scene::Scene& scene, const scene::Needs& needs) {
  const auto [first, end] = scene::runs_of_part(scene.sweep_part, scene::n_runs(scene.sweep));
  const auto n_runs = static_cast<double>(end - first);
  if (sweeps_tables(scene)) return n_runs * static_cast<double>(columns_of_table_runs(scene, needs).size());
  if (needs.comparison) return n_runs * static_cast<double>(columns_of_compared_runs(scene, needs).size());
  const auto n_columns = static_cast<double>(columns_of_run(scene, needs).size());
  // For each column, a row has the end, least and greatest value. A row also has about ten other values, for example
  // parameters, steps and frequency.
  constexpr double per_column = 3, more = 10;
  return n_runs * (more + per_column * n_columns + (scene.sweep_trajectories ? n_samples(scene) * (n_columns + 1) : 0));
}

/// Number of entries in all tables that have a row for every sample, including the tables of comparisons.
double values_of_motion(const scene::Scene& scene, const scene::Needs& needs) {
  if (needs.system) return n_samples(scene) * static_cast<double>(columns_of_run(scene, needs).size());
  constexpr double of_comparison = 16;  // about the number of columns of a comparison file
  double n = 0, n_runs = 0;
  for (const scene::ModelDescription* model : needs.models)
    for (std::size_t i = scene::runs_of(*model, scene).size(); i > 0; --i, ++n_runs)
      n += static_cast<double>(model->header(needs.quantities).size());
  return n_samples(scene) * (n + (needs.comparison ? (n_runs - 1) * of_comparison : 0));
}

/// Number of entries in the tables of equilibria of the ball, if each table has a row for each member of the family.
double values_of_families(const scene::Scene& scene, const scene::Needs& needs) {
  double n = 0;
  for (const scene::ModelDescription* model : needs.models) n += static_cast<double>(model->equilibria.columns.size());
  return n * scene.equilibria.number;
}

/// Number of entries in all tables; empty if the motion determines the number of rows. The tables of modes, Love
/// numbers and the equilibria of systems count as 0, because they are small.
std::optional<double> values_of_tables(const scene::Scene& scene, const scene::Needs& needs) {
  using enum scene::Analysis;
  if (!scene.sweep.empty()) return values_of_sweep(scene, needs);
  if (scene.analysis == manifolds || scene.analysis == section) return std::nullopt;
  if (scene.analysis == motion) return values_of_motion(scene, needs);
  return scene.analysis == equilibrium && !needs.system ? values_of_families(scene, needs) : 0;
}

/// Number of points in a picture of the whole ball. They are the points of the finite elements, or of the blocks into
/// which the pictures of the other models divide the ball. If the discretisation of the finite elements is not known
/// yet, the number of points of the blocks is used.
double n_points(const scene::ModelDescription& model, const std::optional<Effort>& of_elements) {
  static const auto of_blocks = static_cast<double>(io::ball_blocks(4, 2).points.size());
  return model.discretized && of_elements ? of_elements->n_points_of_picture : of_blocks;
}

/// The estimated size of the finite-element run (app/search/effort.h). Empty if the scene does not use finite elements,
/// or if the discretisation is not known yet.
std::optional<Effort> effort_of_elements(const scene::Scene& scene, const scene::Needs& needs) {
  const auto fixed = scene::fixed_discretization(scene);
  if (!needs.discretized || !fixed) return std::nullopt;
  return effort_of(scene, *fixed, scene::has_mesh_file(scene) ? read_mesh_file(scene).mesh.cells.size() : 0);
}

/// Number of components per point that need space in a compressed picture. A component that is equal at all points
/// needs almost no space.
double values_per_point(const scene::ModelDescription& model, const scene::Fields& fields) {
  const double moving = 3 + (fields.displacement ? 9 : 0) + (fields.velocity ? 3 : 0);
  return moving +
         (model.has_nonaffine ? (fields.stress ? 11 : 0) + (fields.deformation ? 13 : 0) + (fields.energy ? 1 : 0) : 0);
}

double bytes_of_pictures(const scene::Scene& scene, const scene::Needs& needs,
                         const std::optional<Effort>& of_elements) {
  if (!needs.graphics) return 0;
  const int n = scene.analysis == scene::Analysis::modes ? std::min(scene.modes.number, scene.output.frames)
                                                         : scene.output.frames;
  double bytes = 0;
  for (const scene::ModelDescription* model : needs.models)
    for (std::size_t i = scene::runs_of(*model, scene).size(); i > 0; --i)
      bytes += n * bytes_per_value_of_picture * n_points(*model, of_elements) *
               values_per_point(*model, scene.output.fields);
  return bytes;
}

double bytes_of_checkpoints(const scene::Scene& scene, const std::optional<Effort>& of_elements) {
  if (scene.analysis != scene::Analysis::motion) return 0;
  constexpr double new_and_old = 2;  // both exist while a checkpoint is replaced
  return new_and_old * (bytes_of_small_checkpoint + (of_elements ? of_elements->checkpoint_bytes : 0));
}

/// The path itself if it exists, otherwise its nearest parent directory that exists.
fs::path nearest_existing(fs::path path) {
  std::error_code error;
  path = fs::absolute(path, error);
  while (!fs::exists(path, error) && path.has_relative_path()) path = path.parent_path();
  return path;
}

/// Bytes of the regular files in a folder, without its subfolders; 0 if the folder cannot be read.
double bytes_of_files(const fs::path& folder) {
  std::error_code error;
  double bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (std::error_code none; entry.is_regular_file(none)) bytes += static_cast<double>(entry.file_size(none));
  return bytes;
}

/// Free bytes on the disk of the directory, plus the bytes of the earlier results in the directory, which the run
/// replaces. Empty if the operating system does not give the free space. The function does not report other problems
/// with the directory, because the run reports them when it creates the directory.
std::optional<double> room_in(const io::RunDirectory& directory) {
  std::error_code error;
  const fs::space_info space = fs::space(nearest_existing(directory.path()), error);
  if (error) return std::nullopt;
  return static_cast<double>(space.available) + bytes_of_files(directory.path()) +
         bytes_of_files(directory.path() / "graphics");
}

}  // namespace

void describe_disk_use(const scene::Scene& scene, const io::RunDirectory& directory, scene::Needs& needs) {
  const auto room = room_in(directory);
  const auto n_values = values_of_tables(scene, needs);
  const std::string free = room ? fmt::format("; {} are free for {}", in_bytes(*room), directory.path().string()) : "";
  if (!n_values) {
    needs.needed.push_back("disk: the motion decides on the number of rows" + free);
    return;
  }
  const std::optional<Effort> of_elements = effort_of_elements(scene, needs);
  const DiskUse use{*n_values * bytes_per_value * (needs.report ? 2 : 1),  // the report contains the tables as well
                    bytes_of_pictures(scene, needs, of_elements), bytes_of_checkpoints(scene, of_elements)};
  std::string parts = fmt::format("tables {}", in_bytes(use.tables));
  if (use.pictures > 0) parts += fmt::format(", pictures {}", in_bytes(use.pictures));
  if (use.checkpoints > 0) parts += fmt::format(", checkpoints {}", in_bytes(use.checkpoints));
  needs.needed.push_back(fmt::format("disk: about {} ({}){}", in_bytes(use.total()), parts, free));
  if (room && use.total() > *room)
    needs.warnings.push_back(
        fmt::format("the results take about {}, and {} are free on the disk of {}; a full disk stops the run",
                    in_bytes(use.total()), in_bytes(*room), directory.path().string()));
}

void require_room_for_trajectories(const scene::Scene& scene, const scene::Origins& origins,
                                   const io::RunDirectory& directory) {
  if (scene.sweep.empty() || !scene.sweep_trajectories) return;
  const auto n_columns = static_cast<double>(columns_of_run(scene, scene::needs(scene)).size() + 1);
  const double n_rows = static_cast<double>(scene::n_runs(scene.sweep)) * n_samples(scene),
               needed = n_rows * n_columns * most_bytes_per_value;
  const auto room = room_in(directory);
  if (room && needed > *room)
    throw UserError(
        fmt::format("{}: Sweep/Trajectories: {:.3g} rows of {} columns would take up to {}, and {} are free on the "
                    "disk of {}. Set false, or fewer runs, Output/Samples or columns",
                    origins.of("Sweep/Trajectories"), n_rows, n_columns, in_bytes(needed), in_bytes(*room),
                    directory.path().string()));
}

}  // namespace pseudorigid::app
