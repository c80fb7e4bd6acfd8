/// The sums over pairs of surface points of surface_gravity.h, compiled for several instruction sets
/// (mechanics/core/kernel_builds.h). The target i and the source j have the positions x_i, x_j and the area vectors
/// N_i, N_j. With d = x_i − x_j, a = d·N_i and b = d·N_j, the sums are
///
///   g_i = Σ_j [(N_i b + a N_j)/|d| − a b d/|d|³],   h_i = Σ_j d b/|d|,   e_i = N_i·h_i.

#include "gravity/pair_kernels.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "mechanics/core/lanes.h"

namespace pseudorigid::gravity {
namespace {

using L = mechanics::Lanes<mechanics::native_lanes>;
constexpr std::size_t n_lanes = mechanics::native_lanes;

/// A constant that is added to squared distances. It is far below the squared distance of two different points. The
/// constant makes the inverse distance of a point to itself finite. Such a pair adds 0, because all its terms have the
/// factor d = 0.
constexpr double no_distance = 1e-36;

/// A number with its time derivative, in each lane.
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

/// A block of targets, one in each lane, with their positions x, area vectors N and sums. The terms Σ_j (b/|d|) N_i are
/// not in `g`. Their factor Σ_j b/|d| is in `along_N`, so the complete sum is g_i = g + along_N N_i.
template <class S>
struct Block {
  S x[3], N[3], along_N, g[3], h[3];
};

/// Adds the terms of n sources to the sums of a block. For source j, point(c, j) and area(c, j) are component c of its
/// position and of its area vector.
template <class S, class Point, class Area>
void add_pairs(Block<S>& block, std::size_t n, const Point& point, const Area& area) {
  Block<S> s = block;  // a local copy, which the compiler keeps in registers
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

/// Returns the values from number `first` on, one in each lane. Lanes after the last value repeat this value.
L lanes_from(const std::vector<double>& values, std::size_t first) {
  return L::of([&](int l) { return values[std::min(first + l, values.size() - 1)]; });
}

/// Writes the lanes to `values`, from number `first` on, and omits the lanes after the last value.
void store(const L& lanes, std::vector<double>& values, std::size_t first) {
  for (std::size_t l = 0; l < n_lanes && first + l < values.size(); ++l) values[first + l] = lanes[static_cast<int>(l)];
}

/// Computes the sums g, h and e of the targets of a block, and writes them to `sums`, from the target number `first`
/// on. `part` selects the value or the time derivative.
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

/// Returns the block of the targets from number `first` on, with sums of 0. Lanes after the last target repeat this
/// target.
Block<L> block_at(const SurfacePoints& points, std::size_t first) {
  Block<L> block{};
  for (int c = 0; c < 3; ++c) {
    block.x[c] = lanes_from(points.x[c], first);
    block.N[c] = lanes_from(points.N[c], first);
  }
  return block;
}

/// The sums Σ a/|d|, Σ b/|d| and Σ ab/|d|³ (the members a, b and w) over the images of one point. The symbols d, a and
/// b are those of PairWithImages.
struct ImageSums {
  L a = 0.0, b = 0.0, w = 0.0;
};

/// Sums over the pairs of a block of points x, one in each lane, with a point y and its mirror images. Each distance is
/// used for the sums of x and of y. The set k of reflections maps y to the image R_k y, with R_k = diag(s_k1, s_k2,
/// s_k3) and s_kc = −1 for the reflected axes c, otherwise 1. Let d = x − R_k y, a = d·N_x, b = d·R_k N_y and
/// w = ab/|d|³. For the pair of y with the image R_k x, the distance vector is −R_k d, and −b and −a take the places of
/// a and b. Because d_c = x_c − s_kc y_c, two kinds of sums over k are sufficient: Σ_k (…) and, for each axis c, Σ_k
/// s_kc (…). For example,
///
///   Σ_k d_c w_k = x_c Σ_k w_k − y_c Σ_k s_kc w_k,      Σ_k s_kc d_c w_k = x_c Σ_k s_kc w_k − y_c Σ_k w_k.
template <unsigned mirrors>
class PairWithImages {
 public:
  [[gnu::always_inline]] PairWithImages(const L (&x)[3], const L (&N_x)[3], const double (&y)[3],
                                        const double (&N_y)[3]) {
    Parts parts;
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < (mirrors >> c & 1 ? 2 : 1); ++i) {
        const double s = i == 0 ? 1 : -1;
        const L d = x[c] - s * y[c];
        parts.square[c][i] = d * d + (c == 0 ? no_distance : 0.0);
        parts.a[c][i] = d * N_x[c];
        parts.b[c][i] = d * (s * N_y[c]);
      }
    // The fold over k unrolls the loop. Otherwise the compiler would not keep the arrays in registers.
    [&]<int... k>(std::integer_sequence<int, k...>) { (add_image<k>(parts), ...); }
    (std::make_integer_sequence<int, 8>());
  }

  /// Returns the sum Σ_k of the member `term` over the images.
  L sum(L ImageSums::*term) const { return all_.*term; }
  /// Returns the sum Σ_k s_kc of the member `term` over the images.
  L signed_sum(int c, L ImageSums::*term) const {
    return mirrors >> c & 1 ? all_.*term - 2.0 * behind_[c].*term : all_.*term;
  }

 private:
  /// Contributions of each axis to |d|², a and b: [axis][1 if the coordinate of y is reflected along this axis,
  /// otherwise 0].
  struct Parts {
    L square[3][2], a[3][2], b[3][2];
  };

  /// Adds the terms of the image k to the sums if `mirrors` contains all its reflections. Bit c of k is 1 if the image
  /// is reflected along the axis c.
  template <int k>
  [[gnu::always_inline]] void add_image(const Parts& parts) {
    if constexpr ((k & ~mirrors) == 0) {
      const auto of_axes = [](const L(&part)[3][2]) {
        return part[2][k >> 2 & 1] + part[1][k >> 1 & 1] + part[0][k & 1];
      };
      const L inverse = inverse_sqrt(of_axes(parts.square)), a = of_axes(parts.a) * inverse,
              b = of_axes(parts.b) * inverse;
      const auto add_to = [&](ImageSums& sums) {
        sums.a += a;
        sums.b += b;
        sums.w += a * b * inverse;
      };
      add_to(all_);
      for (int c = 0; c < 3; ++c)
        if (k >> c & 1) add_to(behind_[c]);
    }
  }

  ImageSums all_, behind_[3];  ///< behind_[c]: sums over the images with s_kc = −1
};

/// Sums for points whose pairs are computed once for both points. The terms along the vectors N_i and x_i of the point
/// itself are not in `g` and `h`. Their factors are in `along_N` and `along_x`. The complete sums are g_i = g + along_N
/// N_i − along_x x_i and h_i = h + along_N x_i.
struct MutualSums {
  L along_N, along_x, g[3], h[3];

