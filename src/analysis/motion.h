#pragma once
/// Summary of one model's run: its frequency, its deformation and its conserved quantities.

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

/// A run of a model: its name, the name of its ball in sentences ("elastic"), its samples and their errors.
struct ModelRunTable {
  std::string name, adjective;
  const io::Table& table;
  RunErrors errors{};
};

/// Summary of the motion of one model. Drifts are the largest departures from the initial value, relative to reference
/// values (energy_reference, momentum_reference).
struct ModelSummary {
  std::string name, adjective;
  FrequencyFit frequency;
  ErrorBar frequency_error;      ///< of the dominant line (frequency_error.h)
  std::optional<double> load{};  ///< angular frequency of the load whose line it is, if it is one
  double departure = 0;          ///< max_t |Q − Q(0)|
  double strain_amplitude = 0;   ///< √2 rms_t |C − C̄|
  bool turns = false;            ///< Q changes
  bool deforms = false;          ///< C changes
  std::optional<double> energy_drift, angular_momentum_drift, circulation_drift;
  double energy_bound = 0;                      ///< largest change of the energy that is not warned of
  std::optional<double> energy_beyond_since{};  ///< first time at which the energy has changed by more
};

/// One model's Q and C = QᵀQ, and the summary of its motion.
struct Deformation {
  std::vector<Eigen::Matrix3d> Q, C;
  Eigen::Matrix3d C_mean = Eigen::Matrix3d::Zero();

  /// The motion in a table with the columns of Q. `resolution`: smaller variations of Q or C, relative to them, are not
  /// taken as a motion.
  Deformation(const io::Table& table, double resolution, ModelSummary& summary);

  std::vector<double> component(int i, int j) const;
  /// The component with the largest variance.
  std::pair<int, int> liveliest_component() const;
};

/// The frequency of samples of a component of C. If the times are not equally spaced, there is none.
FrequencyFit fit_component(const std::vector<double>& signal, const std::vector<double>& time, bool deforms);

/// Reference value for energies of one or more models: max_t (kinetic + elastic) or the dissipated energy, if this is
/// more. If that is round-off of the energies that there are, it is the largest of them. `unit` is the scene's unit of
/// energy, of which 1e-24 is as much as round-off of velocities has.
double energy_reference(std::initializer_list<const io::Table*> models, double unit);

/// Sets the drift of the column "energy" over the reference value, and the time from which it is beyond its bound. If
/// the error of Q is τ|Q|, the energy of an oscillation which departs by D = max|Q − Q(0)|, twice its amplitude,
/// changes by 4τ|Q|/D of itself. This is the bound if the step follows from τ, but never more than 1 %.
void set_energy_drift(const io::Table& table, double reference, std::optional<double> tolerance, ModelSummary& summary);

/// "the energy of the elastic ball changes by up to 4.2 %, and by more than 1 % from t = 3.2 on". Empty within the
/// bound.
std::string energy_clause(const ModelSummary& summary);

/// A drift up to this is said to be round-off: some hundred roundings of a double.
inline constexpr double round_off_drift = 1e-13;
/// "3.2e-07" or "round-off".
std::string drift_in_words(double drift);

/// Reference value for angular momenta or circulations: their largest norm or, if that is round-off, m̄|Q||Q̇| where
/// |Q̇| is largest, a bound of both up to a factor √2, with m̄ from K = ½m̄|Q̇|². 0 if the table cannot tell.
double momentum_reference(const io::Table& table, const std::vector<Eigen::Vector3d>& momenta);

/// J/m̄ or Z/m̄ beyond this part of |Q||Q̇| is spin, below it is round-off.
inline constexpr double spin_threshold = 1e-9;

/// A column's values over a run.
struct ColumnRange {
  std::string label;
  double least = 0, greatest = 0, last = 0;
};

/// One run by itself.
struct MotionSummary {
  ModelSummary model;
  std::size_t n_samples = 0;
  double first_time = 0, last_time = 0;
  bool has_state = false;
  std::string signal;  ///< component of C with the largest variance, "C33"
  std::vector<ColumnRange> ranges;
  std::optional<double> mean_nonaffine_kinetic_fraction;  ///< Σ η_K K / ΣK
};

/// Data of the scene of a run.
struct SceneFacts {
  double resolution = 1e-10;  ///< relative accuracy of the trajectories: smaller variations of Q or C are not a motion
  double energy_unit = 0;     ///< of the scene
  std::optional<double> tolerance{};       ///< error of Q, relative, if the step follows from it
  std::vector<double> load_frequencies{};  ///< angular frequencies of loads that depend on time
};

/// Summary of a model of the ball. Groups of columns that the table lacks are left out. The table holds a sample at
/// least.
MotionSummary summarize_motion(const ModelRunTable& run, const SceneFacts& facts);

/// Summary of another system: the range of each of its columns, and the relative drift of its energy.
MotionSummary summarize_system(const ModelRunTable& run);

/// For the terminal: a line for each number, at most 20 lines.
std::string terminal_table(const MotionSummary& summary);

}  // namespace pseudorigid::analysis
