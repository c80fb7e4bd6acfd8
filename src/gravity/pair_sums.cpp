#include <algorithm>
#include <functional>

#include "gravity/surface_gravity.h"
#include "mechanics/core/lanes.h"

namespace pseudorigid::gravity {
namespace {

using L = mechanics::Lanes<mechanics::native_lanes>;
constexpr std::size_t n_lanes = mechanics::native_lanes;

/// Added to squared distances, and far below any that matters: a point and itself have no infinite inverse distance
/// then, and add 0, as all their terms have the factor d.
constexpr double no_distance = 1e-36;

/// A number with its rate.
struct Rated {
  L value, rate;

  friend Rated operator+(const Rated& a, const Rated& b) { return {a.value + b.value, a.rate + b.rate}; }
  friend Rated operator+(const Rated& a, double b) { return {a.value + b, a.rate}; }
  friend Rated operator-(const Rated& a, const Rated& b) { return {a.value - b.value, a.rate - b.rate}; }
  friend Rated operator*(const Rated& a, const Rated& b) {
    return {a.value * b.value, a.rate * b.value + a.value * b.rate};
  }
  Rated& operator+=(const Rated& b) { return *this = *this + b; }
  friend Rated inverse_sqrt(const Rated& a) {
    const L root = inverse_sqrt(a.value);
    return {root, -0.5 * a.rate * (root * root * root)};
  }
};

/// As many targets as a vector has lanes, and what is summed for them: of g_i all but its part along N_i.
template <class S>
struct Block {
  S x[3], N[3], along_N, g[3], h[3];
};

/// Adds the pairs of a block with n sources: of number j, point(c, j) and area(c, j) are the components.
template <class S, class Point, class Area>
void add_pairs(Block<S>& block, std::size_t n, const Point& point, const Area& area) {
  Block<S> s = block;  // in registers
  for (std::size_t j = 0; j < n; ++j) {
    const decltype(area(0, j)) N[3] = {area(0, j), area(1, j), area(2, j)};
    const S d[3] = {s.x[0] - point(0, j), s.x[1] - point(1, j), s.x[2] - point(2, j)};
    const S inverse = inverse_sqrt(d[0] * d[0] + (d[1] * d[1] + (d[2] * d[2] + no_distance)));
    const S a_r = (d[0] * s.N[0] + d[1] * s.N[1] + d[2] * s.N[2]) * inverse;
    const S b_r = (d[0] * N[0] + d[1] * N[1] + d[2] * N[2]) * inverse;
    const S along_d = a_r * b_r * inverse;
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

/// What a block has found, for its targets from number `first` on; `part` is a value or a rate.
template <class S, class Part>
void store(const Block<S>& block, const Part& part, std::size_t first, PairSums& sums) {
  store(part(block.N[0] * block.h[0] + block.N[1] * block.h[1] + block.N[2] * block.h[2]), sums.e, first);
  for (int c = 0; c < 3; ++c) {
    store(part(block.N[c] * block.along_N + block.g[c]), sums.g[c], first);
    store(part(block.h[c]), sums.h[c], first);
  }
}

PairSums no_sums(std::size_t n_targets) {
  const std::vector<double> none(n_targets);
  return {none, {none, none, none}, {none, none, none}};
}

}  // namespace

PairSums sum_pairs(const SurfacePoints& targets, const SurfacePoints& sources) {
  PairSums sums = no_sums(targets.size());
  for (std::size_t first = 0; first < targets.size(); first += n_lanes) {
    Block<L> block{};
    for (int c = 0; c < 3; ++c) {
      block.x[c] = lanes_from(targets.x[c], first);
      block.N[c] = lanes_from(targets.N[c], first);
    }
    add_pairs(
        block, sources.size(), [&](int c, std::size_t j) { return sources.x[c][j]; },
        [&](int c, std::size_t j) { return sources.N[c][j]; });
    store(block, std::identity(), first, sums);
  }
  return sums;
}

Moving<PairSums> sum_pairs(const Moving<SurfacePoints>& targets, const Moving<SurfacePoints>& sources) {
  Moving<PairSums> sums{no_sums(targets.at.size()), no_sums(targets.at.size())};
  for (std::size_t first = 0; first < targets.at.size(); first += n_lanes) {
    Block<Rated> block{};
    for (int c = 0; c < 3; ++c) {
      block.x[c] = {lanes_from(targets.at.x[c], first), lanes_from(targets.rate.x[c], first)};
      block.N[c] = {lanes_from(targets.at.N[c], first), lanes_from(targets.rate.N[c], first)};
    }
    add_pairs(
        block, sources.at.size(),
        [&](int c, std::size_t j) {
          return Rated{sources.at.x[c][j], sources.rate.x[c][j]};
        },
        [&](int c, std::size_t j) {
          return Rated{sources.at.N[c][j], sources.rate.N[c][j]};
        });
    store(
        block, [](const Rated& a) { return a.value; }, first, sums.at);
    store(
        block, [](const Rated& a) { return a.rate; }, first, sums.rate);
  }
  return sums;
}

}  // namespace pseudorigid::gravity
