#pragma once
/// The error of a fitted frequency ω of a component of C = QᵀQ, with the matrix Q of the affine motion (motion.h). The
/// error is the sum of four parts:
///
///   fit     Three standard errors of the fit (frequency.h). The residual does not contain the part of a signal that the
///           fit takes for a change of ω, so that one standard error is exceeded in some records of two close lines. If
///           the standard error on another discretisation is larger, it is used instead. A coarse model has few lines,
///           and its own standard error is too small for short records.
///   time    Let e bound the error in time of every entry of Q. Then the error of an entry of C is bounded by
///
///             |δC_ij| ≤ ε,   ε = max_t (|q_i|₁ + |q_j|₁) e,   with the columns q_i of Q.
///
///           The estimate treats δC_ij as an error of phase φ ≤ ε/A that grows along the record of length T, with the
///           amplitude A of the line. A least-squares fit then changes the frequency by
///
///             δω = (12/T³) ∫ (t − T/2) φ(t) dt ≤ (3/2) ε/(A T),
///
///           with equality if φ jumps from 0 to its bound at T/2. A phase that grows as a power of t gives at most
///           1.03 ε/(A T).
///   quadrature  The same expression, with the quadrature error of a polynomial body instead of e.
///   space   The difference from the frequency on another discretisation, times a factor (OtherResolution). The factor
///           assumes that the error decreases with the resolution at the least rate of space_error.h. Both runs usually
///           have the same time steps, so that their errors in time cancel. For a model without a discretisation in
///           space, this part is 0. For any other model, the part is not known if there is no other discretisation, if
///           its record is shorter, or if its samples do not give a frequency.

#include <utility>
#include <vector>

#include "analysis/error_bar.h"
#include "analysis/motion.h"

namespace pseudorigid::analysis {

constexpr double n_standard_errors = 3;  ///< in the part `fit` of an error

/// The bound ε of the error of C_ij, with `entry` = (i, j), if e bounds the error of every entry of Q.
double error_of_component(const Deformation& deformation, std::pair<int, int> entry, double e);

/// The samples of C_ij on the discretisation `errors.other`, with `entry` = (i, j). The result is empty if there is no
/// other discretisation, or if it has fewer than n_samples samples.
std::vector<double> other_component(std::pair<int, int> entry, std::size_t n_samples, const RunErrors& errors);

/// The error of the dominant frequency of `fit`, which was fitted to the values of C_ij at the times `time`, with
/// `entry` = (i, j). If the fit does not have lines, the errors in time and space are not known.
ErrorBar frequency_error(const FrequencyFit& fit, const Deformation& deformation, std::pair<int, int> entry,
                         const std::vector<double>& time, const RunErrors& errors);

/// The angular frequency Ω > 0 of the load that causes the dominant line ω of the fit. `load_frequencies` contains Ω or
/// −Ω for each load. The load is the cause if ω = Ω or ω = 2Ω, up to a phase of a quarter of a cycle at the end of the
/// record. The body then follows the load, and ω is not a property of the body. The result is empty if there is no such
/// load.
std::optional<double> load_of_line(const FrequencyFit& fit, const std::vector<double>& load_frequencies);

}  // namespace pseudorigid::analysis
