/// The search for a discretisation, on runs whose errors are known.

#include "app/search/discretization_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "app/models/catalogue.h"
#include "app/run/model_files.h"
#include "app/search/error_estimate.h"
#include "support/scratch_directory.h"

namespace pseudorigid::app {
namespace {

constexpr int n_samples = 10;

/// What a run of the search was asked for.
struct Call {
  scene::Discretization discretization;
  bool written, stepping_is_known;
  double step, time_tolerance;
  std::size_t n_columns;
};

/// An error by the discretisation, and whether even and odd degrees meet it at the same time.
struct Law {
  std::function<double(const scene::Discretization&)> error;
  bool in_step = true;
};

/// The continuum: Q = Id, but for the error at one sample, and as many forces as the stable step takes.
struct Continuum {
  Law law;
  std::function<mechanics::Outcome(const scene::Discretization&)> end = [](const auto&) {
    return mechanics::Outcome::finished;
  };
  std::vector<Call> calls{};

  static double unknowns(const scene::Discretization& d) {
    return 12 * std::pow(std::ldexp(d.degree, d.refinements), 3);
  }
  static double forces(const scene::Discretization& d) { return 8 * d.degree * std::ldexp(d.degree, d.refinements); }

  ModelOutcome operator()(const RunContext& context, const ContinuumTask& task) {
    const scene::Discretization d = task.discretization;
    const bool written = context.sink_of(context, "continuum")->keeps_states();
    calls.push_back({d, written, task.stepping.has_value(), task.stepping ? task.stepping->step : 0,
                     context.scene.time.tolerance,
                     context.needs.models.back()->header(context.needs.quantities).size()});
    ModelOutcome outcome{.end = end(d), .message = "stopped", .statistics = {}};
    outcome.statistics.counters = {{"unknowns", unknowns(d)}, {"forces", forces(d)}};
    outcome.stepping = Stepping{mechanics::id_of<mechanics::Rattle4>, 0.1};
    for (int k = 0; task.trace && k <= n_samples; ++k) (*task.trace)[k] = Eigen::Matrix3d::Identity();
    if (task.trace) (*task.trace)[law.in_step || d.degree % 2 ? 3 : 7](2, 2) += law.error(d);
    return outcome;
  }
};

class DiscretizationSearchTest : public ::testing::Test {
 protected:
  void SetUp() override {
    scene_.continuum.degree.reset();
    scene_.continuum.refinements.reset();
    scene_.time.tolerance = 1e-6;
    scene_.output.samples = n_samples;
  }

  ModelOutcome search(Continuum& continuum, double tolerance, bool resume = false) {
    scene_.continuum.tolerance = tolerance;
    needs_ = scene::needs(scene_);
    const io::RunDirectory directory(folder_.path());
    const RunContext context{.scene = scene_,
                             .needs = needs_,
                             .directory = directory,
                             .units = io::ball_units(1, 1, 1),
                             .log = io::make_logger(io::Verbosity::silent, {}),
                             .sink_of = files_of_models(),
                             .resumes = resume};
    if (scene::fixed_discretization(scene_)) return run_with_estimate(context, std::ref(continuum));
    return DiscretizationSearch(context, std::ref(continuum)).run();
  }