  /// Adds the sum over all lanes of `other` to the lane `lane` of this object, for each member.
  void add_to_lane(int lane, const MutualSums& other) {
    const auto add = [lane](L& to, const L& from) {
      double sum = to[lane];
      for (int l = 0; l < mechanics::native_lanes; ++l) sum += from[l];
      to.set(lane, sum);
    };
    add(along_N, other.along_N);
    add(along_x, other.along_x);
    for (int c = 0; c < 3; ++c) {
      add(g[c], other.g[c]);
      add(h[c], other.h[c]);
    }
  }
};

/// Adds the contributions of the points x and their images to the sums `y` of the point y. Each lane of `y` contains
/// the contributions of one point x.
template <unsigned mirrors>
[[gnu::always_inline]] inline void react(const PairWithImages<mirrors>& pair, const L (&x)[3], const L (&N_x)[3],
                                         MutualSums& y) {
  y.along_N += -pair.sum(&ImageSums::a);
  y.along_x += pair.sum(&ImageSums::w);
  for (int c = 0; c < 3; ++c) {
    y.g[c] += x[c] * pair.signed_sum(c, &ImageSums::w) - N_x[c] * pair.signed_sum(c, &ImageSums::b);
    y.h[c] += x[c] * pair.signed_sum(c, &ImageSums::a);
  }
}

/// Adds the contributions of the point y and its images to the sums `x` of the points x, one point in each lane.
template <unsigned mirrors>
[[gnu::always_inline]] inline void act(const PairWithImages<mirrors>& pair, const double (&y)[3],
                                       const double (&N_y)[3], MutualSums& x) {
  x.along_N += pair.sum(&ImageSums::b);
  x.along_x += pair.sum(&ImageSums::w);
  for (int c = 0; c < 3; ++c) {
    x.g[c] += N_y[c] * pair.signed_sum(c, &ImageSums::a) + y[c] * pair.signed_sum(c, &ImageSums::w);
    x.h[c] += -y[c] * pair.signed_sum(c, &ImageSums::b);
  }
}

/// Returns the sums e, g and h of each point over all points and their images. Bit c of `mirrors` is 1 for a reflection
/// along the axis c. Each pair of points is computed once, except for pairs within a block.
template <unsigned mirrors>
PairSums sum_own_pairs(const SurfacePoints& points) {
  const std::size_t n = points.size();
  // For each point, the contributions of the blocks before the point, lane by lane.
  std::vector<MutualSums> reactions(n, MutualSums{});
  PairSums sums = no_sums(n);
  for (std::size_t first = 0; first < n; first += n_lanes) {
    Block<L> block = block_at(points, first);
    MutualSums own{};
    const std::size_t end = std::min(first + n_lanes, n);
    for (std::size_t j = first; j < n; ++j) {
      const double y[] = {points.x[0][j], points.x[1][j], points.x[2][j]},
                   N_y[] = {points.N[0][j], points.N[1][j], points.N[2][j]};
      const PairWithImages<mirrors> pair(block.x, block.N, y, N_y);
      act(pair, y, N_y, own);
      if (j >= end) react(pair, block.x, block.N, reactions[j]);
    }
    for (std::size_t j = first; j < end; ++j) own.add_to_lane(static_cast<int>(j - first), reactions[j]);
    block.along_N = own.along_N;
    for (int c = 0; c < 3; ++c) {
      block.g[c] = own.g[c] - block.x[c] * own.along_x;
      block.h[c] = own.h[c] + block.x[c] * own.along_N;
    }
    store(block, std::identity(), first, sums);
  }
  return sums;
}

PairSums sum_two_sets(const SurfacePoints& targets, const SurfacePoints& sources) {
  PairSums sums = no_sums(targets.size());
  for (std::size_t first = 0; first < targets.size(); first += n_lanes) {
    Block<L> block = block_at(targets, first);
    add_pairs(
        block, sources.size(), [&](int c, std::size_t j) { return sources.x[c][j]; },
        [&](int c, std::size_t j) { return sources.N[c][j]; });
    store(block, std::identity(), first, sums);
  }
  return sums;
}

PairSums sum_pairs_with_images(const SurfacePoints& points, const std::array<bool, 3>& mirrors) {
  const unsigned set = (mirrors[0] ? 1u : 0u) | (mirrors[1] ? 2u : 0u) | (mirrors[2] ? 4u : 0u);
  return [&]<unsigned... sets>(std::integer_sequence<unsigned, sets...>) {
    PairSums sums;
    ((sets == set ? void(sums = sum_own_pairs<sets>(points)) : void()), ...);
    return sums;
  }
  (std::make_integer_sequence<unsigned, 8>());
}

Moving<PairSums> sum_moving_pairs(const Moving<SurfacePoints>& targets, const Moving<SurfacePoints>& sources) {
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

}  // namespace
}  // namespace pseudorigid::gravity

extern const pseudorigid::gravity::PairKernels PSEUDORIGID_KERNEL_TABLE{
    .sum = pseudorigid::gravity::sum_two_sets,
    .sum_own = pseudorigid::gravity::sum_pairs_with_images,
    .sum_moving = pseudorigid::gravity::sum_moving_pairs};
