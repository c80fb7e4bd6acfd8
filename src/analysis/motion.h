#pragma once
/// Summary of the run of one model: the frequency, the deformation and the drifts of the conserved quantities. Q is the
/// deformation gradient of the pseudo-rigid body. For other bodies, Q is the matrix of the affine motion that is
/// nearest to the motion of the body. C = QᵀQ, and |·| is the Frobenius norm.

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/error_bar.h"
#include "analysis/frequency.h"
#include "io/csv.h"

namespace pseudorigid::analysis {

/// One run of a model: the name of its files, the adjective of its ball (for example "elastic"), the samples and their
/// errors. If a step fails, the program repeats the interval between two samples with shorter steps.
/// `n_failed_intervals` is the number of these repetitions.
struct ModelRunTable {
  std::string name, adjective;
  const io::Table& table;
  RunErrors errors{};
  long n_failed_intervals = 0;
};

/// Summary of the motion of one model. A drift is the largest distance of a quantity from its initial value, divided by
/// a reference value (energy_reference, momentum_reference). A drift is empty if the table lacks its columns.
struct ModelSummary {
  std::string name, adjective;
  FrequencyFit frequency;
  ErrorBar frequency_error;  ///< error of the dominant line (frequency_error.h)
  /// Angular frequency of the load that causes the dominant line; empty if there is no such load.
  std::optional<double> load{};
  double departure = 0;         ///< max_t |Q − Q(0)|, the largest distance of Q from its initial value
  double strain_amplitude = 0;  ///< √2 rms_t |C − C̄|, with the mean C̄ over time
  bool turns = false;           ///< true if Q changes: departure > resolution · |Q(0)| (constructor of Deformation)
  bool deforms = false;         ///< true if C changes: strain_amplitude > resolution · max_t |C|
  std::optional<double> energy_drift, angular_momentum_drift, circulation_drift;
  double energy_bound = 0;  ///< largest permitted change of the energy, divided by its reference value
  std::optional<double> energy_beyond_since{};  ///< first time of a change above `energy_bound`; empty if there is none
  long n_failed_intervals = 0;                  ///< ModelRunTable::n_failed_intervals
};

/// Q and C = QᵀQ of one model at each sample, and the mean of C.
struct Deformation {
  std::vector<Eigen::Matrix3d> Q, C;
  Eigen::Matrix3d C_mean = Eigen::Matrix3d::Zero();

  /// Reads Q from the table, which must have the columns of Q. Sets `departure`, `strain_amplitude`, `turns` and
  /// `deforms` of the summary. Relative variations of Q or C below `resolution` do not count as a motion.
  Deformation(const io::Table& table, double resolution, ModelSummary& summary);

