#include "app/commands/resume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "app/commands/files_of_run.h"
#include "app/commands/kept_trajectories.h"
#include "app/run/model_checkpoint.h"
#include "entries/entry_kinds.h"
#include "entries/wording.h"
#include "io/checkpoint.h"
#include "io/csv.h"
#include "io/files.h"
#include "io/pvd.h"
#include "scene/prm_reader.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

constexpr const char* end_of_time = "Time/End";
constexpr const char* number_of_samples = "Output/Samples";
/// Entries that may change when a run is resumed. `keep_sampling` has already checked Time/End and set Output/Samples.
/// The other entries concern pictures, and only new pictures depend on their new values. Other entries of the section
/// Time need not be in the list, because the compared texts do not contain their values (`run_identity`).
constexpr std::array<std::string_view, 6> may_change{end_of_time,     number_of_samples, "Output/Frames",
                                                     "Output/Fields", "Output/Cells",    "Output/Graphics"};

using Entries = std::map<std::string, std::string>;

/// Maps the paths of the entries in the text `prm` to their values. `origin` is the file that contains the text, for
/// messages.
Entries entries_of(const std::string& prm, const std::filesystem::path& origin) {
  Entries entries;
  scene::read_prm_text(prm, origin, [&](const scene::Statement& statement) {
    if (statement.value) entries[statement.path] = *statement.value;
  });
  return entries;
}

/// The entries of the scene that the checkpoint at this path contains.
Entries entries_of(const std::filesystem::path& checkpoint) {
  return entries_of(io::Checkpoint::load(checkpoint).get_string("scene"), checkpoint);
}

/// The value of an entry as a number; empty if the entry does not exist or is not a finite number.
std::optional<double> number(const Entries& entries, const char* path) {
  const auto found = entries.find(path);
  return found == entries.end() ? std::nullopt : scene::finite_number(found->second);
}

/// A change of an entry as text, for example "Body/Radius = 2, which was 1". One of the two scenes may lack the entry.
std::string change_of(const std::string& path, const Entries& now, const Entries& before) {
  const auto found = now.find(path), old = before.find(path);
  if (found == now.end()) return fmt::format("{} is not there, and was {}", path, scene::quote(old->second));
  if (old == before.end()) return fmt::format("{} = {}, which was not there", path, scene::quote(found->second));
  return fmt::format("{} = {}, which was {}", path, scene::quote(found->second), scene::quote(old->second));
}

/// A text with the first five changes of entries that must not change, and the number of further ones; "" if there is
/// none. In a sweep no entry may change.
std::string changes_between(const Entries& now, const Entries& before, bool is_sweep) {
  Entries all = now;
  all.insert(before.begin(), before.end());
  constexpr int most = 5;
  int n = 0;
  std::string text;
  for (const auto& [path, value] : all) {
    const auto found = now.find(path), old = before.find(path);
    if (found != now.end() && old != before.end() && found->second == old->second) continue;
    if (!is_sweep && std::ranges::find(may_change, path) != may_change.end()) continue;
    if (++n <= most) text += (n > 1 ? "; " : "") + change_of(path, now, before);
  }
  return n > most ? fmt::format("{}; and {} more", text, n - most) : text;
}

/// The names of the columns of each CSV file with samples. The key is the name of the file without ".csv".
std::map<std::string, std::vector<std::string>> headers(const scene::Scene& scene, const scene::Needs& needs) {
  if (needs.system) return {{std::string(needs.system->file), columns_of_run(scene, needs)}};
  std::map<std::string, std::vector<std::string>> headers;
  for (const scene::ModelDescription* model : needs.models)
    for (const scene::ModelRun& run : scene::runs_of(*model, scene))
      headers[run.name] = model->header(needs.quantities);
  return headers;
}

/// Throws UserError if a row of a table of shapes is incomplete. A killed run may have left such a row. Does nothing if
/// the table does not exist.
void require_shapes(const std::filesystem::path& path) {
  if (io::is_there(path)) io::require_rows(path, io::columns_in(path), io::n_rows_before(path, HUGE_VAL));
}

