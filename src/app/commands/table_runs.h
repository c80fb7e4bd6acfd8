#pragma once
/// The runs of a sweep of modes, Love numbers or equilibria, with one or more models. Let m be the name of a model, or
/// of a run of a model, with "_" in place of "-". The columns of sweep.csv are
///
///   run, the parameters, finished (1 if all models have finished, otherwise 0);
///   modes:         m_omega_i, m_kind_i, m_degree_i, … for every model m and the rows i = 1, 2, … of its table of modes
///                  (app/run/mode_table.h);
///   Love numbers:  m_h_n, m_l_n, m_k_n, … for every run m of a model and the degrees n of the tide
///                  (app/run/love_table.h);
///   equilibria:    m_finished (1 if the figure exists), m_parameter, m_omega3, m_a1, … for every run m of a model.
///                  The columns after m_finished are the columns after "kind" in the model's table of equilibria.
///                  Each run of the sweep computes one figure for every m, and has failed if one of these figures is
///                  missing.
///
/// A value is 0 if the table does not have its row, or if the model has failed.

#include <string>
#include <vector>

#include "app/commands/model_runs.h"

namespace pseudorigid::app {

/// True if the result of the scene's analysis is a table of each model: modes, Love numbers or equilibria of the ball.
bool sweeps_tables(const scene::Scene& scene);

/// The names of the columns of sweep.csv for a scene with `sweeps_tables(scene)`.
std::vector<std::string> columns_of_table_runs(const scene::Scene& scene, const scene::Needs& needs);

/// The runs of a sweep as tasks, each of which computes the tables of all models.
class TableRuns : public ModelRuns {
 public:
  using ModelRuns::ModelRuns;

 private:
  std::vector<std::string> columns_of(const scene::Scene& scene, const scene::Needs& needs) const override {
    return columns_of_table_runs(scene, needs);
  }
  void compute(const RunContext& context, Tables& tables, FinishedRun& run) const override;
};

}  // namespace pseudorigid::app
