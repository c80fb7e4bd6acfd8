#include "analysis/comparison_report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "support/scratch_directory.h"
#include "synthetic_runs.h"

namespace {

using namespace pseudorigid::analysis;
using namespace synthetic;

std::string sentence(const Motion& r, const Motion& c, const std::vector<double>& t = ten,
                     const ComparisonOptions& options = {}) {
  Quantities affine{.orbit = false};
  affine.nonaffine = false;
  return summary_sentence(compare(reduced_run(r, t, affine), continuum_run(c, t, affine), options));
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(ComparisonReport, SentenceOfTwoPulsations) {
  const ComparisonOptions options{.exact_frequency_ratio = incompressible_ball_ratio};
  EXPECT_EQ(
      sentence(reduced_pulsation, exact_pulsation, ten, options),
      "The pseudo-rigid ball pulsates 18.6 % faster than the elastic ball (exact small-amplitude value: 18.63 %); "
      "at t = 2.55 their deformations differ by 100 % of the amplitude for the first time.");
  EXPECT_TRUE(contains(sentence(exact_pulsation, reduced_pulsation), "pulsates 15.7 % slower"));
}

TEST(ComparisonReport, SentenceOfEqualMotions) {
  EXPECT_EQ(sentence(reduced_pulsation, reduced_pulsation),
            "The two balls pulsate with the same frequency to within 1e-10 %; their deformations are identical.");
}

/// A frequency that is known to a fifth only says nothing of equality.
TEST(ComparisonReport, SentenceOfFrequenciesThatAreHardlyKnown) {
  Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten));
  c.ratio->error.fit = 0.2;
  EXPECT_TRUE(contains(summary_sentence(c), "cannot be told apart: they are known to 20 %")) << summary_sentence(c);
  c.ratio->error.fit = 0.1;
  EXPECT_TRUE(contains(summary_sentence(c), "pulsates 18.6 +- 10 % faster")) << summary_sentence(c);
  c.ratio->error.fit = 0.2;
  c.ratio->value = 1.9;
  EXPECT_TRUE(contains(summary_sentence(c), "pulsates 90 +- 20 % faster")) << summary_sentence(c);
}

/// A part that is not known is said, and no bar stands in its place.
TEST(ComparisonReport, SentenceOfFrequenciesWithUnknownErrors) {
  const Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten), {},
                               {.continuum = {.time = 1e-9}});
  const std::string text = terminal_table(c);
  EXPECT_TRUE(contains(text, "ratio 1.186319 (error in space not known)")) << text;
  EXPECT_TRUE(contains(summary_sentence(c), "pulsates 18.6 % faster than the elastic ball (error in space not known)"));
  EXPECT_FALSE(contains(text, "+-"));
  EXPECT_TRUE(comparison_json(c)["frequency"]["ratio_uncertainty"].is_null());
  EXPECT_FALSE(comparison_json(c)["frequency"]["ratio_time_error"].is_null());
}

TEST(ComparisonReport, ErrorsAreRoundedUp) {
  EXPECT_EQ(printed_error(0), "0");
  EXPECT_EQ(printed_error(0.0804), "0.09");
  EXPECT_EQ(printed_error(0.08), "0.08");
  EXPECT_EQ(printed_error(9.3e-7), "1e-06");
  EXPECT_EQ(printed_error(31), "4e+01");
}

