#pragma once
/// Functions that write a comparison as files, as a table for the terminal, and as one sentence.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/comparison.h"
#include "io/csv.h"

namespace pseudorigid::analysis {

/// The table comparison.csv, with the time and every series.
io::Table comparison_table(const Comparison& comparison);

/// The content of comparison.json: all results of the comparison and the summary sentence, but not the values of the
/// series. For each series, it has the maximum, the time of the maximum, the RMS and the reference value.
nlohmann::ordered_json comparison_json(const Comparison& comparison);

/// Writes comparison_table and comparison_json into `folder`, as `<name>.csv` and `<name>.json`. Throws io::WriteError
/// if a file cannot be written.
void write_comparison(const std::filesystem::path& folder, const std::string& name, const Comparison& comparison);

/// Results of the comparisons of several models with the same reference. The list must not be empty. `overview` returns
/// text for the terminal: a heading, and for each model a line with q_difference and the ratio of the frequencies.
/// `overview_json` returns the name of the reference, and for each model the summary sentence, q_difference and the
/// ratio with their errors.
std::string overview(const std::vector<Comparison>& comparisons);
nlohmann::ordered_json overview_json(const std::vector<Comparison>& comparisons);

/// The result of the comparison as one sentence, with the clauses separated by semicolons and a full stop at the end.
std::string summary_sentence(const Comparison& comparison);

/// Returns, for example, "model difference 0.0123 +- 0.0004 (discretisation error, estimated: time 2e-06, space
/// 0.0004)". The difference is the largest value of q_difference. If the error is at least as large as the difference,
/// the text adds that the difference is not resolved. If a part of the error is not known, the text names this part
/// instead of all errors. Requires `has_state`.
std::string model_difference(const Comparison& comparison);

/// Returns, for example, "ratio of the frequencies 1.186319 +- 3e-05 (fit 2e-07, time 2e-05, space 1e-05)". Requires
/// that the comparison has a ratio.
std::string frequency_ratio(const Comparison& comparison);

/// A table for the terminal with the frequencies, the drifts and the differences. Its last line is the summary
/// sentence.
std::string terminal_table(const Comparison& comparison);

}  // namespace pseudorigid::analysis
