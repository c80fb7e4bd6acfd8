#include "app/polynomial/degree_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "analysis/space_error.h"
#include "app/run/model_checkpoint.h"
#include "app/search/error_estimate.h"
#include "app/search/silent_run.h"
#include "app/search/time_error.h"
#include "io/checkpoint.h"
#include "io/files.h"
#include "scene/discretization.h"

namespace pseudorigid::app {
namespace {

/// Largest tolerance of the time error, as a fraction of Polynomial/Tolerance.
constexpr double part_for_time = 0.05;

/// Runs the scene, and estimates the time error if it is not known (search/time_error.h).
ModelOutcome run_degree(const RunContext& context, const PolynomialRun& run, PolynomialTask task) {
  DeformationTrace trace;
  if (context.needs.comparison) task.trace = &trace;
  ModelOutcome outcome = run(context, task);
  estimate_time_error(context, task.name, outcome, trace,
                      [&](const RunContext& silent, const Stepping& stepping, DeformationTrace* fine) {
                        return run(silent, {.degree = task.degree, .trace = fine, .stepping = stepping});
                      });
  return outcome;
}

/// The search for the degree, and the run with the chosen degree.
class DegreeSearch {
 public:
  DegreeSearch(const RunContext& context, const PolynomialRun& run)
      : context_(context), run_(run), scene_(context.scene), tolerance_(context.scene.polynomial.tolerance) {
    scene_.time.tolerance = std::min(scene_.time.tolerance, part_for_time * tolerance_);
  }

  /// Searches for the degree or loads it, and runs the scene with it. Returns the outcome of this run, or of an
  /// interrupted search.
  ModelOutcome run() {
    if (!load()) {
      ModelOutcome last = search();
      if (last.end != mechanics::Outcome::finished) return last;
      save();
    }
    context_.log->info("polynomial: degree {}{}", degree_, in_words());
    ModelOutcome outcome = run_degree(derived(context_, scene_, context_.needs), run_, {.degree = degree_});
    auto& counters = outcome.statistics.counters;
    counters["estimated_space_error"] = error_;
    counters["relative_space_error"] = error_ * relative_to_largest_;
    counters["search_runs"] = static_cast<double>(n_runs_);
    counters["search_work"] = work_;
    outcome.other = other_resolution(before_, degree_, degree_ - 2, analysis::least_polynomial_rate, context_);
    return outcome;
  }

 private:
  /// Runs the degrees 1, 3, 5, … and sets `degree_` to the last one. From the third degree on, the search ends if the
  /// error is at most the tolerance, if the run fails, or at the largest degree. The returned outcome is `finished` or
  /// `interrupted`.
  ModelOutcome search() {
    analysis::SpaceErrorLadder errors(analysis::least_polynomial_rate);
    ModelOutcome outcome;
    for (degree_ = 1;; degree_ += 2) {
      DeformationTrace trace;
      outcome = run_silently(run_, context_, scene_, PolynomialTask{.degree = degree_, .trace = &trace});
      if (outcome.end == mechanics::Outcome::interrupted) {
        outcome.message = "polynomial interrupted while looking for the degree";
        return outcome;
      }
      work_ += work(outcome);
      ++n_runs_;
      const TraceDifference apart = difference(trace, before_);
      errors.add(degree_, apart.largest);
      if (apart.largest > 0) relative_to_largest_ = apart.relative / apart.largest;
      if (errors.n_runs() > 1) {
        error_ = errors.error();
        context_.log->info("polynomial: degree {}: Q differs by {:.1e} from the degree before, estimated error {:.1e}",
                           degree_, apart.largest, error_);
      }
      const bool is_last = degree_ + 2 > scene::largest_polynomial_degree;
      if (is_last || (errors.n_runs() > 2 && error_ <= tolerance_)) break;
      // A run of low degree can fail although the exact motion does not end. If the third or a later run fails, the
      // motion itself probably ends at this time, and a higher degree does not help.
      if (outcome.end == mechanics::Outcome::failed && errors.n_runs() > 2) break;
      before_ = std::move(trace);
    }
    outcome.end = mechanics::Outcome::finished;
    if (error_ > tolerance_)
      context_.log->warn(
          "polynomial: degree {} is the highest that was tried; its estimated error of Q is {:.1e}, the tolerance "
          "{:.1e}",
          degree_, error_, tolerance_);
    return outcome;
  }

