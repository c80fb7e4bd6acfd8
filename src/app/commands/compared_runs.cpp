#include "app/commands/compared_runs.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>

#include "app/commands/compare_models.h"

namespace pseudorigid::app {
namespace {

using analysis::Comparison, analysis::ModelSummary;

/// `none` is the value of a quantity that does not exist. `unknown` is the value of an error, a drift, a phase or a
/// time that is not known.
constexpr double none = 0, unknown = -1;

/// A column of comparison.csv that compares two models. The column exists if the scene requests the quantities of
/// `group`.
struct Difference {
  const char* name;
  bool mechanics::Quantities::*group;
};
constexpr std::array differences{
    Difference{"q_difference", &mechanics::Quantities::state},
    Difference{"q_difference_of_departure", &mechanics::Quantities::state},
    Difference{"strain_difference", &mechanics::Quantities::state},
    Difference{"a1_difference", &mechanics::Quantities::axes},
    Difference{"a2_difference", &mechanics::Quantities::axes},
    Difference{"a3_difference", &mechanics::Quantities::axes},
    Difference{"volume_ratio_difference", &mechanics::Quantities::axes},
    Difference{"kinetic_difference", &mechanics::Quantities::energies},
    Difference{"elastic_difference", &mechanics::Quantities::energies},
    Difference{"energy_difference", &mechanics::Quantities::energies},
    Difference{"dissipated_difference", &mechanics::Quantities::energies},
    Difference{"max_stretch_difference", &mechanics::Quantities::stretches},
    Difference{"min_stretch_difference", &mechanics::Quantities::stretches},
    Difference{"mean_von_mises_difference", &mechanics::Quantities::stresses},
    Difference{"max_von_mises_difference", &mechanics::Quantities::stresses},
    Difference{"center_von_mises_difference", &mechanics::Quantities::stresses},
    Difference{"angular_momentum_difference", &mechanics::Quantities::momenta},
    Difference{"circulation_difference", &mechanics::Quantities::momenta},
    Difference{"multiplier_difference", &mechanics::Quantities::multiplier},
};

/// The columns of a von Mises stress. Each has a ratio and its error if the scene requests the stresses.
constexpr std::array stresses{"mean_von_mises", "max_von_mises", "center_von_mises"};

/// The results of all models for one run of the sweep. `end` is the outcome of the run. `message` is the reason why the
/// run has not finished.
struct Results {
  std::vector<RunOfModel> runs;
  std::vector<bool> finished;  ///< for each element of `runs`: true if it has all samples
  OtherResolutions others;
  mechanics::Outcome end = mechanics::Outcome::finished;
  std::string message;
};

/// The counter of a run with this name, or `otherwise` if the run does not have it.
double counter(const io::Manifest::Model& statistics, const char* name, double otherwise) {
  const auto found = statistics.counters.find(name);
  return found == statistics.counters.end() ? otherwise : found->second;
}

/// A column for a model: the part of its name after "m_" (compared_runs.h), and a function that returns its value.
/// `summary` is null if the runs are not compared.
struct ColumnOfRun {
  const char* name;
  double (*value)(const RunOfModel& run, const ModelSummary* summary);
};
constexpr std::array columns_of_model{
    ColumnOfRun{"time",
                [](const RunOfModel& r, const ModelSummary*) {
                  return r.table.n_rows() > 0 ? r.table.row(r.table.n_rows() - 1)[0] : none;
                }},
    ColumnOfRun{"steps", [](const RunOfModel& r, const ModelSummary*) { return counter(r.statistics, "steps", none); }},
    ColumnOfRun{"forces",
                [](const RunOfModel& r, const ModelSummary*) { return counter(r.statistics, "forces", none); }},
    ColumnOfRun{"time_error",
                [](const RunOfModel& r, const ModelSummary*) {
                  return counter(r.statistics, "estimated_time_error", unknown);
                }},
    ColumnOfRun{"space_error",
                [](const RunOfModel& r, const ModelSummary*) {
                  return r.model->has_nonaffine ? counter(r.statistics, "relative_space_error", unknown) : 0;
                }},
    ColumnOfRun{"frequency",
                [](const RunOfModel&, const ModelSummary* s) {
                  return s && s->frequency ? s->frequency.dominant().frequency : none;
                }},
    ColumnOfRun{"frequency_error",
                [](const RunOfModel&, const ModelSummary* s) {
                  return s && s->frequency ? s->frequency_error.total().value_or(unknown) : unknown;
                }},
    ColumnOfRun{"second_line",
                [](const RunOfModel&, const ModelSummary* s) {
                  const auto second = s ? analysis::second_line(s->frequency) : std::nullopt;
                  return second ? second->amplitude / s->frequency.dominant().amplitude : none;
                }},
    ColumnOfRun{"amplitude", [](const RunOfModel&, const ModelSummary* s) { return s ? s->strain_amplitude : none; }},
    ColumnOfRun{"energy_drift", [](const RunOfModel&,
                                   const ModelSummary* s) { return s ? s->energy_drift.value_or(unknown) : unknown; }},
};

/// Time after which the phases of the two motions differ by a tenth of a period, in the user's units. The result is −1
/// if the comparison has no ratio of the frequencies, or if both frequencies are equal.
double tenth_of_period_after(const Comparison& c) {
  if (!c.ratio) return unknown;
  const double apart = std::abs(c.model.frequency.dominant().frequency - c.reference.frequency.dominant().frequency);
  return apart > 0 ? 0.2 * std::numbers::pi / apart : unknown;
}

/// |phase_difference| in periods after n periods of the reference, which is the last model. The result is −1 if the
/// phase is not known, for example because the run is shorter.
template <int n>
double phase_after(const Comparison& c) {
  const auto found = c.phase_after_periods.find(n);
  return found == c.phase_after_periods.end() ? unknown : std::abs(found->second);
}

/// The bound of the error of a difference; −1 if it is not known.
double error_of(const analysis::Series* series) { return series ? series->error.total().value_or(unknown) : unknown; }

/// A column for a comparison: its name, and a function that returns its value. In columns_of_pair, the name is the part
/// after "m_" (compared_runs.h).
struct ColumnOfPair {
  const char* name;
  double (*value)(const Comparison&);
};
constexpr std::array columns_of_pair{
    ColumnOfPair{"frequency_ratio", [](const Comparison& c) { return c.ratio ? c.ratio->value : none; }},
    ColumnOfPair{"frequency_ratio_error",
                 [](const Comparison& c) { return c.ratio ? c.ratio->error.total().value_or(unknown) : unknown; }},
    ColumnOfPair{"tenth_of_period_after", &tenth_of_period_after},
    ColumnOfPair{"phase_after_1_period", &phase_after<1>},
    ColumnOfPair{"phase_after_10_periods", &phase_after<10>},
    ColumnOfPair{"phase_difference_max",
                 [](const Comparison& c) {
                   const auto* series = c.find("phase_difference");
                   return series ? series->max : unknown;
                 }},
    ColumnOfPair{"phase_difference_error", [](const Comparison& c) { return error_of(c.find("phase_difference")); }},
};

/// The columns of the last model, the reference of all comparisons.
constexpr std::array columns_of_reference{
    ColumnOfPair{"nonaffine_kinetic_fraction",
                 [](const Comparison& c) { return c.mean_nonaffine_kinetic_fraction.value_or(none); }},
    ColumnOfPair{"nonaffine_kinetic_fraction_error",
                 [](const Comparison& c) {
                   return c.mean_nonaffine_kinetic_fraction ? c.mean_nonaffine_error.total().value_or(unknown)
                                                            : unknown;
                 }},
    ColumnOfPair{"nonaffine_displacement",
                 [](const Comparison& c) {
                   const auto* series = c.find("nonaffine_displacement");
                   return series ? series->max : none;
                 }},
    ColumnOfPair{"nonaffine_displacement_error",
                 [](const Comparison& c) { return error_of(c.find("nonaffine_displacement")); }},
    ColumnOfPair{"min_jacobian", [](const Comparison& c) { return c.min_jacobian.value_or(none); }},
    ColumnOfPair{"volume_error", [](const Comparison& c) { return c.volume_error.value_or(none); }},
    ColumnOfPair{"surface_limit_time", [](const Comparison& c) { return c.surface_limit_time.value_or(unknown); }},
};

std::vector<scene::ModelRun> runs_of_models(const scene::Scene& scene, const scene::Needs& needs) {
  std::vector<scene::ModelRun> runs;
  for (const scene::ModelDescription* model : needs.models) {
    const auto of_model = scene::runs_of(*model, scene);
    runs.insert(runs.end(), of_model.begin(), of_model.end());
  }
  return runs;
}

/// Runs the models one after the other. If a model stops early, its samples are used, and the other models still run.
/// After an interrupt, no further model runs, and the results are incomplete.
Results run_models(const RunContext& context, const Executable& executable, std::map<std::string, io::Table>& tables) {
  Results results;
  const auto n_samples = static_cast<std::size_t>(context.scene.output.samples) + 1;
  for (const scene::ModelDescription* model : context.needs.models) {
    ModelOutcome outcome = executable.model(*model).run(context);
    if (add_outcome(outcome, results.end, results.message)) return results;
    for (const scene::ModelRun& run : scene::runs_of(*model, context.scene)) {
      const auto& statistics = run.name == model->name ? outcome.statistics : outcome.of_rungs[run.name];
      io::Table& table = tables[run.name];
      results.finished.push_back(table.n_rows() == n_samples);
      results.runs.push_back({model, run.name, adjective_of(run, statistics), statistics, std::move(table)});
    }
    if (outcome.other) results.others.emplace(model->name, std::move(*outcome.other));
  }
  return results;
}

/// Appends the values of all columns that follow the parameters to `row`.
void add_results(const RunContext& context, const Results& results, std::vector<double>& row) {
  const std::vector<Comparison> comparisons = comparisons_of(context, results.runs, results.others);
  row.push_back(!comparisons.empty());
  for (std::size_t i = 0; i < results.runs.size(); ++i) {
    const RunOfModel& run = results.runs[i];
    const ModelSummary* summary = comparisons.empty()      ? nullptr
                                  : i < comparisons.size() ? &comparisons[i].model
                                                           : &comparisons.front().reference;
    row.push_back(results.finished[i]);
    for (const ColumnOfRun& column : columns_of_model) row.push_back(column.value(run, summary));
  }
  for (std::size_t i = 0; i + 1 < results.runs.size(); ++i) {
    const Comparison* comparison = comparisons.empty() ? nullptr : &comparisons[i];
    for (const ColumnOfPair& column : columns_of_pair) row.push_back(comparison ? column.value(*comparison) : none);
    for (const Difference& difference : differences) {
      if (!(context.needs.quantities.*difference.group)) continue;
      const auto* series = comparison ? comparison->find(difference.name) : nullptr;
      row.insert(row.end(),
                 {series ? series->max : none, series ? series->rms : none, comparison ? error_of(series) : none});
    }
    if (!context.needs.quantities.stresses) continue;
    for (const char* stress : stresses) {
      const bool is_known = comparison && comparison->stress_ratios.contains(stress);
      const auto ratio = is_known ? comparison->stress_ratios.at(stress) : analysis::StressRatio{none, {}};
      row.insert(row.end(), {ratio.value, comparison ? ratio.error.total().value_or(unknown) : none});
    }
  }
  for (const ColumnOfPair& column : columns_of_reference)
    row.push_back(comparisons.empty() ? none : column.value(comparisons.back()));
}

}  // namespace

std::vector<std::string> columns_of_compared_runs(const scene::Scene& scene, const scene::Needs& needs) {
  std::vector<std::string> names = first_columns(scene);
  names.emplace_back("compared");
  const auto runs = runs_of_models(scene, needs);
  for (const scene::ModelRun& run : runs) {
    names.push_back(column_prefix(run.name) + "finished");
    for (const ColumnOfRun& column : columns_of_model) names.push_back(column_prefix(run.name) + column.name);
  }
  for (std::size_t i = 0; i + 1 < runs.size(); ++i) {
    for (const ColumnOfPair& column : columns_of_pair) names.push_back(column_prefix(runs[i].name) + column.name);
    for (const Difference& difference : differences)
      if (needs.quantities.*difference.group)
        for (const char* what : {"_max", "_rms", "_error"})
          names.push_back(column_prefix(runs[i].name) + difference.name + what);
    if (needs.quantities.stresses)
      for (const std::string stress : stresses)
        for (const char* what : {"_ratio", "_ratio_error"})
          names.push_back(column_prefix(runs[i].name) + stress + what);
  }
  for (const ColumnOfPair& column : columns_of_reference) names.emplace_back(column.name);
  return names;
}

void ComparedRuns::compute(const RunContext& context, Tables& tables, FinishedRun& run) const {
  const Results results = run_models(context, executable_, tables);
  run.end = results.end;
  run.message = results.message;
  if (run.end != mechanics::Outcome::interrupted) add_results(context, results, run.row);
}

}  // namespace pseudorigid::app
