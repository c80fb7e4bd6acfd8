#include "app/commands/sweep.h"

#include <fmt/format.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "app/commands/compared_runs.h"
#include "app/commands/row_processes.h"
#include "app/commands/sweep_rows.h"
#include "app/commands/sweep_run.h"
#include "app/commands/table_runs.h"
#include "app/run/run_models.h"
#include "app/search/effort.h"
#include "io/available_memory.h"
#include "io/signals.h"
#include "scene/expressions.h"
#include "scene/needs.h"
#include "scene/scale_numbers.h"
#include "scene/scales.h"
#include "scene/user_error.h"
#include "scene/validate.h"

namespace pseudorigid::app {
namespace {

/// Text for messages: the number of run k, counted from 1, and its parameters.
std::string describe_run(const scene::Sweep& sweep, int k) {
  return fmt::format("run {} of the sweep, {}", k + 1, describe_values(scene::values_of_run(sweep, k)));
}

/// Throws UserError with the sentence, and with the place of Sweep/Parameters in the scene file.
[[noreturn]] void refuse_parameter(const scene::ReadScene& raw, const std::string& sentence) {
  constexpr const char* entry = "Sweep/Parameters";
  throw UserError(fmt::format("{}: {}: {}", raw.origins.of(entry), entry, sentence));
}

/// The names of the columns of sweep.csv for a scene. `conserved` has the names of the model's columns that the motion
/// conserves. Only sweeps with one model use `conserved`.
std::vector<std::string> columns_of(const scene::Scene& scene, const scene::Needs& needs,
                                    const std::set<std::string>& conserved) {
  return sweeps_tables(scene) ? columns_of_table_runs(scene, needs)
         : needs.comparison   ? columns_of_compared_runs(scene, needs)
                              : columns_of_sweep(scene, needs, conserved);
}

/// Throws UserError if run k has other columns of sweep.csv than the first run, for example because a parameter is the
/// number of modes.
void require_same_columns(const scene::ReadScene& raw, int k) {
  const auto columns = [&](int run) {
    const scene::Scene scene = scene_of_run(raw, scene::values_of_run(raw.scene.sweep, run));
    return columns_of(scene, scene::needs(scene), {});
  };
  if (columns(k) != columns(0))
    refuse_parameter(raw, fmt::format("expected runs with the same columns of sweep.csv, got other columns in {}",
                                      describe_run(raw.scene.sweep, k)));
}

/// Throws UserError if a parameter has the name of another column of sweep.csv. Each parameter is itself a column of
/// this file.
void require_own_names(const scene::ReadScene& raw) {
  scene::Scene scene = scene_of_run(raw, scene::values_of_run(raw.scene.sweep, 0));
  const scene::Sweep parameters = std::exchange(scene.sweep, {});
  const scene::Needs needs = scene::needs(scene);
  std::vector<std::string> taken = columns_of_frequencies();
  for (const auto& conserved :
       {std::set<std::string>{}, needs.system ? std::set<std::string>{} : names_conserved(true, true)})
    std::ranges::copy(columns_of(scene, needs, conserved), std::back_inserter(taken));
  for (const auto& parameter : parameters)
    if (std::ranges::find(taken, parameter.name) != taken.end())
      refuse_parameter(
          raw, fmt::format("expected other names than those of the columns of sweep.csv, got \"{}\"", parameter.name));
}

/// Throws UserError if no expression uses one of the parameters. Runs that differ only in this parameter would be
/// equal.
void require_used(const scene::ReadScene& raw) {
  std::set<std::string> used;
  for (const auto& [path, text] : raw.scene.expressions) used.merge(scene::names_used(text, raw.scene.sweep));
  for (const auto& parameter : raw.scene.sweep)
    if (!used.contains(parameter.name))
      refuse_parameter(raw, fmt::format("expected parameters that an entry uses, as in $({}), got \"{}\", which none "
                                        "does",
                                        parameter.name, parameter.name));
}

/// Computes the runs that do not have a row yet. Each of several threads computes one group of runs after the other.
/// Groups and rows do not depend on the number of threads or on an interruption. If a thread exhausts the memory, it
/// returns its group and ends, so that another thread can compute the group. If all threads have ended, the calling
/// thread continues alone.
class Workers {
 public:
  /// `end` is the number of the last run plus 1.
  Workers(const SweepTask& task, const scene::Sweep& parameters, int end, const RunContext& context, SweepRows& rows)
      : task_(task),
        parameters_(parameters),
        context_(context),
        rows_(rows),
        group_(task.group_size()),
        first_(rows.next_run()),
        end_(end),
        next_(first_ / group_ * group_) {}