/// Throws UserError if the table of samples of an earlier run is missing. Also throws UserError if a table, the list of
/// pictures or the checkpoint is damaged. `name` is the name of the files of the run. Does nothing if there is no
/// checkpoint.
void require_files_of_run(const io::RunDirectory& directory, const std::string& name,
                          const std::vector<std::string>& columns) {
  if (!io::is_there(directory.checkpoint(name))) return;
  io::require_rows(directory.csv(name), columns, n_samples_taken(io::Checkpoint::load(directory.checkpoint(name))));
  io::PvdCollection::resume(directory.pvd(name), HUGE_VAL);
  for (const std::string& shapes : {std::string("shapes"), "shapes-" + name}) require_shapes(directory.csv(shapes));
}

}  // namespace

std::vector<std::filesystem::path> checkpoints(const io::RunDirectory& directory, const scene::Scene& scene) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& name : writers_of_checkpoints(*scene.catalogue)) paths.push_back(directory.checkpoint(name));
  std::erase_if(paths, [](const auto& path) { return !io::is_there(path); });
  return paths;
}

void keep_sampling(scene::Scene& scene, const io::RunDirectory& directory) {
  const auto found = checkpoints(directory, scene);
  if (found.empty() || !scene.sweep.empty() || scene.analysis != scene::Analysis::motion) return;
  const Entries before = entries_of(found.front());
  const auto end = number(before, end_of_time), n = number(before, number_of_samples);
  if (!end || !n) return;
  // If time runs backwards, the end in a checkpoint is positive, but the end in used.prm is negative.
  const auto used = number(entries_of(io::read_file(directory.used_prm()), directory.used_prm()), end_of_time);
  if (used && (*used < 0) != (scene.time.end < 0))
    throw UserError(
        fmt::format("Time/End = {} is on the other side of the start than the end of the run, {}; a "
                    "resumed run goes on the same way",
                    scene::print_number(scene.time.end), scene::print_number(*used)));
  const double length = std::abs(scene.time.end), interval = *end / *n, n_intervals = std::round(length / interval);
  if (length < *end)
    throw UserError(fmt::format("Time/End = {} is before the end of the run, {}; a resumed run ends there or later",
                                scene::print_number(scene.time.end), scene::print_number(*end)));
  if (n_intervals > scene::largest_number_of_samples)
    throw UserError(
        fmt::format("Time/End = {} makes {:.17g} samples at the interval between them, {}, which a resumed run keeps; "
                    "at most {} can be written, until {}",
                    scene::print_number(scene.time.end), n_intervals, scene::print_number(interval),
                    scene::largest_number_of_samples,
                    scene::print_number(std::copysign(scene::largest_number_of_samples * interval, scene.time.end))));
  if (std::abs(length / interval - n_intervals) > 1e-9 * n_intervals)
    throw UserError(
        fmt::format("Time/End = {} is not a multiple of the interval between samples, {}, which a resumed run keeps; "
                    "the next multiple is {}",
                    scene::print_number(scene.time.end), scene::print_number(interval),
                    scene::print_number(std::copysign(std::ceil(length / interval) * interval, scene.time.end))));
  scene.output.samples = static_cast<int>(n_intervals);
}

void require_sound_files(const io::RunDirectory& directory, const scene::Scene& scene, const scene::Needs& needs) {
  if (!scene.sweep.empty() || scene.analysis != scene::Analysis::motion) return;
  for (const auto& [name, columns] : headers(scene, needs)) require_files_of_run(directory, name, columns);
}

void require_same_scene(const io::RunDirectory& directory, const scene::Scene& scene) {
  for (const auto& path : checkpoints(directory, scene)) {
    const std::string apart =
        changes_between(entries_of(run_identity(scene).frozen_scene, "scene"), entries_of(path), !scene.sweep.empty());
    if (!apart.empty())
      throw UserError(fmt::format(
          "the checkpoint in {} is of another scene: {}; only Time/Step, Time/Method, Time/Tolerance, Time/Constraint "
          "tolerance, a later Time/End and the entries of pictures may change",
          directory.path().string(), apart));
  }
}

}  // namespace pseudorigid::app
