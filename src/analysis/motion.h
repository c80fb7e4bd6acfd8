#pragma once
/// Summary of the run of one model: the frequency, the deformation and the drifts of the conserved quantities. Q is the
/// deformation of the pseudo-rigid body, or the matrix of the affine motion that is nearest to another motion. C = QᵀQ,
/// and |·| is the Frobenius norm.

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
/// errors. `n_failed_intervals` counts how often an interval between samples was integrated again with shorter steps
/// because a step failed.
struct ModelRunTable {
  std::string name, adjective;
  const io::Table& table;
  RunErrors errors{};
  long n_failed_intervals = 0;
};

/// Summary of the motion of one model. A drift is the largest difference of a quantity from its initial value, relative
/// to a reference value (energy_reference, momentum_reference). A drift is empty if the table lacks its columns.
struct ModelSummary {
  std::string name, adjective;
  FrequencyFit frequency;
  ErrorBar frequency_error;      ///< error of the dominant line (frequency_error.h)
  std::optional<double> load{};  ///< angular frequency of the load that causes the dominant line; empty if no load does
  double departure = 0;          ///< max_t |Q − Q(0)|, the largest distance of Q from its initial value
  double strain_amplitude = 0;   ///< √2 rms_t |C − C̄|, with the mean C̄ over time
  bool turns = false;            ///< true if departure > resolution · |Q(0)|, with the resolution of Deformation
  bool deforms = false;          ///< true if strain_amplitude > resolution · max_t |C|
  std::optional<double> energy_drift, angular_momentum_drift, circulation_drift;
  double energy_bound = 0;  ///< largest change of the energy without a warning, as a fraction of the reference value
  std::optional<double> energy_beyond_since{};  ///< first time of a change beyond this bound; empty if there is none
  long n_failed_intervals = 0;                  ///< as in ModelRunTable
};

/// Q and C = QᵀQ of one model at each sample, and the mean of C.
struct Deformation {
  std::vector<Eigen::Matrix3d> Q, C;
  Eigen::Matrix3d C_mean = Eigen::Matrix3d::Zero();

  /// Reads Q from the table, which must have the columns of Q. Sets the departure, the strain amplitude, `turns` and
  /// `deforms` of the summary. Relative variations of Q or C below `resolution` do not count as a motion.
  Deformation(const io::Table& table, double resolution, ModelSummary& summary);

  /// The values of C(i, j) at the samples.
  std::vector<double> component(int i, int j) const;
  /// The indices (i, j), i ≤ j, of the component of C with the largest variance. If several variances are equal up to
  /// round-off, the first one counts.
  std::pair<int, int> liveliest_component() const;
};

/// The fit of the frequency to the samples of a component of C. The result has a reason instead of lines if the times
/// are not equally spaced or if the body does not deform. It also has a reason if the loads rise, because then the slow
/// change of the shape is larger than its oscillation. In other cases the result is that of fit_frequency.
FrequencyFit fit_component(const std::vector<double>& signal, const std::vector<double>& time, bool deforms,
                           bool loads_rise = false);

/// Reference value for the energies of one or more models, whose tables must have the columns kinetic and elastic. It
/// is the largest value over all models and times of three energies, unless this value is round-off. They are kinetic +
/// elastic, the dissipated energy, and the energy in the column orbital. The value is round-off if it is less than
/// 1e-12 of the gravitational and external energies. It is also round-off if it is less than 1e-24 of the unit of
/// energy `unit`. In these cases, the reference is the largest of the gravitational and external energies, or `unit` if
/// these are zero.
double energy_reference(std::initializer_list<const io::Table*> models, double unit);

/// Sets the drift of the energy relative to the reference value, its bound, and the first time beyond the bound. Let
/// the error of Q be τ|Q|, and let D = max|Q − Q(0)| be the departure, which `summary` must already contain. In an
/// oscillation, D is twice the amplitude, and the relative change of the energy is 4τ|Q|/D. If τ (`tolerance`) is given
/// and the body moves, the bound is this value with |Q| = √3, but at most 1 %. Otherwise the bound is 1 %.
void set_energy_drift(const io::Table& table, double reference, std::optional<double> tolerance, ModelSummary& summary);

/// Returns, for example, "two frequencies share the motion of the elastic ball, omega = 4.93 and, with 0.8 of its
/// amplitude, 6.14". The result is empty if the fit has no second line (frequency.h).
std::string shared_motion_clause(const ModelSummary& summary);

/// Returns, for example, "the energy of the elastic ball changes by up to 4.2 %, and by more than 1 % from t = 3.2 on".
/// The result is empty if the change is within the bound.
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

/// The columns of the angular momentum that is constant without loads other than self-gravity and companions. They are
/// total_J1 to total_J3 for the body and its companions together, or J1 to J3 if the table lacks these columns.
std::vector<std::string> columns_of_angular_momentum(const io::Table& table);

/// Reference value for angular momenta or circulations: the largest norm of `momenta`. If this norm is round-off, the
/// reference is the product m̄|Q||Q̇| at the sample with the largest |Q̇|. Here m̄ follows from the kinetic energy
/// K = ½m̄|Q̇|². The product bounds both norms at that sample up to a factor √2. If the table lacks the columns of Q,
/// Q̇ or K, the reference is the largest norm.
double momentum_reference(const io::Table& table, const std::vector<Eigen::Vector3d>& momenta);

/// The body spins if its angular momentum J or its circulation Z exceeds this fraction of m̄|Q||Q̇|. Smaller values are
/// round-off. Here m̄ is the factor in the kinetic energy K = ½m̄|Q̇|².
inline constexpr double spin_threshold = 1e-9;

/// The label of a column, and the least, greatest and last value of this column in a run.
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
  std::vector<ColumnRange> ranges;  ///< ranges of the columns for the terminal (terminal_table shows the first 12)
  std::optional<double>
      mean_nonaffine_kinetic_fraction;  ///< Σ η_K K / ΣK over the samples, with η_K the non-affine fraction of the
                                        ///< kinetic energy K; empty if the table lacks a column
};

/// Data from the scene that the summary of a run needs.
struct SceneFacts {
  double resolution = 1e-10;  ///< relative accuracy of Q and C; smaller relative variations do not count as a motion
  double energy_unit = 0;     ///< unit of energy of the scene
  /// Time/Tolerance, from which the program chose the step; empty if the scene gives the step.
  std::optional<double> tolerance{};
  std::vector<double> load_frequencies{};  ///< angular frequencies of loads that depend on time
  bool loads_rise = false;                 ///< true if Loads/Rise time is positive
};

/// Summary of the run of a model of the ball. The summary omits quantities whose columns the table lacks. The table
/// must have at least one sample.
MotionSummary summarize_motion(const ModelRunTable& run, const SceneFacts& facts);

/// Summary of the run of another system: the range of each column except the time, and the drift of the energy. The
/// drift is relative to the larger one of the largest kinetic energy and the range of the potential energy. If both are
/// round-off, the drift is relative to the largest potential energy. The drift is empty if all these values are 0, or
/// if there is no column energy. The table must have at least one sample.
MotionSummary summarize_system(const ModelRunTable& run);

/// Text for the terminal: one quantity per line, with at most 12 ranges of columns.
std::string terminal_table(const MotionSummary& summary);

}  // namespace pseudorigid::analysis
