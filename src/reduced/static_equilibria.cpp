#include "reduced/static_equilibria.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "mechanics/core/principal_axes.h"
#include "mechanics/equilibria/morse_count.h"

namespace pseudorigid::reduced {
namespace {

/// A compressible body with a volume ratio of at most this bound counts as collapsed. Laws that admit such small ratios
/// have critical points at det Q = 0, which are not deformations.
constexpr double collapsed = 1e-8;

Eigen::VectorXd column_of(const Eigen::Matrix3d& A) { return A.reshaped(); }
Eigen::Matrix3d basis_matrix(Eigen::Index k) { return Eigen::Matrix<double, 9, 1>::Unit(k).reshaped(3, 3); }

/// A random rotation, uniformly distributed, from three random numbers in [0, 1) (Shoemake, Graphics Gems III, 1992).
Eigen::Matrix3d uniform_rotation(const std::function<double()>& uniform) {
  const double u = uniform(), a = 2 * std::numbers::pi * uniform(), b = 2 * std::numbers::pi * uniform();
  const double p = std::sqrt(1 - u), q = std::sqrt(u);
  return Eigen::Quaterniond(p * std::sin(a), p * std::cos(a), q * std::sin(b), q * std::cos(b)).toRotationMatrix();
}

/// The four rotations R at which P̄:R is critical, with the nominal traction P̄. With P̄ = U diag(σ) Vᵀ, they are the
/// matrices R = U diag(±1) Vᵀ with det R = 1. If entries of σ are equal, there are more critical rotations.
std::vector<Eigen::Matrix3d> critical_rotations(const Eigen::Matrix3d& P) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(P, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant() > 0 ? 1 : -1;
  std::vector<Eigen::Matrix3d> rotations;
  for (const Eigen::Vector3d& s : {Eigen::Vector3d(1, 1, 1), {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}})
    rotations.emplace_back(svd.matrixU() * (sign * s).asDiagonal() * svd.matrixV().transpose());
  return rotations;
}

/// The Euclidean norm |ln S| of the three logarithms of the singular values S of Q.
double log_stretch(const Eigen::Matrix3d& Q) { return mechanics::singular_values(Q).array().log().matrix().norm(); }

}  // namespace

mechanics::Status StaticLandscape::admissible(const Eigen::Matrix3d& Q) const {
  const double J = Q.determinant();
  if (!(J > (incompressible_ ? 0 : collapsed)) || !std::isfinite(J))
    return mechanics::Status::failure("the body is turned inside out, collapsed or not finite");
  if (!materials::admits(potential_, materials::to_tensor(Q)))
    return mechanics::Status::failure(materials::beyond_limit(materials::limit_of(potential_)));
  return {};
}

mechanics::Status StaticLandscape::gradient(const Vector& q, Vector& dV) const {
  if (mechanics::Status status = admissible(matrix(q)); !status) return status;
  dV = column_of(potential_.gradient(matrix(q)));
  if (!dV.allFinite()) return mechanics::Status::failure("the force on the body is not finite");
  return {};
}

mechanics::Status StaticLandscape::constraint(const Vector& q, Vector& g) const {
  g.resize(n_constraints());
  const double J = matrix(q).determinant();
  if (!(J > 0) || !std::isfinite(J)) return mechanics::Status::failure("the body is turned inside out or not finite");
  if (incompressible_) g[0] = std::log(J);
  return {};
}

void StaticLandscape::constraint_gradient(const Vector& q, Matrix& G) const {
  G.resize(n_constraints(), 9);
  if (incompressible_) G.row(0) = column_of(matrix(q).inverse().transpose()).transpose();
}

mechanics::Status StaticLandscape::hessian(const Vector& q, const Vector& lambda, Matrix& H) const {
  const Eigen::Matrix3d Q = matrix(q);
  if (mechanics::Status status = admissible(Q); !status) return status;
  const Eigen::Matrix3d inverse_transposed = Q.inverse().transpose();
  H.resize(9, 9);
  for (Eigen::Index k = 0; k < 9; ++k) {
    const Eigen::Matrix3d E = basis_matrix(k);
    Eigen::Matrix3d column = potential_.second_derivative(Q, E);
    if (incompressible_) column += lambda[0] * inverse_transposed * E.transpose() * inverse_transposed;
    H.col(k) = column_of(column);
  }
  H = (0.5 * (H + H.transpose())).eval();
  if (!H.allFinite()) return mechanics::Status::failure("the second derivative of the potential is not finite");
  return {};
}

void StaticLandscape::mass(const Vector&, Matrix& M) const {
  M.resize(9, 9);
  for (Eigen::Index k = 0; k < 9; ++k) M.col(k) = column_of(basis_matrix(k) * body_.E0);
}

mechanics::Status StaticLandscape::damping(const Vector& q, Matrix& C) const {
  C.setZero(9, 9);
  for (Eigen::Index k = 0; k < 9; ++k) {
    Eigen::Matrix3d force = Eigen::Matrix3d::Zero();
    dissipation_.add_force(body_, matrix(q), basis_matrix(k), force);
    C.col(k) = -column_of(force);
  }
  return {};
}

/// The slope dV/ds at Q = R₁ exp(s diag(d)) R₂ with |d| = 1. The result is infinite if the law does not admit Q.
/// `direction` contains the quaternions of R₁ and R₂, each of any length, and a vector of any length along d. On SL(3),
/// the mean of this vector is first subtracted from its entries.
double StaticLandscape::outward_slope(double s, const Eigen::VectorXd& direction) const {
  const auto rotation = [&](Eigen::Index first) {
    return Eigen::Quaterniond(Eigen::Vector4d(direction.segment<4>(first))).normalized().toRotationMatrix();
  };
  Eigen::Vector3d d = direction.tail<3>();
  if (incompressible_) d.array() -= d.mean();
  d.normalize();
  const Eigen::Vector3d S = (s * d).array().exp();
  const Eigen::Matrix3d R1 = rotation(0), R2 = rotation(4), Q = R1 * S.asDiagonal() * R2;
  if (!materials::admits(potential_, materials::to_tensor(Q))) return HUGE_VAL;  // the energy V is infinite at Q
  return potential_.gradient(Q).cwiseProduct(R1 * S.cwiseProduct(d).asDiagonal() * R2).sum();
}

bool StaticLandscape::rises_at(double s) const {
  constexpr int n_descents = 64, n_steps = 60;
  std::mt19937_64 generator(1);
  const auto irregular = [&] {  // random numbers in [−1, 1), the same on every machine
    return Eigen::VectorXd(
        Eigen::VectorXd::NullaryExpr(11, [&] { return 2 * static_cast<double>(generator() >> 11) * 0x1p-53 - 1; }));
  };
  for (int descent = 0; descent < n_descents; ++descent) {
    Eigen::VectorXd at = irregular();
    double slope = outward_slope(s, at), size = 0.5;
    for (int step = 0; step < n_steps; ++step) {
      const Eigen::VectorXd next = at + size * irregular();
      const double found = outward_slope(s, next);
      size *= found < slope ? 1.5 : 0.9;
      if (found < slope) slope = found, at = next;
      if (!(slope > 0)) return false;
    }
  }
  return true;
}

bool misses_equilibria(const StaticLandscape& landscape, const std::vector<mechanics::CriticalPoint>& points) {
  constexpr int betti[] = {1, 1, 1, 1};
  std::vector<int> indices;
  double farthest = 1;
  for (const mechanics::CriticalPoint& p : points) {
    if (p.nullity > 0) return false;
    indices.push_back(p.morse_index);
    farthest = std::max(farthest, log_stretch(StaticLandscape::matrix(p.q)));
  }
  const int dimension = landscape.n_coordinates() - landscape.n_constraints();
  if (mechanics::obeys_morse(indices, dimension, betti)) return false;
  return landscape.rises_at(1.5 * farthest) || landscape.rises_at(3 * farthest);
}

mechanics::CriticalPointSearch static_search(bool incompressible, const Eigen::Matrix3d& nominal_traction,
                                             int n_starts) {
  constexpr double spread = 1.5;
  mechanics::CriticalPointSearch search{.center = column_of(Eigen::Matrix3d::Identity()), .n_starts = n_starts};
  std::vector<Eigen::Matrix3d> first;
  if (!nominal_traction.isZero(0)) first = critical_rotations(nominal_traction);
  search.start = [=, next = std::size_t{0}](const std::function<double()>& uniform) mutable {
    if (next < first.size()) return column_of(first[next++]);
    Eigen::Vector3d s;
    for (double& entry : s) entry = spread * (2 * uniform() - 1);
    if (incompressible) s.array() -= s.mean();
    const Eigen::Matrix3d R = uniform_rotation(uniform);
    return column_of(R * s.array().exp().matrix().asDiagonal() * uniform_rotation(uniform));
  };
  return search;
}

}  // namespace pseudorigid::reduced
