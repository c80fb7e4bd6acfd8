#include "app/commands/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <iterator>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "analysis/motion.h"
#include "app/commands/kept_trajectories.h"
#include "app/commands/scene_to_run.h"
#include "app/commands/sweep_rows.h"
#include "app/run/scene_to_model.h"
#include "entries/entry_kinds.h"
#include "io/signals.h"
#include "scene/expressions.h"
#include "scene/needs.h"
#include "scene/scales.h"
#include "scene/user_error.h"

namespace pseudorigid::app {
namespace {

std::string describe_values(const scene::ParameterValues& values) {
  std::string text;
  for (const auto& [name, value] : values)
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, scene::print_number(value));
  return text;
}

scene::Scene scene_of_run(const scene::ReadScene& raw, const scene::ParameterValues& values) {
  return scene_to_run(scene::with_parameters(raw.scene, values, raw.origins), raw.origins);
}

std::string describe_run(const scene::Sweep& sweep, int k) {
  return fmt::format("run {} of the sweep, {}", k + 1, describe_values(scene::values_of_run(sweep, k)));
}

/// The runs in which each parameter has its first or its last value.
std::set<int> corners(const scene::Sweep& sweep) {
  std::set<int> runs{0};
  for (const scene::SweepParameter& parameter : sweep) {
    std::set<int> with_this_one;
    for (const int k : runs)
      for (const int i : {0, parameter.size() - 1}) with_this_one.insert(k * parameter.size() + i);
    runs = std::move(with_this_one);
  }
  return runs;
}

/// Of the ball.
std::set<std::string> names_conserved(bool is_free, bool incompressible) {
  std::set<std::string> names{"energy"};  // what loads and dissipation give and take is a part of it
  if (is_free) names.insert({"J1", "J2", "J3", "Z1", "Z2", "Z3"});
  if (incompressible) names.insert("volume_ratio");
  return names;
}

/// Names of the ball's columns that no run of the sweep changes but by its error, judged by the ends of the parameters'
/// ranges: a value and a drift say all of them.
std::set<std::string> conserved_columns(const scene::ReadScene& raw) {
  bool is_free = true, incompressible = true;
  for (const int k : corners(raw.scene.sweep)) {
    // Not checked again: check_sweep has done it.
    const scene::Scene scene = scene::with_parameters(raw.scene, scene::values_of_run(raw.scene.sweep, k), raw.origins);
    if (scene.system != scene::ball) return {};
    is_free = is_free && scene::is_free(scene);
    incompressible = incompressible && scene.body.incompressible;
  }
  return names_conserved(is_free, incompressible);
}

constexpr std::array<const char*, 5> columns_of_any{"finished", "time", "steps", "forces", "estimated_time_error"};
constexpr std::array<const char*, 2> columns_of_frequencies{"frequency", "amplitude"};

bool has_frequencies(const scene::Needs& needs) { return !needs.system && needs.quantities.state; }

/// The columns of sweep.csv.
std::vector<std::string> columns_of_sweep(const scene::Scene& scene, const scene::Needs& needs,
                                          const std::set<std::string>& conserved) {
  const std::vector<std::string> of_model = columns_of_run(scene, needs);
  std::vector<std::string> names{"run"};
  for (const auto& parameter : scene.sweep) names.push_back(parameter.name);
  names.insert(names.end(), columns_of_any.begin(), columns_of_any.end());
  if (has_frequencies(needs)) names.insert(names.end(), columns_of_frequencies.begin(), columns_of_frequencies.end());
  for (std::size_t i = 1; i < of_model.size(); ++i)
    if (conserved.contains(of_model[i]))
      names.insert(names.end(), {of_model[i], of_model[i] + "_drift"});
    else
      for (const char* what : {"end", "min", "max"}) names.push_back(of_model[i] + "_" + what);
  return names;
}

[[noreturn]] void refuse_parameter(const scene::ReadScene& raw, const std::string& sentence) {
  constexpr const char* entry = "Sweep/Parameters";
  throw UserError(fmt::format("{}: {}: {}", raw.origins.of(entry), entry, sentence));
}

/// A parameter is a column of sweep.csv, where no other may have its name.
void require_own_names(const scene::ReadScene& raw) {
  scene::Scene scene = scene_of_run(raw, scene::values_of_run(raw.scene.sweep, 0));
  const scene::Sweep parameters = std::exchange(scene.sweep, {});
  const scene::Needs needs = scene::needs(scene);
  std::vector<std::string> taken(columns_of_frequencies.begin(), columns_of_frequencies.end());
  for (const auto& conserved :
       {std::set<std::string>{}, needs.system ? std::set<std::string>{} : names_conserved(true, true)})
    std::ranges::copy(columns_of_sweep(scene, needs, conserved), std::back_inserter(taken));
  for (const auto& parameter : parameters)
    if (std::ranges::find(taken, parameter.name) != taken.end())
      refuse_parameter(
          raw, fmt::format("expected other names than those of the columns of sweep.csv, got \"{}\"", parameter.name));
}

/// A parameter that is in no expression would give equal runs.
void require_used(const scene::ReadScene& raw) {
  std::set<std::string> used;
  for (const auto& [path, text] : raw.scene.expressions) used.merge(scene::names_used(text, raw.scene.sweep));
  for (const auto& parameter : raw.scene.sweep)
    if (!used.contains(parameter.name))
      refuse_parameter(raw, fmt::format("expected parameters that an entry uses, as in $({}), got \"{}\", which none "
                                        "does",
                                        parameter.name, parameter.name));
}

/// What one run has to say.
struct RunResult {
  io::Table rows;
  ModelOutcome outcome;
};

class SweepRun {
 public:
  SweepRun(const scene::ReadScene& raw, RunModel run, RunTogether together, const RunContext& context)
      : raw_(raw),
        run_(run),
        together_(raw.scene.sweep_lanes ? together : nullptr),
        context_(context),
        conserved_(conserved_columns(raw)),
        silent_(io::make_logger(io::Verbosity::silent, {})) {}

