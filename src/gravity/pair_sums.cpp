#include <algorithm>

#include "gravity/surface_gravity.h"
#include "mechanics/core/lanes.h"

namespace pseudorigid::gravity {
namespace {

using L = mechanics::Lanes<mechanics::native_lanes>;
constexpr std::size_t n_lanes = mechanics::native_lanes;

/// Added to squared distances, and far below any that matters: a point and itself have no infinite inverse distance
/// then, and add 0, as all their terms have the factor d.
constexpr double no_distance = 1e-36;

/// As many targets as a vector has lanes, and what is summed for them: of g_i all but its part along N_i.
struct Block {
  L x[3], N[3], along_N, g[3], h[3];
};

/// Adds the pairs of a block with the sources.
void add_pairs(Block& block, const SurfacePoints& sources) {
  Block s = block;  // in registers
  for (std::size_t j = 0; j < sources.size(); ++j) {
    const double N[3] = {sources.N[0][j], sources.N[1][j], sources.N[2][j]};
    const L d[3] = {s.x[0] - sources.x[0][j], s.x[1] - sources.x[1][j], s.x[2] - sources.x[2][j]};
    const L inverse = inverse_sqrt(d[0] * d[0] + (d[1] * d[1] + (d[2] * d[2] + no_distance)));
    const L a_r = (d[0] * s.N[0] + d[1] * s.N[1] + d[2] * s.N[2]) * inverse;
    const L b_r = (d[0] * N[0] + d[1] * N[1] + d[2] * N[2]) * inverse;
    const L along_d = a_r * b_r * inverse;
    s.along_N += b_r;
    for (int c = 0; c < 3; ++c) {
      s.g[c] += a_r * N[c] - along_d * d[c];
      s.h[c] += d[c] * b_r;
    }
  }
  block = s;
}

L lanes_from(const std::vector<double>& values, std::size_t first) {
  return L::of([&](int l) { return values[std::min(first + l, values.size() - 1)]; });  // lanes beyond repeat the last
}

void store(const L& lanes, std::vector<double>& values, std::size_t first) {
  for (std::size_t l = 0; l < n_lanes && first + l < values.size(); ++l) values[first + l] = lanes[static_cast<int>(l)];
}

}  // namespace

PairSums sum_pairs(const SurfacePoints& targets, const SurfacePoints& sources) {
  const std::size_t n = targets.size();
  PairSums sums;
  sums.e.resize(n);
  for (int c = 0; c < 3; ++c) sums.g[c].resize(n), sums.h[c].resize(n);
  for (std::size_t first = 0; first < n; first += n_lanes) {
    Block block{};
    for (int c = 0; c < 3; ++c) {
      block.x[c] = lanes_from(targets.x[c], first);
      block.N[c] = lanes_from(targets.N[c], first);
    }
    add_pairs(block, sources);
    store(block.N[0] * block.h[0] + block.N[1] * block.h[1] + block.N[2] * block.h[2], sums.e, first);
    for (int c = 0; c < 3; ++c) {
      store(block.N[c] * block.along_N + block.g[c], sums.g[c], first);
      store(block.h[c], sums.h[c], first);
    }
  }
  return sums;
}

}  // namespace pseudorigid::gravity