  scene::Scene scene_ = scene::default_scene(program_catalogue());
  scene::Needs needs_;
  pseudorigid::testing::ScratchDirectory folder_;
};

/// Not even the energy of the volumetric stabilisation, which no word asks for: what is not observed is not a number,
/// and ends a run that has a column for it.
TEST_F(DiscretizationSearchTest, RunsWithoutFilesObserveNothing) {
  scene_.loads.get<loads::SelfGravity>().constant = 1;
  Continuum continuum{.law = {[](const auto& d) { return 0.1 * std::pow(scene::resolution(d), -3.5); }}};
  search(continuum, 1e-3);
  ASSERT_TRUE(needs_.quantities.volumetric);
  ASSERT_GE(continuum.calls.size(), 2u);
  for (const Call& call : continuum.calls) EXPECT_EQ(call.n_columns == 1, !call.written);
}

double work_of(const scene::Discretization& d) { return Continuum::unknowns(d) * Continuum::forces(d); }

/// Algebraic errors, such that are largest at different times, and errors that fall faster than any power.
const std::vector<Law> laws{{[](const auto& d) { return 0.1 * std::pow(scene::resolution(d), -3.5); }},
                            {[](const auto& d) { return 0.4 * std::pow(scene::resolution(d), -4.5); }, false},
                            {[](const auto& d) { return 0.3 * std::exp(-1.5 * scene::resolution(d)); }}};

TEST_F(DiscretizationSearchTest, MeetsTheToleranceForAFewTimesTheLeastWork) {
  for (const Law& law : laws)
    for (const double tolerance : {1e-3, 1e-4, 1e-5}) {
      Continuum continuum{.law = law};
      const ModelOutcome outcome = search(continuum, tolerance);
      const auto& c = outcome.statistics.counters;
      const scene::Discretization chosen = continuum.calls.back().discretization;
      EXPECT_EQ(chosen, (scene::Discretization{int(c.at("degree")), int(c.at("refinements"))}));
      EXPECT_LE(c.at("estimated_space_error"), tolerance);
      // By chance two runs are nearer to each other than to the truth.
      EXPECT_LE(law.error(chosen), 2 * c.at("estimated_space_error"));
      EXPECT_TRUE(continuum.calls.back().written);
      double least = HUGE_VAL, spent = 0;
      for (int k = 2; k <= scene::largest_degree; ++k)
        for (int r = 0; r <= 4; ++r)
          if (law.error({k, r}) <= tolerance) least = std::min(least, work_of({k, r}));
      for (const Call& call : continuum.calls) spent += work_of(call.discretization);
      EXPECT_DOUBLE_EQ(spent, c.at("work") + c.at("search_work"));
      EXPECT_LE(spent, 8 * least) << tolerance;
    }
}

TEST_F(DiscretizationSearchTest, KeepsTimeErrorsOutOfTheDifferences) {
  Continuum continuum{.law = laws[0]};
  search(continuum, 1e-4);
  ASSERT_GE(continuum.calls.size(), 4u);
  EXPECT_FALSE(continuum.calls[0].stepping_is_known);
  EXPECT_DOUBLE_EQ(continuum.calls[0].time_tolerance, 5e-6);
  // The step that degree 2 found, for degree 3.
  EXPECT_TRUE(continuum.calls[1].stepping_is_known);
  EXPECT_DOUBLE_EQ(continuum.calls[1].step, 0.1 * 2 / 3);
  EXPECT_FALSE(continuum.calls.back().stepping_is_known);
  EXPECT_DOUBLE_EQ(continuum.calls.back().time_tolerance, 1e-6);
  // A looser Time/Tolerance than the search can stand, and a step that is the user's.
  scene_.time.tolerance = 1e-2;
  scene_.time.step = 0.1;
  Continuum fixed{.law = laws[0]};
  search(fixed, 1e-4);
  EXPECT_DOUBLE_EQ(fixed.calls.back().time_tolerance, 5e-6);
  EXPECT_DOUBLE_EQ(fixed.calls[1].step, 0.1);
}

TEST_F(DiscretizationSearchTest, HonoursAFixedDegreeOrRefinement) {
  scene_.continuum.refinements = 1;
  Continuum degrees{.law = laws[0]};
  search(degrees, 1e-3);
  for (const Call& call : degrees.calls) EXPECT_EQ(call.discretization.refinements, 1);
  scene_.continuum.degree = 3;
  scene_.continuum.refinements.reset();
  Continuum refinements{.law = laws[0]};
  search(refinements, 1e-3);
  for (const Call& call : refinements.calls) EXPECT_EQ(call.discretization.degree, 3);
}

TEST_F(DiscretizationSearchTest, TakesTheFinestWhereNoneSuffices) {
  Continuum continuum{.law = {[](const auto& d) { return 1 / scene::resolution(d); }}};
  const ModelOutcome outcome = search(continuum, 1e-6);
  EXPECT_EQ(outcome.end, mechanics::Outcome::finished);
  EXPECT_EQ(continuum.calls.back().discretization, scene::ladder(scene_).back());
  EXPECT_GT(outcome.statistics.counters.at("estimated_space_error"), 1e-6);
}

TEST_F(DiscretizationSearchTest, GoesOnAfterAnInterruptWithoutRepeatingARun) {
  Continuum whole{.law = laws[1]};
  const ModelOutcome expected = search(whole, 1e-4);
  for (std::size_t stop = 0; stop < whole.calls.size(); ++stop) {
    Continuum parts{.law = laws[1]};
    parts.end = [&](const auto&) {
      return parts.calls.size() == stop + 1 ? mechanics::Outcome::interrupted : mechanics::Outcome::finished;
    };
    EXPECT_EQ(search(parts, 1e-4).end, mechanics::Outcome::interrupted);
    const ModelOutcome resumed = search(parts, 1e-4, true);
    EXPECT_EQ(resumed.statistics.counters, expected.statistics.counters);
    EXPECT_EQ(parts.calls.size(), whole.calls.size() + 1);  // that in hand, twice
  }
  // Of a run that is complete nothing is left to search.
  Continuum again{.law = laws[1]};
  EXPECT_EQ(search(again, 1e-4, true).statistics.counters, expected.statistics.counters);
  EXPECT_EQ(again.calls.size(), 1u);
}

TEST_F(DiscretizationSearchTest, PassesOverAMeshThatIsTooCoarseForTheMotion) {
  Continuum continuum{.law = laws[0]};
  continuum.end = [](const auto& d) {
    return d.degree == 2 && d.refinements == 0 ? mechanics::Outcome::failed : mechanics::Outcome::finished;
  };
  const ModelOutcome outcome = search(continuum, 1e-3);
  EXPECT_EQ(outcome.end, mechanics::Outcome::finished);
  EXPECT_LE(laws[0].error(continuum.calls.back().discretization), 1e-3);
}

TEST_F(DiscretizationSearchTest, StopsWhereTheMotionBreaksOff) {
  Continuum continuum{.law = laws[0]};
  continuum.end = [](const auto&) { return mechanics::Outcome::failed; };
  const ModelOutcome outcome = search(continuum, 1e-3);
  EXPECT_EQ(outcome.end, mechanics::Outcome::failed);
  ASSERT_EQ(continuum.calls.size(), 3u);
  EXPECT_TRUE(continuum.calls.back().written);
}

/// A fixed discretisation beside another model.
TEST_F(DiscretizationSearchTest, CompanionEstimatesTheErrorAndCostsAThird) {
  for (const int k : {3, 4, 5}) {
    scene_.continuum.degree = k;
    scene_.continuum.refinements = 0;
    Continuum continuum{.law = laws[1]};
    const auto counters = search(continuum, 1e-3).statistics.counters;
    ASSERT_EQ(continuum.calls.size(), 2u);
    EXPECT_TRUE(continuum.calls[0].written);
    EXPECT_FALSE(continuum.calls[1].written);
    EXPECT_DOUBLE_EQ(continuum.calls[1].step, 0.1);
    // Where the two are not in step the distance is the error of the companion.
    const double e = laws[1].error({k, 0});
    EXPECT_GE(counters.at("estimated_space_error"), e);
    EXPECT_LE(counters.at("estimated_space_error"), 6 * e);
    EXPECT_LE(counters.at("companion_work"), 0.35 * counters.at("work"));
  }
}

TEST_F(DiscretizationSearchTest, NoCompanionWhereNobodyAsks) {
  scene_.continuum.degree = 4;
  scene_.continuum.refinements = 0;
  const auto n_runs = [&] {
    Continuum continuum{.law = laws[0]};
    search(continuum, 1e-3);
    return continuum.calls.size();
  };
  EXPECT_EQ(n_runs(), 2u);
  scene_.continuum.error_estimate = scene::ErrorEstimate::none;
  EXPECT_EQ(n_runs(), 1u);
  scene_.continuum.error_estimate = scene::ErrorEstimate::automatic;
  scene_.models = {"continuum"};
  EXPECT_EQ(n_runs(), 1u);
}

}  // namespace
}  // namespace pseudorigid::app