  RunResult run(int k) const {
    RunResult result;
    const scene::Scene scene = scene_of_run(raw_, scene::values_of_run(raw_.scene.sweep, k));
    result.outcome = run_(context_of(scene, result));
    return result;
  }

  /// The runs first, …, last − 1 at once; nothing where each has to run by itself.
  std::optional<std::vector<RunResult>> run_together(int first, int last) const {
    if (!together_) return {};
    std::vector<RunResult> results(static_cast<std::size_t>(last - first));
    std::vector<scene::Scene> scenes;
    try {
      for (int k = first; k < last; ++k)
        scenes.push_back(scene_of_run(raw_, scene::values_of_run(raw_.scene.sweep, k)));
    } catch (const UserError&) {  // will be said of the run that it is about
      return {};
    }
    std::vector<RunContext> contexts;
    for (std::size_t i = 0; i < scenes.size(); ++i) contexts.push_back(context_of(scenes[i], results[i]));
    auto outcomes = together_(contexts);
    if (!outcomes) return {};
    for (std::size_t i = 0; i < scenes.size(); ++i) results[i].outcome = std::move((*outcomes)[i]);
    return results;
  }

  std::vector<std::string> columns() const { return columns_of_sweep(context_.scene, context_.needs, conserved_); }

  std::vector<double> row(int k, const RunResult& result) const {
    std::vector<double> row{k + 1.0};
    const scene::ParameterValues values = scene::values_of_run(raw_.scene.sweep, k);
    for (const auto& parameter : raw_.scene.sweep) row.push_back(values.at(parameter.name));
    const io::Table& table = result.rows;
    const std::size_t n = table.n_rows();
    row.push_back(result.outcome.end == mechanics::Outcome::finished);
    row.push_back(n > 0 ? table.row(n - 1)[0] : 0);
    const auto& counters = result.outcome.statistics.counters;
    for (const char* name : {"steps", "forces", "estimated_time_error"}) {
      const auto found = counters.find(name);
      row.push_back(found != counters.end() ? found->second : 0);
    }
    if (has_frequencies(context_.needs)) add_frequency(table, row);
    for (std::size_t c = 1; c < table.columns.size(); ++c) {
      double least = n > 0 ? table.row(0)[c] : 0, most = least;
      for (std::size_t i = 1; i < n; ++i) {
        least = std::min(least, table.row(i)[c]);
        most = std::max(most, table.row(i)[c]);
      }
      if (conserved_.contains(table.columns[c]))
        row.insert(row.end(), {n > 0 ? table.row(0)[c] : 0, most - least});
      else
        row.insert(row.end(), {n > 0 ? table.row(n - 1)[c] : 0, least, most});
    }
    return row;
  }