/// The line of a load says nothing of the balls.
TEST(ComparisonReport, SentenceOfBallsThatFollowALoad) {
  const Motion driven = pulsation(1.3);
  for (const double load : {1.3, 0.65}) {
    const ComparisonOptions options{.facts = {.load_frequencies = {load}}};
    const Comparison c = compare(reduced_run(driven, ten), continuum_run(driven, ten), options);
    EXPECT_FALSE(c.ratio);
    EXPECT_TRUE(contains(summary_sentence(c), "Both balls follow a load")) << summary_sentence(c);
    EXPECT_TRUE(comparison_json(c)["frequency"]["ratio_fit_error"].is_null());
    EXPECT_EQ(comparison_json(c)["frequency"]["continuum"]["load"].get<double>(), load);
  }
  const ComparisonOptions slow{.facts = {.load_frequencies = {0.2}}};
  EXPECT_TRUE(compare(reduced_run(driven, ten), continuum_run(driven, ten), slow).ratio);
  EXPECT_TRUE(contains(sentence(pulsation(1.1), exact_pulsation, ten, {.facts = {.load_frequencies = {1.1}}}),
                       "The pseudo-rigid ball follows a load"));
}

TEST(ComparisonReport, SentenceWithoutPulsation) {
  const Motion still = pulsation(1, 0);
  EXPECT_EQ(sentence(still, still), "Neither ball moves; their deformations are identical.");
  EXPECT_EQ(summary_sentence(compare(reduced_run(still, ten), continuum_run(still, ten))),
            "Neither ball moves; their deformations are identical.");
  EXPECT_EQ(sentence(turning(still, 1), turning(still, 1)),
            "Both balls turn without changing shape; their deformations are identical.");
  EXPECT_TRUE(contains(sentence(turning(still, 1), turning(still, 1.001)), "differ by at most 0.82 %"));
  EXPECT_TRUE(contains(sentence(turning(still, 1), turning(exact_pulsation, 1)),
                       "The pseudo-rigid ball keeps its shape while the elastic ball pulsates with omega = 2.66562;"));
  EXPECT_TRUE(contains(sentence(reduced_pulsation, still), "The elastic ball keeps its shape while the pseudo-rigid"));
}

TEST(ComparisonReport, SentenceOfAShortRecord) {
  const std::string text = sentence(reduced_pulsation, exact_pulsation, times(201, 1));
  EXPECT_TRUE(contains(text, "Both balls deform, but no frequency can be given")) << text;
  EXPECT_FALSE(contains(text, "faster"));
}

TEST(ComparisonReport, SentenceTellsNonaffineMotion) {
  const auto change = [](double, ContinuumObservables& o) { o.nonaffine_kinetic_fraction = 0.031; };
  const Comparison c =
      compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten, {.orbit = false}, change));
  EXPECT_TRUE(contains(summary_sentence(c),
                       "; on average 3.1 % of the elastic ball's kinetic energy is in non-affine motion."));
}

TEST(ComparisonReport, TerminalTableIsShortAndAligned) {
  const Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten));
  std::istringstream text(terminal_table(c));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  EXPECT_GE(lines.size(), 10u);
  EXPECT_LE(lines.size(), 17u);
  EXPECT_TRUE(contains(lines[0], "201 samples, t = 0 to 10"));
  EXPECT_TRUE(contains(lines[1], "3.162278     2.665622   ratio 1.186319"));
  EXPECT_EQ(lines[0].find("continuum"), lines[1].find("2.665622") - 1);
  EXPECT_EQ(lines.back(), summary_sentence(c));
}

