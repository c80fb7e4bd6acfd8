#include "continuum/modes/love_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "continuum/modes/surface_harmonics.h"

namespace pseudorigid::continuum {
namespace {

struct Range {
  double least, largest, sum = 0;
  int n = 0;

  void add(double value) {
    least = n == 0 ? value : std::min(least, value);
    largest = n == 0 ? value : std::max(largest, value);
    sum += value;
    ++n;
  }
  double mean() const { return sum / n; }
  double spread() const { return largest - least; }
};

/// The parity sector of the tides of even or of odd degree, with the harmonics of this parity.
struct TidalSector {
  TidalSector(const RestProblem& problem, bool odd, int max_degree)
      : sector(problem, parity_of_sector(odd ? 7 : 0)), harmonics(problem.space, sector.parity(), max_degree) {}

  ParitySector sector;
  SurfaceHarmonics harmonics;
};

mechanics::Status numbers_of_degree(const TidalSector& tidal, int n, double g, BallLoveNumbers& numbers) {
  Range h{}, l{};
  const auto fields = tidal.harmonics.radial_fields(n);
  Eigen::MatrixXd forces(tidal.sector.mass().size(), static_cast<Eigen::Index>(fields.size())), responses;
  Eigen::Index k = 0;
  for (const std::size_t radial : fields) forces.col(k++) = tidal.sector.entries_of(tidal.harmonics.force(radial));
  if (auto status = tidal.sector.respond(forces, responses); !status) return status;
  k = 0;
  for (const std::size_t radial : fields) {
    const Vector u = tidal.sector.field_of(responses.col(k++));
    h.add(g * tidal.harmonics.integral(radial, u));
    l.add(g * tidal.harmonics.integral(radial + 1, u) / std::sqrt(n * (n + 1.0)));
  }
  numbers = {{n, h.mean(), l.mean()}, h.spread(), l.spread()};
  return {};
}

/// Sets the `numbers` of the even or of the odd degrees.
mechanics::Status numbers_of_parity(const RestProblem& problem, bool odd, const std::vector<int>& degrees,
                                    std::vector<BallLoveNumbers>& numbers) {
  if (std::ranges::none_of(degrees, [&](int n) { return (n % 2 == 1) == odd; })) return {};
  TidalSector tidal(problem, odd, std::ranges::max(degrees));
  if (auto status = tidal.sector.factorize(); !status) return status;
  for (std::size_t i = 0; i < degrees.size(); ++i)
    if ((degrees[i] % 2 == 1) == odd)
      if (auto status = numbers_of_degree(tidal, degrees[i], problem.weight_of_density, numbers[i]); !status)
        return status;
  return {};
}

}  // namespace

mechanics::Status love_numbers(RestProblem problem, const std::vector<int>& degrees,
                               std::vector<BallLoveNumbers>& numbers, const SectorRanks& ranks) {
  problem.set_shift(0);
  numbers.assign(degrees.size(), {});
  mechanics::Status status;
  for (const bool odd : {false, true})
    if (status && ranks.owns(odd ? 1 : 0)) status = numbers_of_parity(problem, odd, degrees, numbers);
  if (status = ranks.of_all(status); !status) return status;
  for (const bool odd : {false, true}) {
    std::vector<double> values;
    for (const BallLoveNumbers& n : numbers)
      values.insert(values.end(), {n.mean.h, n.mean.l, n.spread_of_h, n.spread_of_l});
    values = ranks.of_owner(ranks.owns(odd ? 1 : 0), values);
    for (std::size_t i = 0; i < degrees.size(); ++i)
      if ((degrees[i] % 2 == 1) == odd) {
        const double* of_degree = values.data() + 4 * i;
        numbers[i] = {{degrees[i], of_degree[0], of_degree[1]}, of_degree[2], of_degree[3]};
      }
  }
  return {};
}

}  // namespace pseudorigid::continuum
