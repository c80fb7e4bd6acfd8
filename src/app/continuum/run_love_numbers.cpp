#include "app/continuum/run_love_numbers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "app/continuum/rest_problem.h"
#include "app/continuum/sector_ranks.h"
#include "app/ranks/on_all_ranks.h"
#include "app/run/love_table.h"
#include "continuum/modes/love_numbers.h"
#include "scene/discretization.h"
#include "scene/models.h"

namespace pseudorigid::app {
namespace {

/// Computes the Love numbers of these degrees on one discretisation. Fails if a solution fails.
mechanics::Status find(const scene::Scene& scene, const scene::Discretization& discretization,
                       const std::vector<int>& degrees, const continuum::SectorRanks& ranks,
                       std::vector<continuum::BallLoveNumbers>& numbers) {
  const BallAtRestOnMesh ball(scene, discretization);
  return continuum::love_numbers(ball.problem(), degrees, numbers, ranks);
}

/// Raises the relative error of a degree to the largest relative error of the lower degrees. The function must be
/// called for the degrees in increasing order. A mesh resolves tides of a low degree better. If the relative difference
/// from the companion is smaller at a higher degree, this is a coincidence, and the bound would be too small.
struct RisingBound {
  double relative = 0;

  double operator()(double value, double error) {
    relative = std::max(relative, error / std::abs(value));
    return relative * std::abs(value);
  }
};

/// Makes the rows for the degrees that the scene requests. `numbers` has the Love numbers of all degrees from 2 to the
/// largest requested degree, on the discretisation of the scene. `other` has those on its companion.
std::vector<LoveRow> rows_of(const scene::Scene& scene, const std::vector<continuum::BallLoveNumbers>& numbers,
                             const std::vector<continuum::BallLoveNumbers>& other) {
  const auto means = [](const auto& all) {
    std::vector<gravity::LoveNumbers> means;
    for (const continuum::BallLoveNumbers& one : all) means.push_back(one.mean);
    return means;
  };
  const std::vector<int> wanted = scene::love_degrees(scene);
  std::vector<LoveRow> rows;
  RisingBound of_h, of_l;
  // The penalty of the constraint (RestProblem::penalty) increases with self-gravity, and so does round-off. This bound
  // was chosen from the measured relative round-off: 2e-10 up to γ = 100 and 5e-8 at γ = 10⁴, with γ = ρgr/μ.
  const double round_off = 1e-9 + 1e-11 * gravity_to_elasticity(scene);
  const std::vector<LoveRow> all = with_errors(means(numbers), means(other), round_off);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [n, h, l] = all[i].numbers;
    const LoveRow row{all[i].numbers, of_h(h, all[i].h_error + numbers[i].spread_of_h),
                      of_l(l, all[i].l_error + numbers[i].spread_of_l)};
    if (std::ranges::find(wanted, n) != wanted.end()) rows.push_back(row);
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
  std::vector<int> degrees(static_cast<std::size_t>(scene::love_degrees(scene).back() - 1));
  std::iota(degrees.begin(), degrees.end(), 2);
  mechanics::Status status = find(scene, discretization, degrees, sector_ranks(context), numbers);
  if (status && !context.interrupted())
    status = find(scene, scene::companion(discretization), degrees, sector_ranks(context), other);
  outcome.statistics.timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const bool interrupted = context.interrupted();
  if (interrupted) {
    outcome.end = mechanics::Outcome::interrupted;
    outcome.message = "interrupted while computing Love numbers";
  } else if (!status) {
    outcome.end = mechanics::Outcome::failed;
    outcome.message = status.reason();
  } else {
    on_all_ranks(*context.ranks,
                 [&] { write_love_table(rows_of(scene, numbers, other), "continuum", "elastic", context, outcome); });
  }
  return outcome;
}

}  // namespace pseudorigid::app