  /// Computes the runs with at most `n_threads` threads. Returns the number of threads, including the calling thread.
  /// This number is smaller than `n_threads` if a thread cannot be started. After the end of all threads, rethrows the
  /// first exception of a run. Only a UserError is not rethrown, but recorded in `wrong_input`.
  int work(int n_threads) {
    left_.reserve(static_cast<std::size_t>(n_threads));  // allocated now, because memory may be exhausted later
    std::vector<std::jthread> threads;
    try {
      while (static_cast<int>(threads.size()) + 1 < n_threads) threads.emplace_back([this] { take_groups(true); });
    } catch (const std::exception& refusal) {  // a thread could not be started, or memory is exhausted
      context_.log->warn("sweep: {} threads in place of {}: {}", threads.size() + 1, n_threads, refusal.what());
    }
    take_groups(true);
    for (std::jthread& thread : threads) thread.join();
    take_groups(false);
    if (error_) std::rethrow_exception(error_);
    return static_cast<int>(threads.size()) + 1;
  }

  /// Number of runs with the outcome `failed`. Runs that an earlier part of a resumed sweep has written do not count.
  int n_failed() const { return n_failed_; }
  /// Number of runs that were computed together in SIMD lanes.
  int n_together() const { return n_together_; }
  /// The number, from 0, of the first run with wrong input, and its message; empty if there is no such run.
  const std::optional<std::pair<int, std::string>>& wrong_input() const { return wrong_input_; }

 private:
  /// Consecutive runs with the numbers `begin` to `end` − 1. The runs from `next` on do not have a row yet.
  struct Group {
    int begin, next, end;
  };

  /// The next group: a group that another thread has returned, or a new group. Empty after an interrupt, or if there
  /// are no further groups.
  std::optional<Group> take() {
    const std::lock_guard lock(mutex_);
    if (io::interrupt_requested()) return {};
    if (!left_.empty()) {
      const Group taken = left_.back();
      left_.pop_back();
      return taken;
    }
    if (next_ >= end_) return {};
    const int begin = std::exchange(next_, next_ + group_);
    return Group{begin, std::max(begin, first_), std::min(begin + group_, end_)};
  }

  /// Computes groups until there are no further groups. If memory is exhausted and `has_others` is true, returns the
  /// group for another thread and ends. Any other exception ends the sweep and is recorded. For a UserError, the number
  /// of the run is also recorded. If several runs throw a UserError, the record is that of the run with the least
  /// number.
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

  /// Computes the runs of a group that do not have a row yet, and delivers their rows. After an interrupt or an
  /// exception, mine.next is the first run without a row.
  void work_on(Group& mine) {
    int& k = mine.next;
    if (auto together = task_.run_together(mine.begin, mine.end)) {
      n_together_ += mine.end - k;
      for (; k < mine.end; ++k) deliver(k, std::move((*together)[k - mine.begin]));
    }
    for (; k < mine.end && !io::interrupt_requested(); ++k) {
      FinishedRun run = task_.run(k);
      if (run.end == mechanics::Outcome::interrupted) return;
      deliver(k, std::move(run));
    }
  }

  /// Ends the sweep, so that no thread takes another group. `error` may be null. The caller must hold the mutex.
  void end_with(std::exception_ptr error) {
    if (!error_) error_ = std::move(error);
    left_.clear();
    next_ = end_;
  }

  void deliver(int k, FinishedRun run) {
    if (run.end == mechanics::Outcome::failed) note_failure(k, run.message);
    rows_.deliver(k, std::move(run));
  }

  /// Counts a failed run. Logs the message of each of the first ten failed runs.
  void note_failure(int k, const std::string& message) {
    const std::lock_guard lock(mutex_);
    if (++n_failed_ <= 10)
      context_.log->warn("run {} ({}): {}{}", k + 1, describe_values(scene::values_of_run(parameters_, k)), message,
                         n_failed_ == 10 ? " (further failures are only in the column finished)" : "");
  }

  const SweepTask& task_;
  const scene::Sweep& parameters_;
  const RunContext& context_;
  SweepRows& rows_;
  int group_;                 ///< runs of a group
  int first_;                 ///< first run that did not have a row when the sweep started
  int end_;                   ///< number of the last run plus 1
  std::mutex mutex_;          ///< protects the members below; n_together_ is atomic
  int next_;                  ///< first run of the next group; at least end_ after the last group
  std::vector<Group> left_;   ///< groups that threads have returned because memory was exhausted
  std::exception_ptr error_;  ///< first exception other than a UserError
  std::optional<std::pair<int, std::string>> wrong_input_;  ///< number and message of the first run with wrong input
  int n_failed_ = 0;
  std::atomic<int> n_together_ = 0;
};

/// The number of threads: Sweep/Threads if it is set, otherwise the number of cores. The result is at most n_runs. It
/// is at least 1, because a part of the sweep (Sweep/Part) may have no runs.
int n_threads_of(const scene::Scene& scene, int n_runs) {
  const auto n_cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return std::clamp(scene.sweep_threads.value_or(n_cores), 1, std::max(1, n_runs));
}

/// The number of threads for which the address space suffices: at most n_threads, and at least 1. Memory must not be
/// exhausted, because a failed resize in Eigen leaves a pointer that is freed twice.
int n_threads_with_addresses(int n_threads) {
  std::size_t stack = 0;
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) == 0) {  // default attributes of new threads; the stack follows ulimit -s
    ::pthread_attr_getstacksize(&attributes, &stack);
    ::pthread_attr_destroy(&attributes);
  }
  constexpr double heap = 2 * 64 * 0x1p20;  // glibc maps twice the 64 MiB of a thread's heap to align it
  return static_cast<int>(std::clamp(io::available_addresses() / (double(stack) + heap), 1., double(n_threads)));
}

