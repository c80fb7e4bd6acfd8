#pragma once
/// The error of a fitted frequency ω of C = QᵀQ, as the sum of its parts:
///
///   fit     the standard error of the fit (frequency.h), or that of the fit on another discretisation if it is larger:
///           a poor model has few lines, and its fit does not show how little a short record determines;
///   time    Let e bound the error in time of every entry of Q. Then an entry of C is wrong by
///
///             |δC_ij| ≤ ε,   ε = max_t (|q_i|₁ + |q_j|₁) e,   q_i the columns of Q.
///
///           It is taken for an error of phase, φ ≤ ε/A with A the amplitude of the line, that grows along the record
///           of length T. A least-squares fit turns such a phase into
///
///             δω = (12/T³) ∫ (t − T/2) φ(t) dt ≤ (3/2) ε/(A T),
///
///           with equality if φ jumps at T/2; a phase that grows as any power of t gives at most 1.03 ε/(A T);
///   quadrature  the same with the error of Q by the rule of a polynomial body in place of e;
///
///   space   the difference from the frequency on another discretisation, times the factor of an error that falls as
///           the slowest power of the resolution that is measured (space_error.h). Both runs have the same steps, so
///           the error in time cancels.

#include <vector>

#include "analysis/error_bar.h"
#include "analysis/motion.h"

namespace pseudorigid::analysis {

/// The error of `fit`, a fit of the entry (i, j) of C at these times.
ErrorBar frequency_error(const FrequencyFit& fit, const Deformation& deformation, std::pair<int, int> entry,
                         const std::vector<double>& time, const RunErrors& errors);

/// The load among those of these angular frequencies whose line the fitted one is: ω = Ω or 2Ω to a quarter of a cycle
/// over the record. Then the body follows the load, and ω is not a property of the body.
std::optional<double> load_of_line(const FrequencyFit& fit, const std::vector<double>& load_frequencies);

}  // namespace pseudorigid::analysis
