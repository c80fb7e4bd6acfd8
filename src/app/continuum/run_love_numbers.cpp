#include "app/continuum/run_love_numbers.h"

#include <chrono>

#include "app/continuum/rest_problem.h"
#include "app/run/love_table.h"
#include "continuum/modes/love_numbers.h"
#include "scene/discretization.h"
#include "scene/models.h"

namespace pseudorigid::app {
namespace {

mechanics::Status find(const scene::Scene& scene, const scene::Discretization& discretization,
                       std::vector<continuum::BallLoveNumbers>& numbers) {
  const BallAtRestOnMesh ball(scene, discretization);
  return continuum::love_numbers(ball.problem(), scene::love_degrees(scene), numbers);
}

/// The error is that of the mesh: of the difference to the companion, and the spread over the harmonics of a degree.
std::vector<LoveRow> rows_of(const std::vector<continuum::BallLoveNumbers>& numbers,
                             const std::vector<continuum::BallLoveNumbers>& other) {
  const auto means = [](const auto& all) {
    std::vector<gravity::LoveNumbers> means;
    for (const continuum::BallLoveNumbers& one : all) means.push_back(one.mean);
    return means;
  };
  std::vector<LoveRow> rows = with_errors(means(numbers), means(other));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].h_error += numbers[i].spread_of_h;
    rows[i].l_error += numbers[i].spread_of_l;
  }
  return rows;
}

}  // namespace

ModelOutcome run_continuum_love_numbers(const RunContext& context) {
  const scene::Scene& scene = context.scene;
  const auto start = std::chrono::steady_clock::now();
  const scene::Discretization discretization = *scene::fixed_discretization(scene);
  ModelOutcome outcome;
  std::vector<continuum::BallLoveNumbers> numbers, other;
  mechanics::Status status = find(scene, discretization, numbers);
  if (status && !context.interrupted()) status = find(scene, scene::companion(discretization), other);
  outcome.statistics.timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (context.interrupted()) {
    outcome.end = mechanics::Outcome::interrupted;
    outcome.message = "interrupted while computing Love numbers";
  } else if (!status) {
    outcome.end = mechanics::Outcome::failed;
    outcome.message = status.reason();
  } else {
    write_love_table(rows_of(numbers, other), "continuum", "elastic", context, outcome);
  }
  return outcome;
}

}  // namespace pseudorigid::app