  /// The values of C(i, j) at the samples.
  std::vector<double> component(int i, int j) const;
  /// The indices (i, j), i ≤ j, of the component of C with the largest variance. If several variances are equal up to
  /// round-off, the result is the first of these components in the order of rows.
  std::pair<int, int> liveliest_component() const;
};

/// Fits frequencies to the samples `signal` of a component of C by fit_frequency. The result has a reason instead of
/// lines if the times are not equally spaced or if `deforms` is false. It also has a reason if the loads rise, because
/// the slow change of the shape is then larger than its oscillation.
FrequencyFit fit_component(const std::vector<double>& signal, const std::vector<double>& time, bool deforms,
                           bool loads_rise = false);

/// Reference value for the energies of one or more models, whose tables must have the columns kinetic and elastic. Let
/// E be the largest magnitude, over all models and times, of three energies: kinetic + elastic, dissipated and orbital.
/// Let P be the largest magnitude of the gravitational and external energies. E is round-off if it is less than 1e-12 P
/// or less than 1e-24 `unit`, with the unit of energy `unit`. The reference value is E. If E is round-off, the
/// reference value is P, or `unit` if P = 0.
double energy_reference(std::initializer_list<const io::Table*> models, double unit);

/// Sets the members energy_drift, energy_bound and energy_beyond_since of the summary. The table must have the columns
/// energy and time. The energies are divided by
/// `reference`. The bound follows from an error τ|Q| of Q, with τ = `tolerance`. Let D = max_t |Q − Q(0)| be the
/// departure, which `summary` must already contain. In an oscillation, D is twice the amplitude, and the error changes
/// the energy by the fraction 4τ|Q|/D. If τ is given and the body moves, the bound is this fraction with |Q| = √3, but
/// at most 1 %. Otherwise the bound is 1 %.
void set_energy_drift(const io::Table& table, double reference, std::optional<double> tolerance, ModelSummary& summary);

/// Returns, for example, "two frequencies share the motion of the elastic ball, omega = 4.93 and, with 0.8 of its
/// amplitude, 6.14". The result is empty if second_line (frequency.h) is empty.
std::string shared_motion_clause(const ModelSummary& summary);

/// Returns, for example, "the energy of the elastic ball changes by up to 4.2 %, and by more than 1 % from t = 3.2 on".
/// The result is empty if the change does not exceed `energy_bound`.
std::string energy_clause(const ModelSummary& summary);

/// Returns, for example, "steps of the elastic ball failed 3 times, and their intervals were repeated with shorter
/// ones". The result is empty if no step failed.
std::string failure_clause(const ModelSummary& summary);

/// A drift up to this value is reported as round-off. The value is about the round-off error of some hundred operations
/// in double precision.
inline constexpr double round_off_drift = 1e-13;
/// The text of a drift, for example "3.2e-07", or "round-off".
std::string drift_in_words(double drift);

/// Drift of an angular momentum or a circulation with these columns, relative to momentum_reference. It is empty if the
/// table lacks a column.
std::optional<double> momentum_drift(const io::Table& table, const std::vector<std::string>& columns);

/// The columns of the angular momentum that is constant if the only loads are self-gravity and companions. The columns
/// are total_J1 to total_J3 for the body and its companions together, or J1 to J3 if the table lacks the column
/// total_J1.
std::vector<std::string> columns_of_angular_momentum(const io::Table& table);

/// Reference value for angular momenta or circulations: the largest norm of `momenta`. If this norm is round-off, the
/// reference is the product m̄|Q||Q̇| at the sample with the largest |Q̇|. Here m̄ follows from the kinetic energy
/// K = ½m̄|Q̇|². At that sample, the norms of the angular momentum and of the circulation are at most √2 times the
/// product. If the table lacks the columns of Q, Q̇ or K, the reference is the largest norm.
double momentum_reference(const io::Table& table, const std::vector<Eigen::Vector3d>& momenta);

/// A body spins if its angular momentum or its circulation exceeds this fraction of m̄|Q||Q̇|. Smaller values are
/// round-off. Here m̄ is the factor in the kinetic energy ½m̄|Q̇|² of an affine motion.
inline constexpr double spin_threshold = 1e-9;

/// The label of a column for the terminal, and the least, greatest and last value of this column in a run.
struct ColumnRange {
  std::string label;
  double least = 0, greatest = 0, last = 0;
};

/// Summary of one run. It does not contain a comparison with another run.
struct MotionSummary {
  ModelSummary model;
  std::size_t n_samples = 0;
  double first_time = 0, last_time = 0;
  bool has_state = false;           ///< true if the table has the columns of Q
  std::string signal;               ///< component of C with the largest variance, for example "C33"
  std::vector<ColumnRange> ranges;  ///< ranges of columns; terminal_table shows the first 12
  /// Σ η_K K / ΣK over the samples, with the non-affine fraction η_K of the kinetic energy K. It is empty if the table
  /// lacks the column of η_K or K.
  std::optional<double> mean_nonaffine_kinetic_fraction;
};

/// Data of the scene that the summary of a run uses.
struct SceneFacts {
  double resolution = 1e-10;  ///< relative accuracy of Q and C; smaller relative variations do not count as a motion
  double energy_unit = 0;     ///< unit of energy of the scene
  double stress_unit = 0;     ///< unit of stress of the scene
  /// The entry Time/Tolerance, from which the program chose the step. It is empty if the scene sets Time/Step.
  std::optional<double> tolerance{};
  std::vector<double> load_frequencies{};  ///< nonzero angular frequencies of the periodic loads, of either sign
  bool loads_rise = false;                 ///< true if Loads/Rise time is positive
  bool is_free = false;                    ///< true if no load acts, so that J and Z are constants of the motion
  bool incompressible = false;             ///< true if the exact volume is constant
};

/// Summary of the run of a model of the ball. The summary omits quantities whose columns the table lacks. The table
/// must have at least one sample.
MotionSummary summarize_motion(const ModelRunTable& run, const SceneFacts& facts);

/// Summary of the run of a system other than the ball: the range of each column except the time, and the drift of the
/// energy. The reference value of the drift is the largest kinetic energy or the range of the potential energy,
/// whichever is larger. If both are round-off of the potential energy, the reference value is the largest magnitude of
/// the potential energy. The drift is empty if the reference value is 0, or if there is no column energy. The table
/// must have at least one sample.
MotionSummary summarize_system(const ModelRunTable& run);

/// Text for the terminal: one quantity per line, with at most 12 ranges of columns.
std::string terminal_table(const MotionSummary& summary);

}  // namespace pseudorigid::analysis
