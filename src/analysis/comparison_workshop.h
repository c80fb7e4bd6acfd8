#pragma once
/// The parts of a comparison (comparison.h) while it is made.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/comparison.h"
#include "analysis/difference_error.h"
#include "analysis/samples.h"

namespace pseudorigid::analysis {

inline const ErrorBar unknown{.time = {}, .space = {}, .quadrature = {}};

/// The data of a comparison: the tables r of the model and c of the reference, their errors, and the result `out`. The
/// parts of the comparison add series to `out`. Must not be copied, because `errors` refers to other members.
struct Workshop {
  const io::Table& r;
  const io::Table& c;
  RunErrors of_model, of_reference;
  const ComparisonOptions& options;
  Comparison out;
  DifferenceErrors errors{r, c, of_model, of_reference};

  /// Whether both tables have the columns. If not, adds the name `what` of the quantity and the first missing column to
  /// `out.not_compared`.
  bool available(std::string_view what, const Columns& columns) {
    return has(r, out.model, what, columns) && has(c, out.reference, what, columns);
  }

  /// Whether the table of `model` has the columns. If not, adds the name `what` of the quantity and the first missing
  /// column to `out.not_compared`.
  bool has(const io::Table& table, const ModelSummary& model, std::string_view what, const Columns& columns) {
    const auto lacks = [&table](const std::string& name) { return !table.has_column(name); };
    const auto missing = std::ranges::find_if(columns, lacks);
    if (missing == columns.end()) return true;
    out.not_compared.push_back(fmt::format("{} (no column {} in {}.csv)", what, *missing, model.name));
    return false;
  }

  /// Adds the series of the quotients values/reference, with its maximum and root mean square. A quotient is 0 if its
  /// value is 0, even if `reference` is 0. `error` is the error of the numerators over the divisors
  /// (difference_error.h), and `of_divisor` the relative error of the divisors.
  void add(std::string name, double reference, std::vector<double> values, const ErrorBar& error,
           const ErrorBar& of_divisor = {.time = 0, .space = 0}) {
    Series s{.name = std::move(name), .reference = reference, .values = std::move(values), .error = {}};
    double squares = 0;
    for (std::size_t n = 0; n < s.values.size(); ++n) {
      s.values[n] = ratio_or_zero(s.values[n], reference);
      squares += s.values[n] * s.values[n];
      if (n > 0 && std::abs(s.values[n]) <= s.max) continue;
      s.max = std::abs(s.values[n]);
      s.time_of_max = out.time[n];
    }
    s.rms = std::sqrt(squares / double(s.values.size()));
    s.error = sum(error, times(s.max, of_divisor));
    out.series.push_back(std::move(s));
  }
};

/// Adds the series of the differences of Q and of C, the error of Q, the frequencies and the phases. Adds the exact
/// ratio of the frequencies only if the table of the model shows that the body does not spin. If a table lacks a column
/// of Q, only adds an entry to `not_compared`.
void compare_states(Workshop& w);

}  // namespace pseudorigid::analysis