 private:
  RunContext context_of(const scene::Scene& scene, RunResult& result) const {
    return {
        .scene = scene,
        .needs = context_.needs,
        .directory = context_.directory,
        .units = units_of(scene),
        .log = silent_,
        .sink_of = [&result](const RunContext&, const char*) { return std::make_unique<RowsInMemory>(result.rows); }};
  }

  void add_frequency(const io::Table& table, std::vector<double>& row) const {
    analysis::ModelSummary model;
    if (table.n_rows() > 1)
      model = analysis::summarize_motion({"", "", table}, {.resolution = context_.scene.time.tolerance}).model;
    row.push_back(model.frequency ? model.frequency.dominant().frequency : 0);
    row.push_back(model.strain_amplitude);
  }

  const scene::ReadScene& raw_;
  RunModel run_;
  RunTogether together_;
  const RunContext& context_;
  std::set<std::string> conserved_;
  std::shared_ptr<io::Logger> silent_;
};

/// All runs that have no row yet, by several threads that take the next group each. Groups are the same whatever the
/// threads are and wherever a sweep was interrupted, and so are the rows. A thread that finds no memory leaves its
/// group to the others; the last goes on alone.
class Workers {
 public:
  Workers(const SweepRun& sweep, const scene::Sweep& parameters, const RunContext& context, SweepRows& rows)
      : sweep_(sweep),
        parameters_(parameters),
        context_(context),
        rows_(rows),
        first_(rows.n_written()),
        n_runs_(scene::n_runs(parameters)),
        next_(first_ / group * group) {}

  /// Returns the number of threads that the system has given.
  int work(int n_threads) {
    left_.reserve(static_cast<std::size_t>(n_threads));  // later there may be no room
    std::vector<std::jthread> threads;
    try {
      while (static_cast<int>(threads.size()) + 1 < n_threads) threads.emplace_back([this] { take_groups(true); });
    } catch (const std::exception& refusal) {  // of a system call or for want of memory
      context_.log->warn("sweep: {} threads in place of {}: {}", threads.size() + 1, n_threads, refusal.what());
    }
    take_groups(true);
    for (std::jthread& thread : threads) thread.join();
    take_groups(false);
    if (error_) std::rethrow_exception(error_);
    return static_cast<int>(threads.size()) + 1;
  }

  int n_failed() const { return n_failed_; }
  int n_together() const { return n_together_; }
  /// The first run whose input is wrong, and what is wrong with it.
  const std::optional<std::pair<int, std::string>>& wrong_input() const { return wrong_input_; }

 private:
  static constexpr int group = 8;

  /// Runs of which those from `next` on have no row.
  struct Group {
    int begin, next, end;
  };

  std::optional<Group> take() {
    const std::lock_guard lock(mutex_);
    if (io::interrupt_requested()) return {};
    if (!left_.empty()) {
      const Group taken = left_.back();
      left_.pop_back();
      return taken;
    }
    if (next_ >= n_runs_) return {};
    const int begin = std::exchange(next_, next_ + group);
    return Group{begin, std::max(begin, first_), std::min(begin + group, n_runs_)};
  }

  void take_groups(bool has_others) {
    while (std::optional<Group> mine = take()) try {
        work_on(*mine);
      } catch (const std::bad_alloc&) {
        const std::lock_guard lock(mutex_);
        if (has_others) {
          left_.push_back(*mine);
          return;
        }
        end_with(std::current_exception());
      } catch (const UserError& error) {
        const std::lock_guard lock(mutex_);
        if (!wrong_input_ || mine->next < wrong_input_->first) wrong_input_ = {mine->next, error.what()};
        end_with({});
      } catch (...) {
        const std::lock_guard lock(mutex_);
        end_with(std::current_exception());
      }
  }

