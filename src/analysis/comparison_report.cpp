#include "analysis/comparison_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/frequency_error.h"
#include "io/files.h"

namespace pseudorigid::analysis {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

/// Adds the parts of an error and their sum to `json`, under keys that begin with `prefix`. The part `fit` is added
/// only if `is_fitted` is true. Values that are not known are null.
void add_errors(Json& json, const std::string& prefix, const ErrorBar& bar, bool is_fitted) {
  if (is_fitted) json[prefix + "fit_error"] = bar.fit;
  json[prefix + "time_error"] = to_json(bar.time);
  json[prefix + "space_error"] = to_json(bar.space);
  json[prefix + "quadrature_error"] = to_json(bar.quadrature);
  json[prefix + "uncertainty"] = to_json(bar.total());
}

void add_ratio_errors(Json& json, const Comparison& c) {
  add_errors(json, "ratio_", c.ratio ? c.ratio->error : ErrorBar{.quadrature = {}}, true);
  if (!c.ratio) json["ratio_fit_error"] = nullptr;
}

Json frequency_of_model(const ModelSummary& m) {
  const FrequencyFit& fit = m.frequency;
  Json json{{"found", bool(fit)}};
  if (!fit) {
    json["reason"] = fit.reason;
    return json;
  }
  const Line& line = fit.dominant();
  json["omega"] = line.frequency;
  add_errors(json, "", m.frequency_error, true);
  json["load"] = to_json(m.load);
  json["amplitude"] = line.amplitude;
  json["cycles"] = fit.cycles;
  json["residual_rms"] = fit.residual_rms;
  const auto second = second_line(fit);
  json["second_line"] = second ? Json{{"omega", second->frequency}, {"amplitude", second->amplitude}} : Json(nullptr);
  for (const Line& l : fit.lines) {
    if (is_drift(l)) continue;
    json["lines"].push_back({{"omega", l.frequency},
                             {"fit_error", n_standard_errors * l.uncertainty},
                             {"amplitude", l.amplitude},
                             {"phase", l.phase}});
  }
  return json;
}

Json frequency_json(const Comparison& c) {
  Json json{{"signal", c.signal}, {"reason", c.signal_reason}};
  json[c.model.name] = frequency_of_model(c.model);
  json[c.reference.name] = frequency_of_model(c.reference);
  json["ratio"] = c.ratio ? Json(c.ratio->value) : Json(nullptr);
  add_ratio_errors(json, c);
  json["exact_small_amplitude_ratio"] = to_json(c.exact_ratio);
  json["phase_after_periods"] = Json::object();
  for (const auto& [n, periods] : c.phase_after_periods) json["phase_after_periods"][std::to_string(n)] = periods;
  return json;
}

Json model_difference_json(const Comparison& c) {
  Json json{{"value", c.find("q_difference")->max}};
  add_errors(json, "", c.error, false);
  const auto resolved = c.is_resolved();
  json["resolved"] = resolved ? Json(*resolved) : Json(nullptr);
  return json;
}

Json model_json(const ModelSummary& m, bool has_state) {
  Json json;
  json["departure"] = has_state ? Json(m.departure) : Json(nullptr);
  json["strain_amplitude"] = has_state ? Json(m.strain_amplitude) : Json(nullptr);
  json["energy_drift"] = to_json(m.energy_drift);
  json["angular_momentum_drift"] = to_json(m.angular_momentum_drift);
  json["circulation_drift"] = to_json(m.circulation_drift);
  json["failed_intervals"] = m.n_failed_intervals;
  return json;
}

/// A percentage rounded up, with one significant digit up to 9 % and as a whole number above.
std::string roughly(double percent) {
  return percent <= 9 ? printed_error(percent) : fmt::format("{:.0f}", std::ceil(percent));
}

/// The value as a percentage with three significant digits, for example "18.6" for 0.186. If the uncertainty exceeds
/// 0.5 % of the value, the text also contains the uncertainty, for example "18.6 +- 0.4".
std::string percent(double value, double uncertainty) {
  const double p = 100 * value, u = 100 * uncertainty;
  return u > 0.005 * std::abs(p) ? fmt::format("{:.3g} +- {}", p, roughly(u)) : fmt::format("{:.3g}", p);
}

std::string unknown_frequency(const ModelSummary& m) {
  return fmt::format("no frequency can be given for the {} ball ({})", m.adjective, m.frequency.reason);
}

/// The sentence about two frequencies if the error of their ratio is not known. In place of an error bar, the sentence
/// has the words "As far as the fits tell" and names the unknown parts of the error.
std::string fitted_frequencies(const Comparison& c) {
  const double excess = c.ratio->value - 1;
  const std::string apart =
      std::abs(excess) > c.ratio->error.fit
          ? fmt::format("pulsates {:.3g} % {} than", 100 * std::abs(excess), excess > 0 ? "faster" : "slower")
          : "pulsates with the same frequency as";
  return fmt::format("As far as the fits tell, the {} ball {} the {} ball ({})", c.model.adjective, apart,
                     c.reference.adjective, unknown_parts(c.ratio->error));
}

/// The sentence about two frequencies if the error of their ratio is known.
std::string known_frequencies(const Comparison& c, double uncertainty) {
  const double excess = c.ratio->value - 1;
  constexpr double round_off = 1e-12, says_little = 0.05;
  const double known_to = std::max({std::abs(excess), uncertainty, round_off});
  if (std::abs(excess) > uncertainty + round_off)
    return fmt::format("The {} ball pulsates {} % {} than the {} ball", c.model.adjective,
                       percent(std::abs(excess), uncertainty), excess > 0 ? "faster" : "slower", c.reference.adjective);
  if (known_to <= says_little)
    return fmt::format("The two balls pulsate with the same frequency to within {} %", roughly(100 * known_to));
  return fmt::format("The frequencies of the two balls cannot be told apart: they are known to {} %",
                     roughly(100 * known_to));
}

std::string compared_frequencies(const Comparison& c) {
  const auto uncertainty = c.ratio->error.total();
  std::string text = uncertainty ? known_frequencies(c, *uncertainty) : fitted_frequencies(c);
  if (c.exact_ratio) text += fmt::format(" (exact small-amplitude value: {:.2f} %)", 100 * (*c.exact_ratio - 1));
  return text;
}

/// The clause for the case that the frequency of at least one ball is the frequency of a load, or twice this frequency.
std::string followed_load(const ModelSummary& r, const ModelSummary& e) {
  const std::string who = r.load && e.load ? "Both balls follow a load"
                                           : fmt::format("The {} ball follows a load", (r.load ? r : e).adjective);
  return fmt::format("{}, of angular frequency {:.6g}, and their own frequencies cannot be compared", who,
                     *(r.load ? r : e).load);
}

std::string pulsation(const ModelSummary& m) {
  return m.frequency ? fmt::format("pulsates with omega = {:.6g}", m.frequency.dominant().frequency)
                     : fmt::format("deforms ({})", m.frequency.reason);
}

/// The first clause of the summary: the frequencies, or the reason why they are not compared.
std::string motion_clause(const Comparison& c) {
  const ModelSummary &r = c.model, &e = c.reference;
  if (!c.has_state) return "Deformations and frequencies cannot be compared without the columns Q11 to Q33";
  if (c.ratio) return compared_frequencies(c);
  if (r.load || e.load) return followed_load(r, e);
  if (!r.deforms && !e.deforms)
    return r.turns || e.turns ? "Both balls turn without changing shape" : "Neither ball moves";
  constexpr const char* one_keeps = "The {} ball keeps its shape while the {} ball {}";
  if (!r.deforms) return fmt::format(one_keeps, r.adjective, e.adjective, pulsation(e));
  if (!e.deforms) return fmt::format(one_keeps, e.adjective, r.adjective, pulsation(r));
  if (r.frequency) return fmt::format("The {} ball {}, but {}", r.adjective, pulsation(r), unknown_frequency(e));
  if (e.frequency) return fmt::format("The {} ball {}, but {}", e.adjective, pulsation(e), unknown_frequency(r));
  return fmt::format("Both balls deform, but no frequency can be given ({}: {}; {}: {})", r.adjective,
                     r.frequency.reason, e.adjective, e.frequency.reason);
}

/// The clause about the difference of the deformations. It states that the deformations are identical, if they are. If
/// neither body deforms, the clause has the largest q_difference. Otherwise it has the first time at which
/// strain_difference reaches 1. If there is no such time, it has the largest strain_difference and its time.
std::string difference_clause(const Comparison& c) {
  const Series &q = *c.find("q_difference"), &strain = *c.find("strain_difference");
  if (q.max == 0) return "their deformations are identical";
  if (!c.model.deforms && !c.reference.deforms)
    return fmt::format("their deformation gradients differ by at most {:.2g} %", 100 * q.max);
  const auto reached = std::ranges::find_if(strain.values, [](double d) { return d >= 1; });
  if (reached != strain.values.end())
    return fmt::format("at t = {:.4g} their deformations differ by 100 % of the amplitude for the first time",
                       c.time[std::size_t(reached - strain.values.begin())]);
  return fmt::format("their deformations differ by at most {:.2g} % of the amplitude (at t = {:.4g})", 100 * strain.max,
                     strain.time_of_max);
}

std::string nonaffine_clause(const Comparison& c) {
  if (c.mean_nonaffine_kinetic_fraction)
    return fmt::format("on average {:.2g} % of the {} ball's kinetic energy is in non-affine motion",
                       100 * *c.mean_nonaffine_kinetic_fraction, c.reference.adjective);
  const Series& fraction = *c.find("nonaffine_kinetic_fraction");
  return fmt::format("at most {:.2g} % of the {} ball's kinetic energy is in non-affine motion", 100 * fraction.max,
                     c.reference.adjective);
}

/// The value with `digits` significant digits, right-aligned in 13 characters; "-" if there is no value.
std::string cell(const std::optional<double>& value, int digits) {
  return fmt::format("{:>13}", value ? fmt::format("{:.{}g}", *value, digits) : "-");
}

std::string drift_cell(const std::optional<double>& drift) {
  return fmt::format("{:>13}", drift ? drift_in_words(*drift) : "-");
}

std::string model_row(std::string_view label, const std::optional<double>& model,
                      const std::optional<double>& reference, int digits) {
  return fmt::format("{:<38}{}{}", label, cell(model, digits), cell(reference, digits));
}

std::optional<double> frequency(const ModelSummary& m) {
  return m.frequency ? std::optional(m.frequency.dominant().frequency) : std::nullopt;
}

void add_model_rows(const Comparison& c, std::vector<std::string>& lines) {
  const ModelSummary &r = c.model, &e = c.reference;
  const auto drift = [&](std::string_view label, std::optional<double> ModelSummary::*value) {
    if (r.*value) lines.push_back(fmt::format("{:<38}{}{}", label, drift_cell(r.*value), drift_cell(e.*value)));
  };
  if (c.has_state) {
    lines.push_back(model_row("frequency of " + c.signal, frequency(r), frequency(e), 7));
    if (c.ratio) {
      lines.back() += fmt::format("   ratio {:.6f}{}", c.ratio->value, in_short(c.ratio->error));
      lines.push_back(fmt::format("{:<38}{}", "error of the ratio", parts_in_words(c.ratio->error)));
    }
    lines.push_back(model_row("amplitude of C = Q^T Q", r.strain_amplitude, e.strain_amplitude, 3));
  }
  drift("drift of the energy", &ModelSummary::energy_drift);
  drift("drift of the angular momentum", &ModelSummary::angular_momentum_drift);
  drift("drift of the circulation", &ModelSummary::circulation_drift);
}

/// The series in the table for the terminal, each with its label.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> shown{{
    {"q_difference", "Q, relative to |Q|"},
    {"strain_difference", "C, relative to its amplitude"},
    {"phase_difference", "phase, in periods"},
    {"kinetic_difference", "kinetic energy, relative to E_ref"},
    {"elastic_difference", "elastic energy, relative to E_ref"},
    {"nonaffine_kinetic_fraction", "non-affine part of the kinetic energy"},
    {"nonaffine_displacement", "non-affine part of the position"},
}};

