#include "app/polynomial/run_love_numbers.h"

#include <algorithm>
#include <chrono>

#include "app/polynomial/body_setup.h"
#include "app/run/love_table.h"
#include "polynomial/love_numbers.h"
#include "scene/discretization.h"
#include "scene/models.h"

namespace pseudorigid::app {
namespace {

/// Computes the rows of the body of this degree, with error bounds from a companion body of another degree. Fails if
/// the Love numbers of either body cannot be computed.
mechanics::Status find(const scene::Scene& scene, int degree, std::vector<LoveRow>& rows) {
  const std::vector<int> degrees = scene::love_degrees(scene);
  std::vector<gravity::LoveNumbers> numbers, other;
  if (auto status = polynomial::love_numbers(body_setup(scene, {}, degree), degrees, numbers); !status) return status;
  // The companion of a body of degree N has the degree N + 2. Its degree is larger if a tide of the largest requested
  // degree n needs it, because this tide causes displacements of degree n + 1. The companion has at most the degree
  // largest_polynomial_degree. If N is this largest degree, the companion has the degree N − 2.
  const int companion = std::min(std::max(degree + 2, degrees.back() + 1), scene::largest_polynomial_degree);
  if (auto status =
          polynomial::love_numbers(body_setup(scene, {}, companion > degree ? companion : degree - 2), degrees, other);
      !status)
    return status;
  constexpr double round_off = 1e-10;  // relative round-off of the solution
  rows = with_errors(numbers, other, round_off);
  return {};
}

}  // namespace

ModelOutcome run_polynomial_love_numbers(const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  ModelOutcome outcome;
  const auto model = std::ranges::find(context.needs.models, "polynomial", &scene::ModelDescription::name);
  const std::vector<scene::ModelRun> runs = scene::runs_of(**model, context.scene);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (context.interrupted()) {
      outcome.end = mechanics::Outcome::interrupted;
      outcome.message = "interrupted while computing Love numbers";
      return outcome;
    }
    std::vector<LoveRow> rows;
    if (auto status = find(context.scene, context.scene.polynomial.degrees[i], rows); !status) {
      outcome.end = mechanics::Outcome::failed;
      outcome.message = status.reason();
      return outcome;
    }
    write_love_table(rows, runs[i].name, runs[i].adjective, context, outcome);
  }
  outcome.statistics.timers["run"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

}  // namespace pseudorigid::app
