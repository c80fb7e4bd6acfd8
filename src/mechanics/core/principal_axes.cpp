#include "mechanics/core/principal_axes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace pseudorigid::mechanics {
namespace detail::axes {

Eigen::Matrix3d product(const Eigen::Matrix3d& M, const Eigen::Matrix3d& N) {
  Eigen::Matrix3d P;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) P(i, j) = M(i, 0) * N(0, j) + M(i, 1) * N(1, j) + M(i, 2) * N(2, j);
  return P;
}

namespace {

double dot(const Eigen::Vector3d& u, const Eigen::Vector3d& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }

/// Returns the Gram matrix WᵀW of the columns of W.
Symmetric gram(const Eigen::Matrix3d& W) {
  const auto dot = [&W](int i, int j) { return W(0, i) * W(0, j) + W(1, i) * W(1, j) + W(2, i) * W(2, j); };
  return {{dot(0, 0), dot(1, 1), dot(2, 2)}, {dot(1, 2), dot(2, 0), dot(0, 1)}};
}

/// Returns true if the cosine of the angle between any two columns is at most `bound` in absolute value, or NaN. G is
/// the Gram matrix of the columns.
bool orthogonal(const Symmetric& G, double bound) {
  const Eigen::Vector3d &square = G.diagonal, &product = G.opposite;
  const auto below = [&](int i, int j, int k) {
    return !(product[k] * product[k] > bound * bound * (square[i] * square[j]));
  };
  return below(0, 1, 2) && below(1, 2, 0) && below(2, 0, 1);
}

}  // namespace

PlaneRotation diagonalizing(double alpha, double beta, double gamma) {
  constexpr double tiny = 1e-150;  // avoids 0/0 for δ = γ = 0
  const double delta = beta - alpha, size = std::abs(delta) + tiny, h = std::sqrt(size * size + 4 * gamma * gamma);
  const double cosine = std::sqrt((h + size) / (2 * h));
  return {cosine, cosine * (std::copysign(2.0, delta) * gamma / (h + size))};
}

double cosine_of_third(double q) {
  const double c = 0.8660254037844386 + q * (0.1666666666666667 - 0.0326920704511053 * q);
  const double f = (4 * c * c - 3) * c - q, slope = 12 * c * c - 3, curvature = 24 * c;
  return c - 2 * f * slope / (2 * slope * slope - f * curvature);
}

namespace {

/// The matrix B = C − m Id, m = ⅓ tr C, with |B|² = 6p², and its determinant. `far` is 2 cos(⅓ arccos q), so that the
/// eigenvalue of B farthest from the other two is ±p `far`.
struct Deviator {
  double m, p, determinant, far;
  Symmetric B;

  explicit Deviator(const Symmetric& C) : m((C.diagonal[0] + C.diagonal[1] + C.diagonal[2]) / 3) {
    B = {{C.diagonal[0] - m, C.diagonal[1] - m, C.diagonal[2] - m}, C.opposite};
    const auto& [b, c] = B;
    const double p_squared = (dot(b, b) + 2 * dot(c, c)) / 6;
    p = std::sqrt(p_squared);
    determinant =
        (b[0] * (b[1] * b[2] - c[0] * c[0]) - b[1] * (c[1] * c[1])) + (2 * (c[0] * c[1]) * c[2] - b[2] * (c[2] * c[2]));
    far = 2 * cosine_of_third(std::abs(determinant) / (2 * p_squared * p));
  }
};

}  // namespace

Eigen::Matrix3d eigenvectors(const Symmetric& C) {
  const Deviator deviator(C);
  const auto& [b, c] = deviator.B;
  const double lambda = std::copysign(deviator.p * deviator.far, deviator.determinant);

  const Eigen::Vector3d n(b[0] - lambda, b[1] - lambda, b[2] - lambda);
  const Eigen::Vector3d minors(n[1] * n[2] - c[0] * c[0], n[2] * n[0] - c[1] * c[1], n[0] * n[1] - c[2] * c[2]);
  const double m01 = c[0] * c[1] - c[2] * n[2], m02 = c[0] * c[2] - c[1] * n[1], m12 = c[1] * c[2] - c[0] * n[0];
  const Eigen::Vector3d v = minors[0] > std::max(minors[1], minors[2]) ? Eigen::Vector3d(minors[0], m01, m02)
                            : minors[1] > minors[2]                    ? Eigen::Vector3d(m01, minors[1], m12)
                                                                       : Eigen::Vector3d(m02, m12, minors[2]);

  // The reflection that maps v to the third axis maps the first and second axis to a basis of the plane normal to v.
  const double length = std::sqrt(dot(v, v)), signed_length = std::copysign(length, v[2]), w = v[2] + signed_length;
  const double e = 1 / (signed_length * w), e0 = e * v[0], e1 = e * v[1];
  Eigen::Vector3d u0(1 - e0 * v[0], -e0 * v[1], -e0 * w), u1(-e1 * v[0], 1 - e1 * v[1], -e1 * w);
  const Eigen::Vector3d B_u1 = deviator.B * u1;
  diagonalizing(dot(u0, deviator.B * u0), dot(u1, B_u1), dot(u0, B_u1)).apply(u0, u1);
  Eigen::Matrix3d U;
  U << u0, u1, v / length;
  return U;
}