void add_series_rows(const Comparison& c, std::vector<std::string>& lines) {
  for (const auto& [name, label] : shown)
    if (const Series* s = c.find(name))
      lines.push_back(fmt::format("{:<38}{:>13.3g}{:>13.3g}{:>13.4g}", label, s->rms, s->max, s->time_of_max));
}

}  // namespace

io::Table comparison_table(const Comparison& c) {
  io::Table table{.columns = {"time"}, .values = {}};
  for (const Series& s : c.series) table.columns.push_back(s.name);
  table.values.reserve(c.time.size() * table.columns.size());
  for (std::size_t n = 0; n < c.time.size(); ++n) {
    table.values.push_back(c.time[n]);
    for (const Series& s : c.series) table.values.push_back(s.values[n]);
  }
  return table;
}

nlohmann::ordered_json comparison_json(const Comparison& c) {
  Json json{{"summary", summary_sentence(c)}, {"samples", c.time.size()}};
  json["first_time"] = c.time.front();
  json["last_time"] = c.time.back();
  json["differences"] = Json::object();
  for (const Series& s : c.series) {
    Json& difference = json["differences"][s.name];
    difference = {{"max", s.max}, {"time_of_max", s.time_of_max}, {"rms", s.rms}, {"reference", s.reference}};
    add_errors(difference, "", s.error, s.error.fit > 0);
  }
  json["model_difference"] = c.has_state ? model_difference_json(c) : Json(nullptr);
  json["frequency"] = c.has_state ? frequency_json(c) : Json(nullptr);
  json[c.model.name] = model_json(c.model, c.has_state);
  json[c.reference.name] = model_json(c.reference, c.has_state);
  for (const auto& [name, ratio] : c.stress_ratios) {
    json["stress_ratios"][name] = {{"value", ratio.value}};
    add_errors(json["stress_ratios"][name], "", ratio.error, false);
  }
  json["mean_nonaffine_kinetic_fraction"] = to_json(c.mean_nonaffine_kinetic_fraction);
  json["mean_nonaffine_kinetic_fraction_uncertainty"] =
      to_json(c.mean_nonaffine_kinetic_fraction ? c.mean_nonaffine_error.total() : std::nullopt);
  json["min_jacobian"] = to_json(c.min_jacobian);
  json["volume_error"] = to_json(c.volume_error);
  json["max_volume_error"] = to_json(c.max_volume_error);
  json["surface_limit_time"] = to_json(c.surface_limit_time);
  json["not_compared"] = c.not_compared;
  return json;
}

