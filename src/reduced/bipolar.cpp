#include "reduced/bipolar.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mechanics/core/principal_axes.h"

namespace pseudorigid::reduced {
namespace detail {

void exchange_axes(Bipolar& b, int i, int j) {
  b.T.row(i).swap(b.T.row(j));
  b.S.row(i).swap(b.S.row(j));
  std::swap(b.a[i], b.a[j]);
}

void reverse_axis(Bipolar& b, int i) {
  b.T.row(i) *= -1;
  b.S.row(i) *= -1;
}

}  // namespace detail

namespace {

using detail::exchange_axes, detail::reverse_axis;

/// The scalar product of row i of b.T with row j of before.T, plus that of row i of b.S with row j of before.S. The sum
/// is between −2 and 2. It is negative if axis i is nearer to the reversed axis j.
double overlap(const Bipolar& b, int i, const Bipolar& before, int j) {
  return b.T.row(i).dot(before.T.row(j)) + b.S.row(i).dot(before.S.row(j));
}

/// Rotates the frames of coincident axes to the frames nearest to `before`. If two entries of A are equal to round-off,
/// their rows in T and S may be rotated by a common angle. TᵀAS does not change. If three entries are equal, the pairs
/// are rotated in turn, and a few sweeps are necessary.
void turn_coincident_axes(Bipolar& b, const Bipolar& before) {
  constexpr int n_sweeps = 8;
  constexpr double round_off = 4e-15;
  for (int sweep = 0; sweep < n_sweeps; ++sweep)
    for (const auto& [i, j] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}}) {
      if (std::abs(b.a[i] - b.a[j]) > round_off * b.a[i]) continue;
      const double x = overlap(b, i, before, i) + overlap(b, j, before, j);
      const double y = overlap(b, j, before, i) - overlap(b, i, before, j), length = std::hypot(x, y);
      if (length == 0) continue;
      for (Eigen::Matrix3d* R : {&b.T, &b.S}) {
        const Eigen::RowVector3d u = R->row(i), v = R->row(j);
        R->row(i) = (x * u + y * v) / length;
        R->row(j) = (x * v - y * u) / length;
      }
    }
}

}  // namespace

Bipolar decompose(const Eigen::Matrix3d& Q) {
  const mechanics::PrincipalAxes axes = mechanics::principal_axes(Q);
  Bipolar b{axes.U.transpose(), axes.a.cwiseInverse().asDiagonal() * axes.A, axes.a};
  for (const auto& [i, j] : {std::array{0, 1}, std::array{0, 2}, std::array{1, 2}})
    if (b.a[i] < b.a[j]) exchange_axes(b, i, j);
  if (b.T.determinant() < 0) reverse_axis(b, 2);
  return b;
}

Bipolar decompose(const Eigen::Matrix3d& Q, const Bipolar& before) {
  constexpr std::array<std::array<int, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  const Bipolar falling = decompose(Q);
  Bipolar nearest = falling;
  double best_agreement = -HUGE_VAL;
  for (const auto& order : orders) {
    Bipolar b;
    Eigen::Vector3d agreement;
    for (int i = 0; i < 3; ++i) {
      b.T.row(i) = falling.T.row(order[i]);
      b.S.row(i) = falling.S.row(order[i]);
      b.a[i] = falling.a[order[i]];
      agreement[i] = overlap(b, i, before, i);
      if (agreement[i] < 0) reverse_axis(b, i);
    }
    agreement = agreement.cwiseAbs().eval();
    if (b.T.determinant() < 0) {
      int weakest = 0;
      agreement.minCoeff(&weakest);
      reverse_axis(b, weakest);
      agreement[weakest] *= -1;
    }
    if (agreement.sum() <= best_agreement) continue;
    best_agreement = agreement.sum();
    nearest = b;
  }
  turn_coincident_axes(nearest, before);
  return nearest;
}

BipolarRates rates(const Bipolar& b, const Eigen::Matrix3d& Qdot) {
  BipolarRates r{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero(), {}, b.T * Qdot * b.S.transpose()};
  r.a_rate = r.u.diagonal();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double difference = (b.a[j] - b.a[i]) * (b.a[j] + b.a[i]);
      if (std::abs(difference) <= 1e-14 * (b.a[i] * b.a[i] + b.a[j] * b.a[j])) continue;
      r.Omega(i, j) = -(b.a[j] * r.u(i, j) + b.a[i] * r.u(j, i)) / difference;
      r.Lambda(i, j) = -(b.a[i] * r.u(i, j) + b.a[j] * r.u(j, i)) / difference;
    }
  return r;
}

}  // namespace pseudorigid::reduced