  /// Text about the chosen degree for the log: "found before", or the estimated error and the tolerance.
  std::string in_words() const {
    return n_runs_ == 0 ? std::string(", found before")
                        : fmt::format(" taken, estimated error of Q {:.1e} (tolerance {:.1e})", error_, tolerance_);
  }

  std::filesystem::path path() const { return context_.directory.checkpoint(degree_checkpoint_name); }
  /// False for a run of a sweep, which does not write checkpoints.
  bool keeps_states() const { return context_.scene.sweep.empty(); }
  /// Writes the checkpoint: the entries of the scene, the chosen degree, its estimated error with the factor for the
  /// relative error, the work of the search, and the history of Q for the previous degree. Does nothing in a run of a
  /// sweep.
  void save() const {
    if (!keeps_states()) return;
    io::Checkpoint c;
    c.set("scene", run_identity(context_.scene).frozen_scene);
    c.set("degree", degree_);
    c.set("numbers", std::array{error_, relative_to_largest_, work_});
    c.set("trace before", numbers_of(before_));
    c.save(path());
  }
  /// Reads the checkpoint of an earlier search. Returns false if the search must run: in a run that is not resumed, in
  /// a sweep, or without a checkpoint.
  bool load() {
    if (!context_.resumes || !keeps_states() || !io::is_there(path())) return false;
    const io::Checkpoint c = io::Checkpoint::load(path());
    degree_ = static_cast<int>(c.get_integer("degree"));
    const auto& numbers = c.get_doubles("numbers", 3);
    error_ = numbers[0];
    relative_to_largest_ = numbers[1];
    work_ = numbers[2];
    before_ = trace_of(c.get_doubles("trace before"));
    return true;
  }

  const RunContext& context_;
  const PolynomialRun& run_;
  scene::Scene scene_;
  double tolerance_;
  int degree_ = 1;
  std::size_t n_runs_ = 0;  ///< number of runs of this search; 0 if the degree was loaded
  /// The estimated error of Q, the factor that converts it to a relative error, and the cost of all runs of the search.
  double error_ = 0, relative_to_largest_ = 0, work_ = 0;
  DeformationTrace before_;  ///< history of Q in the run of degree `degree_` − 2
};

/// Runs the polynomial body of degree N, the only or the last degree that the scene lists. If the scene does not have
/// finite elements, this body is the reference of comparisons. If the scene then also requests error estimates
/// (`needs.companion`), a companion run of another degree estimates the discretisation error of this body.
ModelOutcome run_richest_degree(const RunContext& context, const PolynomialRun& run, int N) {
  const scene::Needs& needs = context.needs;
  if (!needs.companion || needs.models.back()->discretized) return run_degree(context, run, {.degree = N});
  const int other = scene::companion_degree(N);
  ModelOutcome outcome = run_with_companion(
      context,
      {"polynomial", double(N), double(other), fmt::format("degree {}", other), analysis::least_polynomial_rate,
       analysis::least_polynomial_rate},
      [&](const RunContext& of_run, bool is_companion, const std::optional<Stepping>& stepping,
          DeformationTrace* trace) {
        return run(of_run, {.degree = is_companion ? other : N, .trace = trace, .stepping = stepping});
      });
  if (outcome.other) outcome.statistics.counters["companion_degree"] = other;
  return outcome;
}

}  // namespace

ModelOutcome run_listed_degrees(const RunContext& context, const PolynomialRun& run) {
  const std::vector<int>& degrees = context.scene.polynomial.degrees;
  std::map<std::string, io::Manifest::Model> of_rungs;
  for (const int N : degrees) {
    const bool is_last = N == degrees.back();
    const std::string name = is_last ? "polynomial" : fmt::format("polynomial-{}", N);
    ModelOutcome outcome =
        is_last ? run_richest_degree(context, run, N) : run_degree(context, run, {.degree = N, .name = name});
    if (!is_last && outcome.end != mechanics::Outcome::interrupted) {
      if (outcome.end == mechanics::Outcome::failed) context.log->warn("{}", outcome.message);
      of_rungs[name] = outcome.statistics;
      continue;
    }
    outcome.of_rungs = std::move(of_rungs);
    return outcome;
  }
  return {};
}

ModelOutcome run_degree_search(const RunContext& context, const PolynomialRun& run) {
  return DegreeSearch(context, run).run();
}

}  // namespace pseudorigid::app