TEST(ComparisonReport, TellsTheDiscretizationErrorAndWhetherTheTwoOverlap) {
  const auto report = [](const RunErrors& of_continuum) {
    const Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten), {},
                                 {.continuum = of_continuum});
    EXPECT_TRUE(contains(terminal_table(c), model_difference(c)));
    return std::pair(model_difference(c), comparison_json(c)["model_difference"]);
  };
  const auto [unknown, of_unknown] = report({.time = 1e-7});
  const double value = of_unknown["value"].get<double>();
  const std::string shown = fmt::format("model difference {:.3g}", value);
  EXPECT_EQ(unknown, shown + " (error in space not known)");
  EXPECT_TRUE(of_unknown["uncertainty"].is_null());
  EXPECT_TRUE(of_unknown["resolved"].is_null());
  EXPECT_EQ(report({.space = 4e-4}).first, shown + " (error in time not known)");
  EXPECT_EQ(report({}).first, shown + " (errors in time and space not known)");

  const auto [resolved, json] = report({.time = 1e-7, .space = 3.9e-4});
  EXPECT_TRUE(resolved.starts_with(shown + " +- 0.0004 (")) << resolved;  // rounded up
  EXPECT_TRUE(contains(resolved, "time 2e-07, space 0.0004"));
  EXPECT_TRUE(json["resolved"].get<bool>());
  EXPECT_NEAR(json["space_error"].get<double>(), 3.9e-4, 1e-7);  // times the largest |Q_c| over the least |Q_r|
  // |Q| ≥ √3 where det Q = 1, with equality at rest; entries up to e are a matrix of norm up to 3e.
  EXPECT_NEAR(json["time_error"].get<double>(), 1e-7 * std::sqrt(3), 1e-9);
  EXPECT_EQ(json["uncertainty"].get<double>(), json["space_error"].get<double>() + json["time_error"].get<double>());

  const auto [overlapping, of_overlap] = report({.time = 0, .space = 1.1 * value});
  EXPECT_TRUE(contains(overlapping, "; the two overlap: the difference is not resolved"));
  EXPECT_FALSE(of_overlap["resolved"].get<bool>());
}

TEST(ComparisonReport, TerminalTableNamesWhatIsMissing) {
  Quantities q{.orbit = false};
  q.axes = false;
  const Comparison c = compare(reduced_run(reduced_pulsation, ten, q), continuum_run(exact_pulsation, ten, q));
  EXPECT_TRUE(contains(terminal_table(c), "not compared: semi-axes (no column a1 in reduced.csv); volume ratio"));
}

TEST(ComparisonReport, JsonHoldsTheFindings) {
  const Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten));
  const auto json = nlohmann::ordered_json::parse(comparison_json(c).dump());
  EXPECT_EQ(json["samples"], 201);
  EXPECT_EQ(json["frequency"]["signal"], "C33");
  EXPECT_NEAR(json["frequency"]["ratio"].get<double>(), incompressible_ball_ratio, 1e-10);
  double sum = 0;
  for (const char* part : {"ratio_fit_error", "ratio_time_error", "ratio_space_error"})
    sum += json["frequency"][part].get<double>();
  EXPECT_DOUBLE_EQ(json["frequency"]["ratio_uncertainty"].get<double>(), sum);
  EXPECT_TRUE(json["frequency"]["continuum"]["load"].is_null());
  EXPECT_TRUE(json["frequency"]["continuum"]["found"]);
  EXPECT_NEAR(json["frequency"]["continuum"]["lines"][0]["omega"].get<double>(), exact_omega, 1e-10);
  EXPECT_TRUE(json["frequency"]["exact_small_amplitude_ratio"].is_null());
  EXPECT_EQ(json["differences"]["q_difference"]["max"].get<double>(), c.find("q_difference")->max);
  EXPECT_LT(json["reduced"]["energy_drift"].get<double>(), 1e-14);
  EXPECT_EQ(json["summary"], summary_sentence(c));
  EXPECT_TRUE(json["not_compared"].empty());
}

TEST(ComparisonReport, FilesAreReadBackUnchanged) {
  const Comparison c = compare(reduced_run(reduced_pulsation, ten), continuum_run(exact_pulsation, ten));
  const pseudorigid::testing::ScratchDirectory folder;
  write_comparison(folder.path(), "comparison", c);
  const Table written = pseudorigid::io::read_csv(folder / "comparison.csv"), expected = comparison_table(c);
  EXPECT_EQ(written.columns, expected.columns);
  EXPECT_EQ(written.values, expected.values);
  EXPECT_EQ(written.columns[0], "time");
  std::ifstream file(folder / "comparison.json");
  EXPECT_EQ(nlohmann::ordered_json::parse(file), comparison_json(c));
}

}  // namespace
