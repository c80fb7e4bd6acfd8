#pragma once
/// Comparison of two models of one ball: the differences of their quantities at each sample, the largest differences
/// with their times, and the frequencies.
///
/// The index r marks the compared model. The index c marks the reference model, which admits more motions. Q is the
/// deformation gradient of the pseudo-rigid body. For finite elements and polynomial bodies, Q is the mass moment Q_M,
/// the matrix of the nearest affine motion. C = QᵀQ, and |·| is the Frobenius norm. The maximum max_t, the root mean
/// square rms_t and the mean C̄ of C are taken over the samples. A ratio with the numerator 0 counts as 0. Each series
/// is a column of comparison.csv:
///
///   q_difference                |Q_c − Q_r| / |Q_r|
///   q_difference_of_departure   |Q_c − Q_r| / max_t |Q − Q(0)|,  with Q of the model that has the larger denominator
///   strain_difference           |C_c − C_r| / (√2 rms_t |C − C̄|),  with C of the model that has the larger
///                               denominator. If C varies as a sinusoid, the denominator is its amplitude. Rotations
///                               of the body do not change C.
///   phase_difference            (θ_r − θ_c) / 2π,  with the phases θ (phase.h) of the component of C whose frequency is
///                               fitted: the lead of model r, in periods. The first value is between −½ and ½. The
///                               series exists if `Comparison::ratio` has a value and both models have a phase.
///   a1_difference …             (a_c − a_r) / a_r,  with the semi-axes a₁, a₂, a₃
///   volume_ratio_difference     V_c − V_r,  with the current volume V divided by the reference volume
///   kinetic_difference,
///   elastic_difference,
///   energy_difference           (E_c − E_r) / E₀,  with the reference value E₀ of energy_reference (motion.h). It is
///                               usually max_t (kinetic + elastic) of the model with more energy. If nothing moves,
///                               E₀ is the largest of the other energies, or the unit of energy if they are 0.
///   dissipated_difference       (D_c − D_r) / max_t D,  with the dissipated energy D of the model that dissipates more.
///                               The series exists if at least one model dissipates energy.
///   max_stretch_difference,
///   min_stretch_difference      (λ_c − λ_r) / λ_r,  with the largest or least principal stretch λ anywhere in the body
///   mean_von_mises_difference,
///   max_von_mises_difference,
///   center_von_mises_difference (σ_c − σ_r) / max_t σ,  with a von Mises stress σ of the model with the larger maximum
///   angular_momentum_difference,
///   circulation_difference      |J_c − J_r| / J₀,  with the angular momentum or circulation J, and J₀ = max_t |J_r|. If
///                               this maximum is round-off, J₀ is a bound (momentum_reference of motion.h), or
///                               max_t |J_c| if the bound is 0.
///   multiplier_difference       (p_c − p_r) / max_t |p|,  with the multiplier p of the constraint of volume (column
///                               multiplier). The denominator is that of the model with the larger maximum.
///   nonaffine_kinetic_fraction, nonaffine_displacement                  columns of the reference
///
/// The divisor of q_difference_of_departure is at least ε |Q_r(0)|, and that of strain_difference at least ε |C_r(0)|,
/// with the resolution ε of SceneFacts. These bounds are the divisors if neither body moves.
///
/// The frequencies are those of one component of C, because rotations of the body do not change C. This component has
/// the largest variance in model r, or in the reference if model r does not deform. Model r has no error in space here:
/// its truncation of the motion is part of the compared difference. The reference has an error in space.

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/error_bar.h"
#include "analysis/motion.h"
#include "io/csv.h"