  void work_on(Group& mine) {
    int& k = mine.next;
    if (const auto results = sweep_.run_together(mine.begin, mine.end)) {
      n_together_ += mine.end - mine.begin;
      for (; k < mine.end; ++k) deliver(k, (*results)[k - mine.begin]);
    }
    for (; k < mine.end && !io::interrupt_requested(); ++k) {
      const RunResult result = sweep_.run(k);
      if (result.outcome.end == mechanics::Outcome::interrupted) return;
      deliver(k, result);
    }
  }

  /// Nobody takes a group after it. Called with the lock.
  void end_with(std::exception_ptr error) {
    if (!error_) error_ = std::move(error);
    left_.clear();
    next_ = n_runs_;
  }

  void deliver(int k, const RunResult& result) {
    if (result.outcome.end == mechanics::Outcome::failed) note_failure(k, result.outcome.message);
    rows_.deliver(k, {sweep_.row(k, result), rows_.keeps_samples() ? result.rows : io::Table{}});
  }

  void note_failure(int k, const std::string& message) {
    const std::lock_guard lock(mutex_);
    if (++n_failed_ <= 10)
      context_.log->warn("run {} ({}): {}{}", k + 1, describe_values(scene::values_of_run(parameters_, k)), message,
                         n_failed_ == 10 ? " (further failures are only in the column finished)" : "");
  }

  const SweepRun& sweep_;
  const scene::Sweep& parameters_;
  const RunContext& context_;
  SweepRows& rows_;
  int first_;  ///< run without a row
  int n_runs_;
  std::mutex mutex_;         ///< of what follows
  int next_;                 ///< first run of the next group
  std::vector<Group> left_;  ///< by threads without memory
  std::exception_ptr error_;
  std::optional<std::pair<int, std::string>> wrong_input_;
  int n_failed_ = 0;
  std::atomic<int> n_together_ = 0;
};

int n_threads_of(const scene::Scene& scene) {
  if (scene.sweep_threads) return *scene.sweep_threads;
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace

void check_sweep(const scene::ReadScene& raw) {
  if (raw.scene.sweep.empty()) return;
  for (const int k : corners(raw.scene.sweep)) try {
      scene_of_run(raw, scene::values_of_run(raw.scene.sweep, k));
    } catch (const UserError& error) {
      throw UserError(fmt::format("{} (in {})", error.what(), describe_run(raw.scene.sweep, k)));
    }
  require_used(raw);
  require_own_names(raw);
}

ModelOutcome run_sweep(const scene::ReadScene& raw, RunModel run, RunTogether together, const RunContext& context,
                       bool shows_progress) {
  const auto start = std::chrono::steady_clock::now();
  const int n = scene::n_runs(raw.scene.sweep);
  const SweepRun sweep(raw, run, together, context);
  SweepRows rows(context, sweep.columns(), n, shows_progress);
  Workers workers(sweep, raw.scene.sweep, context, rows);
  const int n_threads = workers.work(std::min(n, n_threads_of(raw.scene)));
  rows.finish();

  ModelOutcome outcome;
  if (const auto& wrong = workers.wrong_input()) {
    outcome.end = mechanics::Outcome::failed;
    outcome.message = fmt::format("{} (in {}); the {} rows before are kept", wrong->second,
                                  describe_run(raw.scene.sweep, wrong->first), rows.n_written());
  } else if (rows.n_written() < n) {
    outcome.end = mechanics::Outcome::interrupted;
    outcome.message = fmt::format("sweep interrupted after {} of {} runs", rows.n_written(), n);
  }
  auto& statistics = outcome.statistics;
  statistics.counters["runs"] = rows.n_written();
  statistics.counters["failed_runs"] = workers.n_failed();
  statistics.counters["runs_in_lanes"] = workers.n_together();
  statistics.counters["threads"] = n_threads;
  statistics.timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  context.log->info("sweep: {} runs, {} of them stopped early, {} eight at a time, {} thread{}, {:.3g} s",
                    rows.n_written(), workers.n_failed(), workers.n_together(), n_threads, n_threads == 1 ? "" : "s",
                    statistics.timers["run"]);
  return outcome;
}

}  // namespace pseudorigid::app