void write_comparison(const std::filesystem::path& folder, const std::string& name, const Comparison& comparison) {
  const io::Table table = comparison_table(comparison);
  io::CsvWriter csv = io::CsvWriter::create(folder / (name + ".csv"), table.columns);
  for (std::size_t n = 0; n < table.n_rows(); ++n) csv.append(table.row(n));
  csv.flush();
  io::write_file_atomically(folder / (name + ".json"), {comparison_json(comparison).dump(2), "\n"});
}

std::string summary_sentence(const Comparison& c) {
  std::string sentence = motion_clause(c);
  if (c.has_state) sentence += "; " + difference_clause(c);
  // If the ball does not move, a fraction of its kinetic energy is a ratio of round-off errors.
  const bool moves = !c.has_state || c.reference.deforms || c.reference.turns;
  if (moves && c.find("nonaffine_kinetic_fraction")) sentence += "; " + nonaffine_clause(c);
  for (const ModelSummary* m : {&c.model, &c.reference})
    for (const std::string& clause : {shared_motion_clause(*m), energy_clause(*m), failure_clause(*m)})
      if (!clause.empty()) sentence += fmt::format("; {}", clause);
  return sentence + ".";
}

std::string model_difference(const Comparison& c) {
  const double value = c.find("q_difference")->max;
  if (!c.error.total()) return fmt::format("model difference {:.3g}{}", value, in_short(c.error));
  return fmt::format("model difference {:.3g}{} (discretisation error, estimated: {}){}", value, in_short(c.error),
                     parts_in_words(c.error),
                     *c.is_resolved() ? "" : "; the two overlap: the difference is not resolved");
}

