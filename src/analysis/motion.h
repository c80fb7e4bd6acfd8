#pragma once
/// Summary of the run of one model: its frequency, its deformation and its conserved quantities.

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

/// A run of a model, with its name, the adjective of its ball in sentences ("elastic"), its samples and their errors.
struct ModelRunTable {
  std::string name, adjective;
  const io::Table& table;
  RunErrors errors{};
};

/// Summary of the motion of one model. A drift is the largest difference from the initial value, relative to a
/// reference value (energy_reference, momentum_reference).
struct ModelSummary {
  std::string name, adjective;
  FrequencyFit frequency;
  ErrorBar frequency_error;      ///< error of the dominant line (frequency_error.h)
  std::optional<double> load{};  ///< angular frequency of the load that causes the dominant line, if any
  double departure = 0;          ///< max_t |Q − Q(0)|
  double strain_amplitude = 0;   ///< √2 rms_t |C − C̄|, C̄ the mean over time
  bool turns = false;            ///< whether Q changes
  bool deforms = false;          ///< whether C changes
  std::optional<double> energy_drift, angular_momentum_drift, circulation_drift;
  double energy_bound = 0;  ///< largest change of the energy without a warning, relative to the reference value
  std::optional<double> energy_beyond_since{};  ///< first time at which the energy has changed by more than this bound
};

/// Q and C = QᵀQ of one model at each sample. The constructor also sets the summary of the motion.
struct Deformation {
  std::vector<Eigen::Matrix3d> Q, C;
  Eigen::Matrix3d C_mean = Eigen::Matrix3d::Zero();

  /// Reads Q from a table with its columns. Relative variations of Q or C below `resolution` do not count as a motion.
  Deformation(const io::Table& table, double resolution, ModelSummary& summary);

  std::vector<double> component(int i, int j) const;
  /// The component of C with the largest variance.
  std::pair<int, int> liveliest_component() const;
};

/// The frequency of the samples of a component of C. There is no frequency if the times are not equally spaced.
FrequencyFit fit_component(const std::vector<double>& signal, const std::vector<double>& time, bool deforms);

/// Reference value for energies of one or more models. It is the larger of max_t (kinetic + elastic) and the dissipated
/// energy. If this is round-off of the gravitational and external energies, the largest of these is the reference.
/// `unit` is the unit of energy of the scene; energies below 1e-24 of it are round-off of velocities.
double energy_reference(std::initializer_list<const io::Table*> models, double unit);

/// Sets the drift of the energy relative to the reference value, and the first time beyond its bound. Let the error of
/// Q be τ|Q|, and let D = max|Q − Q(0)| be the departure of an oscillation, twice its amplitude. The relative change of
/// the energy is then 4τ|Q|/D. If the step follows from τ (`tolerance`), the bound is this value, but at most 1 %.
/// Otherwise the bound is 1 %.
void set_energy_drift(const io::Table& table, double reference, std::optional<double> tolerance, ModelSummary& summary);

/// "the energy of the elastic ball changes by up to 4.2 %, and by more than 1 % from t = 3.2 on". Empty if the change
/// is within the bound.
std::string energy_clause(const ModelSummary& summary);

/// A drift up to this value is reported as round-off. It is the error of some hundred operations in double precision.
inline constexpr double round_off_drift = 1e-13;
/// The text of a drift: "3.2e-07" or "round-off".
std::string drift_in_words(double drift);

/// Reference value for angular momenta or circulations: their largest norm. If this norm is round-off, the reference is
/// m̄|Q||Q̇| at the sample with the largest |Q̇|, with m̄ from K = ½m̄|Q̇|². This bounds both norms up to a factor √2.
/// The value is 0 if the table lacks the columns.
double momentum_reference(const io::Table& table, const std::vector<Eigen::Vector3d>& momenta);

/// The body spins if J/m̄ or Z/m̄ exceeds this fraction of |Q||Q̇|. Smaller values are round-off.
inline constexpr double spin_threshold = 1e-9;

/// The range of the values of a column in a run.
struct ColumnRange {
  std::string label;
  double least = 0, greatest = 0, last = 0;
};

/// Summary of one run without a comparison.
struct MotionSummary {
  ModelSummary model;
  std::size_t n_samples = 0;
  double first_time = 0, last_time = 0;
  bool has_state = false;
  std::string signal;  ///< component of C with the largest variance, "C33"
  std::vector<ColumnRange> ranges;
  std::optional<double>
      mean_nonaffine_kinetic_fraction;  ///< Σ η_K K / ΣK, with η_K the non-affine fraction of the kinetic energy K
};

/// Data of the scene that the summary of a run needs.
struct SceneFacts {
  double resolution = 1e-10;               ///< relative accuracy of Q and C; smaller variations are not a motion
  double energy_unit = 0;                  ///< unit of energy of the scene
  std::optional<double> tolerance{};       ///< relative error of Q if the step follows from it
  std::vector<double> load_frequencies{};  ///< angular frequencies of loads that depend on time
};

/// Summary of the run of a model of the ball. Groups of columns that the table lacks are omitted. The table has at
/// least one sample.
MotionSummary summarize_motion(const ModelRunTable& run, const SceneFacts& facts);

/// Summary of another system, with the range of each column and the relative drift of the energy.
MotionSummary summarize_system(const ModelRunTable& run);

/// Text for the terminal: one quantity per line, at most 20 lines.
std::string terminal_table(const MotionSummary& summary);

}  // namespace pseudorigid::analysis
