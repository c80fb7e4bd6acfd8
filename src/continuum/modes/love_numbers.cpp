#include "continuum/modes/love_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

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
  for (const std::size_t radial : tidal.harmonics.radial_fields(n)) {
    Vector u;
    if (auto status = tidal.sector.respond(tidal.harmonics.force(radial), u); !status) return status;
    h.add(g * tidal.harmonics.integral(radial, u));
    l.add(g * tidal.harmonics.integral(radial + 1, u) / std::sqrt(n * (n + 1.0)));
  }
  numbers = {{n, h.mean(), l.mean()}, h.spread(), l.spread()};
  return {};
}

}  // namespace

mechanics::Status love_numbers(RestProblem problem, const std::vector<int>& degrees,
                               std::vector<BallLoveNumbers>& numbers) {
  problem.shift = 0;
  const double g = problem.weight_of_density;
  std::map<bool, TidalSector> sectors;
  numbers.clear();
  for (const int n : degrees) {
    const bool odd = n % 2 == 1;
    auto found = sectors.find(odd);
    if (found == sectors.end()) {
      found = sectors.try_emplace(odd, problem, odd, std::ranges::max(degrees)).first;
      if (auto status = found->second.sector.factorize(); !status) return status;
    }
    if (auto status = numbers_of_degree(found->second, n, g, numbers.emplace_back()); !status) return status;
  }
  return {};
}

}  // namespace pseudorigid::continuum
