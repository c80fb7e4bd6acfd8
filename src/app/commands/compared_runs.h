#pragma once
/// The runs of a sweep with several models. Each run computes all models and compares each model with the last one. A
/// polynomial model with several degrees counts as several models here. Let m be the name of a model's files, with "_"
/// in place of "-". The columns of sweep.csv are then
///
///   run, the parameters, compared (1 if all models have at least two common samples, otherwise 0);
///   for every m  m_finished (1 if all samples exist, otherwise 0), m_time (of the last sample), m_steps, m_forces
///                (evaluations of the force), m_time_error, m_space_error, m_frequency (angular frequency of the
///                dominant line), m_frequency_error, m_second_line (amplitude of the second line over that of
///                the dominant line), m_amplitude (of C = QᵀQ, with the affine part Q of the motion), m_energy_drift,
///                with the values of comparison.json;
///   for every m but the last
///                m_frequency_ratio, m_frequency_ratio_error, m_tenth_of_period_after, m_phase_after_1_period,
///                m_phase_after_10_periods, m_phase_difference_max, m_phase_difference_error, and m_c_max, m_c_rms (over
///                the samples), m_c_error (bar of both) for every other column c of comparison.csv that compares m with
///                the last model, and with the stresses m_s_ratio and m_s_ratio_error for each von Mises stress s (its
///                root mean square over that of the last model, and the bar);
///   for the last model  nonaffine_kinetic_fraction (mean non-affine fraction of the kinetic energy, weighted by
///                the kinetic energy), nonaffine_displacement (largest), each with its bar in a column with the suffix
///                _error, min_jacobian (least det F, with the deformation gradient F), volume_error (largest root mean
///                square of ln det F in the body), and surface_limit_time (first time at which the surface reaches
///                Biot's limit).
///
/// A quantity that does not exist is 0. An error, a drift, a phase or a time that is not known is −1. However, if
/// compared is 0, all columns from the first m_frequency_ratio on are 0. The column m_tenth_of_period_after is the time
/// t = 0.2 π/|ω − ω'|, with the angular frequencies ω of m and ω' of the last model. After this time, their phases
/// differ by a tenth of a period. The three phase columns are absolute values of phase_difference (comparison.h), in
/// periods. They are its values after 1 and after 10 periods of the last model, and its largest value.

#include <string>
#include <vector>

#include "app/commands/model_runs.h"

namespace pseudorigid::app {

/// The names of the columns of sweep.csv for several models, in the order above.
std::vector<std::string> columns_of_compared_runs(const scene::Scene& scene, const scene::Needs& needs);

/// The runs of a sweep as tasks, each of which runs all models and compares them.
class ComparedRuns : public ModelRuns {
 public:
  using ModelRuns::ModelRuns;

 private:
  std::vector<std::string> columns_of(const scene::Scene& scene, const scene::Needs& needs) const override {
    return columns_of_compared_runs(scene, needs);
  }
  void compute(const RunContext& context, Tables& tables, FinishedRun& run) const override;
};

}  // namespace pseudorigid::app