namespace pseudorigid::analysis {

/// √10 / 2.665622189236, the ratio of the pulsation frequency of the pseudo-rigid ball to the exact frequency (Lamb
/// 1882). The ratio is valid for small amplitudes of an incompressible elastic ball without gravity that does not
/// rotate on average. The law of the material must have a shear modulus. The ratio with gravity is in
/// app/run/small_pulsation.h.
inline constexpr double incompressible_ball_ratio = 3.1622776601683795 / 2.665622189236;

struct ComparisonOptions {
  SceneFacts facts{};
  std::optional<double> exact_frequency_ratio{};  ///< exact ratio of the frequencies ω_r/ω_c for small amplitudes;
                                                  ///< empty if it is not known
  std::optional<double> surface_limit_time{};     ///< first time at which the surface of the reference was unstable to
                                                  ///< wrinkles (Biot's limit); empty if it was not
};

struct Series {
  std::string name;      ///< column of comparison.csv
  double reference = 1;  ///< divisor of the differences, in the unit of their column; 1 for relative differences
  std::vector<double> values;
  double max = 0;          ///< largest absolute value
  double time_of_max = 0;  ///< first time of the largest absolute value
  double rms = 0;          ///< root mean square of the values over the samples
  ErrorBar error;          ///< estimate of the errors of `max` and `rms` (difference_error.h)
};

struct FrequencyRatio {
  double value = 0;  ///< ω_r/ω_c, with the angular frequencies ω of the dominant lines (frequency.h)
  ErrorBar error;    ///< bound for the error of the ratio due to the errors of both frequencies
};

/// The root mean square of a von Mises stress over the samples of model r, divided by that of the reference.
///
/// `error.space` bounds the change of this ratio if the stress c of the reference changes by f rms_t(c − c'). Here c'
/// is this stress on another discretisation, and f is the factor of OtherResolution. The bound has the first-order
/// change, divided by 1 minus the relative change, which counts as ½ at most. `error.time` and `error.quadrature` are
/// the ratio times the sum of 6 e max_t |Q| / max_t |C − Id| over both models, with the error e of an entry of Q. They
/// assume that strains have the relative error of the strain C − Id of the affine motion.
struct StressRatio {
  double value = 0;
  ErrorBar error;
};

struct Comparison {
  std::vector<double> time;
  std::vector<Series> series;
  ModelSummary model, reference;
  bool has_state = false;               ///< true if both tables have the columns of Q
  std::string signal;                   ///< component of C with the fitted frequency, for example "C33"
  std::string signal_reason;            ///< reason for the choice of this component
  ErrorBar error;                       ///< that of the series q_difference
  std::optional<FrequencyRatio> ratio;  ///< empty if a model has no frequency, or if its frequency is that of a load
  /// Exact value of the ratio for small amplitudes. It is empty if the options have none, if the body of model r spins,
  /// or if its table does not have the column Qdot11.
  std::optional<double> exact_ratio;
  /// n → phase_difference after n periods of the reference, for n = 1, 2, 5, 10, 20, 50 … within the run. The value is
  /// interpolated linearly between samples. The map is empty if there is no series phase_difference.
  std::map<int, double> phase_after_periods;
  /// The keys are the columns of the stresses that both tables have, unless the stress of the reference is round-off.
  std::map<std::string, StressRatio> stress_ratios;
  // The next four members are empty if the table of the reference lacks the columns of the non-affine motion. Each one
  // also requires a column of its own: kinetic, min_jacobian, max_volume_error and volume_error. F is the deformation
  // gradient.
  std::optional<double> mean_nonaffine_kinetic_fraction;  ///< Σ η_K K / ΣK over the samples, with the non-affine
                                                          ///< fraction η_K of the kinetic energy K
  ErrorBar mean_nonaffine_error;                          ///< estimate of the error of mean_nonaffine_kinetic_fraction
  std::optional<double> min_jacobian, max_volume_error;   ///< least det F and largest |ln det F| of the reference
  std::optional<double> volume_error;  ///< largest value of the column volume_error over the samples: the root mean
                                       ///< square of ln det F in the body of the reference
  std::optional<double> surface_limit_time;  ///< as in ComparisonOptions; later results depend on the mesh
  /// The omitted quantities, each with a missing column, for example "semi-axes (no column a1 in continuum.csv)".
  std::vector<std::string> not_compared;

  /// The series with this name; null if there is none.
  const Series* find(std::string_view name) const;
  /// Whether the largest q_difference exceeds the total of `error`. The result is empty if a part of `error` is not
  /// known. Requires `has_state`.
  std::optional<bool> is_resolved() const {
    const auto bar = error.total();
    return bar ? std::optional(find("q_difference")->max > *bar) : std::nullopt;
  }
};

/// Compares the samples of two models. Throws UserError if a table is empty or has a value that is not finite. Also
/// throws it if the numbers of samples differ, or if two sample times differ by more than 1e-9 of the mean interval. If
/// a table lacks the columns of a quantity, the comparison omits the quantity and lists it in `not_compared`.
/// Dissipated energies, stretches and extremes of the volume are optional and are not listed.
Comparison compare(const ModelRunTable& model, const ModelRunTable& reference, const ComparisonOptions& options = {});

}  // namespace pseudorigid::analysis
