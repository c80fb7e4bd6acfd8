#pragma once
/// The error of a result of a run, as a sum of parts, and functions that print this error. If a part is not known, the
/// printed text names this part instead of the sum.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "analysis/other_resolution.h"

namespace pseudorigid::analysis {

struct ErrorBar {
  /// Error of a least-squares fit to the samples. It is 0 if the result does not come from a fit.
  double fit = 0;
  /// Errors of the discretisations in time and in space. They are empty if they are not known.
  std::optional<double> time{}, space{};
  /// Error of the quadrature rule of a polynomial body. It is empty if it is not known. It is 0 for other bodies,
  /// because their error of quadrature is a part of `space`.
  std::optional<double> quadrature = 0;

  /// The sum of the parts. The result is empty if a part is not known.
  std::optional<double> total() const {
    return time && space && quadrature ? std::optional(fit + *time + *space + *quadrature) : std::nullopt;
  }
};

/// Empty if the value is not finite.
inline std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// The sum of two errors, part by part. A part is known if it is known in both.
inline ErrorBar sum(const ErrorBar& a, const ErrorBar& b) {
  const auto both = [](const std::optional<double>& x, const std::optional<double>& y) {
    return x && y ? std::optional(*x + *y) : std::nullopt;
  };
  return {a.fit + b.fit, both(a.time, b.time), both(a.space, b.space), both(a.quadrature, b.quadrature)};
}

/// The error times a factor.
inline ErrorBar times(double factor, const ErrorBar& bar) {
  const auto multiple = [factor](const std::optional<double>& x) { return x ? std::optional(factor * *x) : x; };
  return {factor * bar.fit, multiple(bar.time), multiple(bar.space), multiple(bar.quadrature)};
}

/// An error printed with one significant digit, for example "0.003" or "2e-06". The error is rounded up, because it is
/// a bound. An error that is not positive is printed as "0".
inline std::string printed_error(double error) {
  if (!(error > 0)) return "0";
  const double place = std::pow(10, std::floor(std::log10(error)));
  constexpr double round_off = 1e-9;
  return fmt::format("{:.1g}", std::ceil(error / place * (1 - round_off)) * place);
}

/// Returns the names of the unknown parts, for example "error in space not known". The result is empty if every part is
/// known.
inline std::string unknown_parts(const ErrorBar& bar) {
  std::vector<std::string> names;
  if (!bar.time) names.emplace_back("time");
  if (!bar.space) names.emplace_back("space");
  if (!bar.quadrature) names.emplace_back("quadrature");
  if (names.empty()) return {};
  if (names.size() == 1) return fmt::format("error in {} not known", names[0]);
  const std::string last = names.back();
  names.pop_back();
  return fmt::format("errors in {} and {} not known", fmt::join(names, ", "), last);
}

/// Returns the parts of an error, for example "fit 0.003, time 2e-06, space not known". The text omits the parts `fit`
/// and `quadrature` if they are 0.
inline std::string parts_in_words(const ErrorBar& bar) {
  const auto part = [](const char* name, const std::optional<double>& value) {
    return value ? fmt::format("{} {}", name, printed_error(*value)) : fmt::format("{} not known", name);
  };
  std::vector<std::string> parts{part("time", bar.time), part("space", bar.space)};
  if (bar.fit > 0) parts.insert(parts.begin(), part("fit", bar.fit));
  if (bar.quadrature != 0.0) parts.push_back(part("quadrature", bar.quadrature));
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Returns the text that follows a number in a report, for example " +- 0.003". If a part of the error is not known,
/// the text names this part, for example " (error in space not known)".
inline std::string in_short(const ErrorBar& bar) {
  const auto total = bar.total();
  return total ? " +- " + printed_error(*total) : fmt::format(" ({})", unknown_parts(bar));
}

/// Estimated errors of the samples of a run. Q is the matrix of the affine motion that is nearest to the motion of the
/// body, or the deformation gradient of the pseudo-rigid body (comparison.h). An error is empty if it is not known.
struct RunErrors {
  /// Bound of the error of every entry of Q due to the time step.
  std::optional<double> time{};
  /// Largest relative error |δQ|/|Q| due to the mesh or degree. It is 0 for a model without a discretisation in space.
  std::optional<double> space{};
  /// Bound of the error of every entry of Q due to the quadrature rule. It is 0 if this error is a part of `space`.
  std::optional<double> quadrature = 0;
  const OtherResolution* other = nullptr;  ///< the same motion on another discretisation; null if there is none
};

}  // namespace pseudorigid::analysis