/// The number of child processes for which the memory suffices, if every run has the discretisation of the first run.
/// The number is at least 1 and at most n_threads. If the scene has a mesh file or its discretisation is not known, the
/// number is n_threads.
int n_processes_of(const scene::Scene& scene, int n_threads) {
  const auto discretization = scene::fixed_discretization(scene);
  if (!discretization || scene::has_mesh_file(scene)) return n_threads;
  const double room = io::available_memory() / effort_of(scene, *discretization, 0).bytes;
  return std::clamp(static_cast<int>(std::min(room, 1e6)), 1, n_threads);
}

/// The task of the scene: tables of models (modes, Love numbers or equilibria), compared models, a system, or a single
/// model of the ball.
std::unique_ptr<SweepTask> task_of(const scene::ReadScene& raw, const RunContext& context,
                                   const Executable& executable) {
  const scene::Needs& needs = context.needs;
  if (sweeps_tables(raw.scene)) return std::make_unique<TableRuns>(raw, executable, context);
  if (needs.comparison) return std::make_unique<ComparedRuns>(raw, executable, context);
  if (needs.system) return std::make_unique<SweepRun>(raw, run_system, nullptr, context);
  const BallModel& model = executable.model(*needs.models.front());
  return std::make_unique<SweepRun>(raw, model.run, model.together, context);
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
  for (const int k : corners(raw.scene.sweep)) require_same_columns(raw, k);
  require_own_names(raw);
}

std::optional<std::pair<double, double>> gammas_of_sweep(const scene::ReadScene& raw) {
  const scene::Sweep& sweep = raw.scene.sweep;
  const auto varies = [&](const char* entry) { return raw.scene.expressions.contains(entry); };
  const bool has_gravity = raw.scene.gamma > 0 || loads::present(raw.scene.loads.get<loads::SelfGravity>()) ||
                           varies("Gravity/Gamma") || varies("Gravity/Constant");
  if (sweep.empty() || raw.scene.system != scene::ball || !has_gravity) return {};
  std::set<int> runs = corners(sweep);
  constexpr int most = 1000;
  const int n = scene::n_runs(sweep), stride = (n + most - 1) / most;
  for (int k = 0; k < n; k += stride) runs.insert(k);
  std::pair gammas(std::numeric_limits<double>::infinity(), 0.0);
  for (const int k : runs) try {
      const double gamma = scene::gamma_of(
          scene::validate(scene::with_parameters(raw.scene, scene::values_of_run(sweep, k), raw.origins), raw.origins));
      gammas = {std::min(gammas.first, gamma), std::max(gammas.second, gamma)};
    } catch (const UserError&) {  // the run is refused when it begins
    }
  return gammas;
}

ModelOutcome run_sweep(const scene::ReadScene& raw, const RunContext& context, const Executable& executable) {
  const auto start = std::chrono::steady_clock::now();
  const auto [first, end] = scene::runs_of_part(raw.scene.sweep_part, scene::n_runs(raw.scene.sweep));
  const int n = end - first;
  std::unique_ptr<SweepTask> task = task_of(raw, context, executable);
  std::unique_ptr<SweepTask> in_processes;
  int n_threads = n_threads_of(raw.scene, n);
  if (context.needs.discretized) {
    n_threads = n_processes_of(context.scene, n_threads);
    in_processes = std::make_unique<TaskInProcesses>(*task, n_threads);
  } else if (const int n_wanted = std::exchange(n_threads, n_threads_with_addresses(n_threads)); n_threads < n_wanted) {
    context.log->warn("sweep: {} thread{} in place of {}, because the address space is limited (ulimit -v)", n_threads,
                      n_threads == 1 ? "" : "s", n_wanted);
  }
  SweepRows rows(context, task->columns(), first, n);
  Workers workers(in_processes ? *in_processes : *task, raw.scene.sweep, end, context, rows);
  n_threads = workers.work(n_threads);
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
