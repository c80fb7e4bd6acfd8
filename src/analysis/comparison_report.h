#pragma once
/// Output of a comparison as files, as a table for the terminal, and as one sentence.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/comparison.h"
#include "io/csv.h"

namespace pseudorigid::analysis {

/// The table comparison.csv, with the time and every series.
io::Table comparison_table(const Comparison& comparison);

/// The content of comparison.json: for each series its maximum, time of the maximum, RMS and reference value; also
/// frequencies, drifts and missing data.
nlohmann::ordered_json comparison_json(const Comparison& comparison);

/// Writes the table and the JSON into `folder`, as `<name>.csv` and `<name>.json`.
void write_comparison(const std::filesystem::path& folder, const std::string& name, const Comparison& comparison);

/// Comparisons with the same reference: as text for the terminal with one line each, and as JSON.
std::string overview(const std::vector<Comparison>& comparisons);
nlohmann::ordered_json overview_json(const std::vector<Comparison>& comparisons);

/// The result of the comparison as one sentence.
std::string summary_sentence(const Comparison& comparison);

/// "model difference 0.0123 +- 0.0004 (discretisation error, estimated: time 2e-06, space 0.0004)", for Q relative to
/// |Q|. A remark is added if the error is larger than the difference. Requires `has_state`.
std::string model_difference(const Comparison& comparison);

/// "ratio of the frequencies 1.186319 +- 3e-05 (fit 2e-07, time 2e-05, space 1e-05)". Requires that the comparison has
/// a ratio.
std::string frequency_ratio(const Comparison& comparison);

/// A table of at most 18 lines. The last line is the summary sentence.
std::string terminal_table(const Comparison& comparison);

}  // namespace pseudorigid::analysis