std::string frequency_ratio(const Comparison& c) {
  return fmt::format("ratio of the frequencies {:.6f}{} ({})", c.ratio->value, in_short(c.ratio->error),
                     parts_in_words(c.ratio->error));
}

std::string terminal_table(const Comparison& c) {
  std::vector<std::string> lines;
  lines.push_back(fmt::format("{:<38}{:>13}{:>13}",
                              fmt::format("{} samples, t = {:g} to {:g}", c.time.size(), c.time.front(), c.time.back()),
                              c.model.name, c.reference.name));
  add_model_rows(c, lines);
  if (!c.series.empty())
    lines.push_back(fmt::format("{:<38}{:>13}{:>13}{:>13}", "difference", "rms", "largest", "at t"));
  add_series_rows(c, lines);
  if (c.has_state) lines.push_back(model_difference(c));
  if (c.surface_limit_time)
    lines.push_back(
        fmt::format("from t = {:.4g} on the {}'s surface is somewhere beyond Biot's limit, where "
                    "wrinkles of the mesh's size may grow",
                    *c.surface_limit_time, c.reference.name));
  if (!c.not_compared.empty()) lines.push_back(fmt::format("not compared: {}", fmt::join(c.not_compared, "; ")));
  return fmt::format("{}\n{}\n", fmt::join(lines, "\n"), summary_sentence(c));
}

std::string overview(const std::vector<Comparison>& comparisons) {
  const std::string& reference = comparisons.front().reference.name;
  std::vector<std::string> lines{fmt::format("{:<24}{:>13}{:>13}{:>13}{:>13}", "compared with " + reference, "rms of Q",
                                             "largest", "at t", "frequency")};
  for (const Comparison& c : comparisons) {
    const Series* q = c.find("q_difference");
    lines.push_back(fmt::format("{:<24}", c.model.name));
    if (q) lines.back() += fmt::format("{:>13.3g}{:>13.3g}{:>13.4g}", q->rms, q->max, q->time_of_max);
    if (q && c.ratio) lines.back() += fmt::format("{:>13.6g}", c.ratio->value);
  }
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

nlohmann::ordered_json overview_json(const std::vector<Comparison>& comparisons) {
  Json json{{"reference", comparisons.front().reference.name}, {"models", Json::object()}};
  for (const Comparison& c : comparisons) {
    Json& model = json["models"][c.model.name];
    model["summary"] = summary_sentence(c);
    model["model_difference"] = c.has_state ? model_difference_json(c) : Json(nullptr);
    model["ratio"] = c.ratio ? Json(c.ratio->value) : Json(nullptr);
    add_ratio_errors(model, c);
  }
  return json;
}

}  // namespace pseudorigid::analysis