namespace {

/// Returns the Cayley rotation (Id − W)⁻¹(Id + W), with the antisymmetric matrix W of the map x ↦ x × θ/2.
Eigen::Matrix3d cayley(const Eigen::Vector3d& theta) {
  const Eigen::Vector3d w(theta[0] / 2, theta[1] / 2, theta[2] / 2);
  const double f = 2 / (1 + dot(w, w)), d = f - 1;
  const Eigen::Vector3d g(f * w[0], f * w[1], f * w[2]);
  const double g01 = g[0] * w[1], g02 = g[0] * w[2], g12 = g[1] * w[2];
  Eigen::Matrix3d R;
  R << d + g[0] * w[0], g01 + g[2], g02 - g[1],  //
      g01 - g[2], d + g[1] * w[1], g12 + g[0],   //
      g02 + g[1], g12 - g[0], d + g[2] * w[2];
  return R;
}

/// Makes one sweep of plane rotations of the columns of W, and applies the same rotations to the columns of U. A pair
/// of columns of W is skipped if the absolute cosine of its angle is at most `tolerance`.
void sweep(Eigen::Matrix3d& W, Eigen::Matrix3d& U, double tolerance) {
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
    Eigen::Vector3d u = W.col(i), v = W.col(j), u_of_U = U.col(i), v_of_U = U.col(j);
    const double alpha = u.squaredNorm(), beta = v.squaredNorm(), gamma = u.dot(v);
    if (!(gamma * gamma > tolerance * tolerance * (alpha * beta))) continue;
    const auto rotation = diagonalizing(alpha, beta, gamma);
    rotation.apply(u, v);
    rotation.apply(u_of_U, v_of_U);
    W.col(i) = u, W.col(j) = v, U.col(i) = u_of_U, U.col(j) = v_of_U;
  }
}

/// Returns a number that is at least x = s λ for all eigenvalues λ of FᵀF, with the sign s = ±1. If det B has the sign
/// s, the largest x is s m + 2pc, with c = cos(⅓ arccos q). Otherwise it is s m + p(c + √3 √(1 − c²)). The margins are
/// larger than the error of cosine_of_third and the round-off.
double bound_of_eigenvalues(const Eigen::Matrix3d& F, double s) {
  constexpr double margin_of_cosine = 1e-7, margin = 1e-14, too_small = 1e-6;
  const Deviator deviator(gram(F));
  const double c = std::min(1.0, deviator.far / 2);
  const double of_p = deviator.p < too_small * deviator.m ? 2
                      : s * deviator.determinant > 0      ? 2 * c + margin_of_cosine
                                                          : c + std::sqrt(3 * (1 - c * c + margin_of_cosine));
  return (s + margin) * deviator.m + of_p * deviator.p;
}

}  // namespace
}  // namespace detail::axes

PrincipalAxes principal_axes(const Eigen::Matrix3d& F) {
  constexpr double round_off = 2 * std::numeric_limits<double>::epsilon(), its_root = 1e-8, small = 0.1;
  constexpr int max_turns = 20;
  Eigen::Matrix3d W = F.transpose(), U = Eigen::Matrix3d::Identity();
  auto G = detail::axes::gram(W);
  if (!detail::axes::orthogonal(G, round_off)) {
    U = detail::axes::eigenvectors(G);
    W = detail::axes::product(F.transpose(), U);
    for (int turn = 0; turn < max_turns; ++turn) {
      G = detail::axes::gram(W);
      if (detail::axes::orthogonal(G, round_off)) break;
      const Eigen::Vector3d &square = G.diagonal, &product = G.opposite;
      const auto angle = [&](int i, int j, int k) {  // the angle is 0 if the product is 0; this avoids 0/0
        return product[k] == 0 ? 0 : product[k] / (square[j] - square[i]);
      };
      const Eigen::Vector3d theta(angle(1, 2, 0), angle(2, 0, 1), angle(0, 1, 2));
      const double largest = theta.cwiseAbs().maxCoeff();
      if (largest < small) {
        const Eigen::Matrix3d R = detail::axes::cayley(theta);
        U = detail::axes::product(U, R);
        W = detail::axes::product(W, R);
        // The remaining angles are of order theta². Here they are round-off.
        if (largest < its_root && detail::axes::orthogonal(G, its_root)) break;
      } else {
        detail::axes::sweep(W, U, round_off);
      }
    }
  }
  const auto length = [&W](int i) { return std::sqrt(W(0, i) * W(0, i) + W(1, i) * W(1, i) + W(2, i) * W(2, i)); };
  return {U, W.transpose(), {length(0), length(1), length(2)}};
}

Eigen::Vector3d singular_values(const Eigen::Matrix3d& F) {
  Eigen::Vector3d sigma = principal_axes(F).a;
  std::sort(sigma.begin(), sigma.end(), std::greater<>());
  return sigma;
}

double largest_singular_value_bound(const Eigen::Matrix3d& F) {
  return std::sqrt(detail::axes::bound_of_eigenvalues(F, 1));
}
double least_singular_value_bound(const Eigen::Matrix3d& F) {
  return std::sqrt(std::max(0.0, -detail::axes::bound_of_eigenvalues(F, -1)));
}

}  // namespace pseudorigid::mechanics
