#pragma once
/// Two models of one ball, sample by sample: how far apart they are, in which quantity, since when, and why.
///
/// Index r: one model; c: the reference, which is richer in motions. Q of the continuum is the mass moment Q_M, C =
/// QᵀQ, |·| is the Frobenius norm, and 0/0 counts as 0. Each series is a column of comparison.csv:
///
///   q_difference                |Q_c − Q_r| / |Q_r|
///   q_difference_of_departure   |Q_c − Q_r| / max_t |Q − Q(0)|          of the model that departs farther
///   strain_difference           |C_c − C_r| / (√2 rms_t |C − C̄|)        of the model that varies more; C̄ is the mean
///                               over time. The denominator of a sinusoid is its amplitude. Rotations do not count
///   a1_difference …             (a_c − a_r) / a_r
///   volume_ratio_difference     (vol_c − vol_r), both relative to the reference volume
///   kinetic_difference,
///   elastic_difference,
///   energy_difference           (E_c − E_r) / E₀,   E₀ = max_t (kinetic + elastic) of the model that has more: without
///                               gravity, loads and growth by error this is the initial mechanical energy. If nothing
///                               moves, E₀ is the largest energy that there is (energy_reference)
///   dissipated_difference       (D_c − D_r) / max_t D, D the energy dissipated, of the model that dissipates more
///   max_stretch_difference,
///   min_stretch_difference      (λ_c − λ_r) / λ_r, λ the largest or the least principal stretch anywhere in the body
///   angular_momentum_difference,
///   circulation_difference      |J_c − J_r| / J₀,   J₀ = max_t |J_r|, or, if that is round-off, m̄|Q||Q̇|, the bound
///                               of |J| and |Z| up to a factor √2, where |Q̇| is largest
///   multiplier_difference       (λ_c − λ_r) / max_t |λ|                 of the larger one
///   nonaffine_kinetic_fraction, nonaffine_displacement                  of the reference, as they are
///
/// The frequency is that of the component of C (invariant under rotations of the body) with the largest variance in the
/// first model, the same component in both. Errors in space are those of the reference: the first model's truncation is
/// part of the difference that is measured.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/error_bar.h"
#include "analysis/motion.h"
#include "io/csv.h"

namespace pseudorigid::analysis {

/// √10 / 2.665622189236: pulsation of the pseudo-rigid ball over the exact one (Lamb 1882) of an incompressible elastic
/// ball of any law with a shear modulus, at small amplitude, at rest in the mean, without gravity. With gravity:
/// app/run/small_pulsation.h.
inline constexpr double incompressible_ball_ratio = 3.1622776601683795 / 2.665622189236;

struct ComparisonOptions {
  SceneFacts facts{};
  std::optional<double> exact_frequency_ratio{};  ///< small-amplitude value if the scene has one
  std::optional<double>
      surface_limit_time{};  ///< time at which the reference's surface reached Biot's limit, if it did
};

struct Series {
  std::string name;      ///< column of comparison.csv
  double reference = 1;  ///< divisor of the values, in the unit of the input; 1 for ratios
  std::vector<double> values;
  double max = 0;          ///< largest absolute value
  double time_of_max = 0;  ///< when it is first met
  double rms = 0;          ///< over the samples
};

struct FrequencyRatio {
  double value = 0;  ///< ω_r / ω_c
  ErrorBar error;    ///< error of the ratio, from the largest errors of both frequencies
};

struct Comparison {
  std::vector<double> time;
  std::vector<Series> series;
  ModelSummary model, reference;
  bool has_state = false;
  std::string signal;         ///< "C33"
  std::string signal_reason;  ///< why this one
  /// The part of q_difference that the discretisations may cause: |δQ|/|Q|, largest over the samples. `space` is that
  /// of the reference, `time` is 3 e / min_t |Q_r| with e the estimated time errors of both models together,
  /// `quadrature` the same with those of their rules.
  ErrorBar error;
  std::optional<FrequencyRatio> ratio;  ///< empty if one of the lines belongs to a load
  std::optional<double> exact_ratio;    ///< only if it applies: the body does not spin
  std::optional<double>
      mean_nonaffine_kinetic_fraction;  ///< Σ η_K K / ΣK over the samples, so that instants of rest do not count
  std::optional<double> min_jacobian;
  std::optional<double> surface_limit_time;  ///< from then on the reference's results depend on its mesh
  std::vector<std::string> not_compared;  ///< data missing from the files: "semi-axes (no column a1 in continuum.csv)"

  const Series* find(std::string_view name) const;
  /// Whether the models differ by more than the discretisation may have made, if that is known.
  std::optional<bool> is_resolved() const {
    const auto bar = error.total();
    return bar ? std::optional(find("q_difference")->max > *bar) : std::nullopt;
  }
};

/// UserError if the tables are empty, hold different sample times or a value that is not finite. Groups of columns that
/// a table lacks are left out and named in `not_compared`.
Comparison compare(const ModelRunTable& model, const ModelRunTable& reference, const ComparisonOptions& options = {});

}  // namespace pseudorigid::analysis
