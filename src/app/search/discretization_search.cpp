#include "app/search/discretization_search.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <utility>

#include "app/ranks/launch.h"
#include "app/ranks/on_all_ranks.h"
#include "app/run/mesh_file.h"
#include "app/run/model_checkpoint.h"
#include "app/run/resumed_checkpoint.h"
#include "app/search/effort.h"
#include "app/search/error_estimate.h"
#include "app/search/time_error.h"
#include "io/checkpoint.h"

namespace pseudorigid::app {
namespace {

/// Largest tolerance of the time error of Q, as a fraction of Continuum/Tolerance.
constexpr double time_part = 0.05;
/// A run writes its results if its predicted error is at most this factor times the tolerance. The factor is above 1,
/// because predicted errors are usually too large.
constexpr double benefit_of_doubt = 2;

/// The discretisations of the search that fit in the memory of this machine, from the coarsest to the last that fits.
/// The coarsest one is always included, because its memory has been checked before. Collective.
std::vector<scene::Discretization> affordable(const RunContext& context) {
  std::vector<scene::Discretization> ladder = scene::ladder(context.scene);
  const std::size_t n_coarse_cells =
      scene::has_mesh_file(context.scene) ? read_mesh_file(context.scene).mesh.cells.size() : 0;
  const double share = static_cast<double>(Launch().n_ranks_here) / context.ranks->size();
  for (std::size_t i = 1; i < ladder.size(); ++i) {
    const auto problem = exceeds_memory(context.scene, ladder[i], n_coarse_cells, share);
    if (!context.ranks->any(problem.has_value())) continue;
    if (problem) context.log->info("continuum: the search ends before {}", *problem);
    ladder.resize(i);
  }
  return ladder;
}

/// The scene with another Time/Tolerance.
scene::Scene with_time_tolerance(scene::Scene scene, double tolerance) {
  scene.time.tolerance = tolerance;
  return scene;
}

}  // namespace

DiscretizationSearch::DiscretizationSearch(const RunContext& context, ContinuumRun run)
    : context_(context),
      run_(std::move(run)),
      written_scene_(with_time_tolerance(
          context.scene, std::min(context.scene.time.tolerance, time_part * context.scene.continuum.tolerance))),
      silent_scene_(with_time_tolerance(context.scene, time_part * context.scene.continuum.tolerance)),
      ladder_(context.resumes ? scene::ladder(context.scene) : affordable(context)) {
  if (context.resumes) load();
}

ModelOutcome DiscretizationSearch::run() {
  if (!context_.resumes) save();
  while (true) {
    const bool written = writes();
    DeformationTrace trace;
    ModelOutcome outcome = run_rung(trace);
    if (outcome.end == mechanics::Outcome::interrupted) {
      if (!written) outcome.message = "continuum interrupted while looking for the discretisation";
      return outcome;
    }
    if (written && outcome.end == mechanics::Outcome::failed) return outcome;
    if (!settled_ || n_failures_ > 0) note(outcome, trace);
    settled_ = settles();
    if (settled_ && written) {
      save();
      report(outcome);
      if (context_.scene.continuum.error_estimate == scene::ErrorEstimate::automatic)
        estimate_time_error(derived(context_, written_scene_, context_.needs), "continuum", outcome, trace,
                            [this](const RunContext& silent, const Stepping& stepping, DeformationTrace* fine) {
                              return run_(silent, {.discretization = rung(), .stepping = stepping, .trace = fine});
                            });
      return outcome;
    }
    search_work_ += work(outcome);
    if (!settled_) ++position_;
    start_afresh();
  }
}

bool DiscretizationSearch::writes() const {
  return settled_ || is_last() ||
         errors_.predicted_error(scene::resolution(rung())) <= benefit_of_doubt * context_.scene.continuum.tolerance;
}

ModelOutcome DiscretizationSearch::run_rung(DeformationTrace& trace) {
  if (!writes()) return run_silently(run_, context_, silent_scene_, ContinuumTask{rung(), silent_stepping(), &trace});
  context_.log->info("continuum: {}", scene::describe(rung()));
  return run_(derived(context_, written_scene_, context_.needs), {.discretization = rung(), .trace = &trace});
}

std::optional<Stepping> DiscretizationSearch::silent_stepping() const {
  if (!first_stepping_) return std::nullopt;
  Stepping stepping = *first_stepping_;
  if (!context_.scene.time.step) stepping.step *= first_resolution_ / scene::resolution(rung());
  return stepping;
}

/// `trace` is the history of Q in the present run. It is not used if the run has failed.
void DiscretizationSearch::note(const ModelOutcome& outcome, DeformationTrace trace) {
  if (outcome.end == mechanics::Outcome::failed) {
    ++n_failures_;
    context_.log->info("continuum: {}: {}", scene::describe(rung()), outcome.message);
    return;
  }
  n_failures_ = 0;
  const double N = scene::resolution(rung());
  if (!first_stepping_) {
    first_stepping_ = outcome.stepping;
    first_resolution_ = N;
  }
  warn_of_gaps(context_, "continuum", trace);
  const TraceDifference apart = difference(trace, trace_);
  relative_to_largest_ = apart.largest > 0 ? apart.relative / apart.largest : 0;
  errors_.add(N, apart.largest);
  trace_before_ = std::exchange(trace_, std::move(trace));
  if (errors_.n_runs() > 1)
    context_.log->info("continuum: {}: Q differs by {:.1e} from the run before, estimated error {:.1e}",
                       scene::describe(rung()), apart.largest, errors_.error());
}

/// True if the present run is the final one. This is the case if it is marked as final or the last of the ladder, or if
/// its estimated error is at most the tolerance. It is also final if two successive runs have ended early: the motion
/// is then the cause, and a finer mesh does not help.
bool DiscretizationSearch::settles() const {
  return settled_ || is_last() || n_failures_ == 2 ||
         (n_failures_ == 0 && errors_.error() <= context_.scene.continuum.tolerance);
}

/// Removes the checkpoint of a run that is not the final one, so that the next run does not continue from it. Saves the
/// state of the search.
void DiscretizationSearch::start_afresh() const {
  on_all_ranks(*context_.ranks, [this] {
    if (keeps_states()) std::filesystem::remove(context_.directory.checkpoint("continuum"));
  });
  save();
}

void DiscretizationSearch::save() const {
  on_all_ranks(*context_.ranks, [this] {
    if (keeps_states()) write_checkpoint();
  });
}

void DiscretizationSearch::write_checkpoint() const {
  std::vector<double> errors;
  for (std::size_t i = 0; i < errors_.n_runs(); ++i)
    errors.insert(errors.end(), {errors_.resolution_of(i), errors_.difference_of(i)});
  io::Checkpoint c;
  c.set("scene", run_identity(context_.scene).frozen_scene);
  c.set("position", position_);
  c.set("rungs", ladder_.size());
  c.set("settled", static_cast<int>(settled_));
  c.set("failures", n_failures_);
  c.set("errors", std::span<const double>(errors));
  c.set("trace", numbers_of(trace_));
  c.set("trace before", numbers_of(trace_before_));
  c.set("method", std::string(first_stepping_ ? mechanics::method_name(first_stepping_->method) : ""));
  c.set("numbers", std::array{first_stepping_ ? first_stepping_->step : 0.0, first_resolution_, relative_to_largest_,
                              search_work_});
  c.save(context_.directory.checkpoint(checkpoint_name));
}

void DiscretizationSearch::load() {
  const auto content = resumed_checkpoint(context_, checkpoint_name);
  if (content) on_all_ranks(*context_.ranks, [&] { take(*content); });
}

void DiscretizationSearch::take(const io::Checkpoint& c) {
  // The memory that was available at the start of the search has limited the ladder. The ladder of a resumed search has
  // the same length.
  ladder_.resize(std::clamp<std::size_t>(static_cast<std::size_t>(c.get_integer("rungs")), 1, ladder_.size()));
  position_ = std::min(static_cast<std::size_t>(c.get_integer("position")), ladder_.size() - 1);
  settled_ = c.get_integer("settled") != 0;
  n_failures_ = static_cast<int>(c.get_integer("failures"));
  const auto& errors = c.get_doubles("errors");
  for (std::size_t i = 0; i + 1 < errors.size(); i += 2) errors_.add(errors[i], errors[i + 1]);
  trace_ = trace_of(c.get_doubles("trace"));
  trace_before_ = trace_of(c.get_doubles("trace before"));
  const auto& numbers = c.get_doubles("numbers", 4);
  if (const auto method = mechanics::find_method(c.get_string("method"))) first_stepping_ = {*method, numbers[0]};
  first_resolution_ = numbers[1];
  relative_to_largest_ = numbers[2];
  search_work_ = numbers[3];
}

void DiscretizationSearch::report(ModelOutcome& outcome) const {
  if (const std::size_t n = errors_.n_runs(); n > 1)
    outcome.other = other_resolution(trace_before_, errors_.resolution_of(n - 1), errors_.resolution_of(n - 2),
                                     analysis::least_space_rate, context_);
  auto& counters = outcome.statistics.counters;
  counters["degree"] = rung().degree;
  counters["refinements"] = rung().refinements;
  counters["work"] = work(outcome);
  counters["search_runs"] = static_cast<double>(errors_.n_runs() - 1);
  counters["search_work"] = search_work_;
  if (errors_.n_runs() < 2) return;
  const double error = errors_.error(), tolerance = context_.scene.continuum.tolerance;
  counters["estimated_space_error"] = error;
  counters["relative_space_error"] = error * relative_to_largest_;
  if (error > tolerance)
    context_.log->warn(
        "continuum: {} is the finest discretisation offered; its estimated error of Q is {:.1e}, the "
        "tolerance {:.1e}",
        scene::describe(rung()), error, tolerance);
  else
    context_.log->info(
        "continuum: {} taken, estimated error of Q {:.1e} (tolerance {:.1e}); the search took {:.2g} "
        "times the work of the run",
        scene::describe(rung()), error, tolerance, search_work_ / work(outcome));
}

}  // namespace pseudorigid::app
