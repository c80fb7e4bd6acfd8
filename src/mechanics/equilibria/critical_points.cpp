#include "mechanics/equilibria/critical_points.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::mechanics {
namespace {

/// The search of critical_points.h. V is the potential energy, g the constraint with G = Dg, λ the multiplier, and δ
/// the change of (q, λ) in a step of Newton's iteration.
class CriticalPointFinder {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  CriticalPointFinder(const AnyLandscape& landscape, const CriticalPointSearch& search)
      : landscape_(landscape), search_(search), periods_(landscape.periods()), generator_(search.seed) {
    if (search_.center.size() == 0) search_.center = Vector::Zero(landscape.n_coordinates());
  }

  Status run(CriticalPoints& found) {
    if (search_.center.size() != landscape_.n_coordinates())
      return Status::failure("the centre of the search has " + std::to_string(search_.center.size()) +
                             " coordinates in place of " + std::to_string(landscape_.n_coordinates()));
    found = {};
    if (Status status = try_starts(search_.n_starts, found); !status) return status;
    const auto misses_points = [&] { return search_.misses_points && search_.misses_points(found.points); };
    while ((found.misses_points = misses_points()) && found.n_starts < search_.n_starts_at_most)
      if (Status status = try_starts(std::min(search_.n_starts, search_.n_starts_at_most - found.n_starts), found);
          !status)
        return status;
    sort(found.points);
    return {};
  }

 private:
  /// Runs Newton's iteration from n_more further starting points. Adds the new critical points and the numbers of
  /// starting points to `found`. Fails if describe_critical_point fails.
  Status try_starts(int n_more, CriticalPoints& found) {
    for (const int end = found.n_starts + n_more; found.n_starts < end; ++found.n_starts) {
      Vector q = found.n_starts == 0 ? search_.center : random_start(), lambda;
      if (!newton(q, lambda)) continue;  // the iteration does not converge from this start
      ++found.n_converged;
      q = canonical(q);
      CriticalPoint p;
      const Matrix C = search_.added_damping ? search_.added_damping(q) : Matrix::Zero(q.size(), q.size());
      if (Status status = describe_critical_point(landscape_, q, lambda, C, p); !status) return status;
      const bool known = std::any_of(found.points.begin(), found.points.end(),
                                     [&](const CriticalPoint& other) { return same(p, other); });
      if (!known) found.points.push_back(std::move(p));
    }
    return {};
  }

  static constexpr int max_iterations = 200, max_halvings = 20;
  static constexpr double converged = 1e-12;  // bound of |r|, divided by `scale` of initial_multiplier
  /// Two solutions count as one point if their relative difference is below this bound. Solutions for the same point
  /// usually differ by much less.
  static constexpr double same_place = 1e-6;
  static constexpr double singular = 1e-10;  // bound of zero pivots in Newton's matrix, relative to the largest pivot

  /// Moves q to a critical point and sets λ to its multiplier. Returns false if the iteration does not converge from q,
  /// or if a derivative, the constraint or Newton's step fails. q and λ are then not valid.
  bool newton(Vector& q, Vector& lambda) const {
    const Eigen::Index n = q.size();
    Vector r;
    lambda = Vector::Zero(landscape_.n_constraints());
    double scale = 0;
    if (!initial_multiplier(q, lambda, scale) || !residual(q, lambda, r)) return false;
    for (int i = 0; i < max_iterations; ++i) {
      const double norm = r.norm();
      Vector step;
      if (norm == 0) return true;
      if (!newton_step(q, lambda, r, step)) return false;
      double part = 1;
      Vector q_new, lambda_new;
      for (int k = 0; k <= max_halvings; ++k, part /= 2) {
        q_new = q + part * step.head(n);
        lambda_new = lambda + part * step.tail(lambda.size());
        if (residual(q_new, lambda_new, r) && r.norm() < (1 - 1e-4 * part) * norm) break;
        if (k == max_halvings || norm <= converged * scale) return norm <= converged * scale;
      }
      q = q_new;
      lambda = lambda_new;
    }
    return false;
  }

  /// Sets `step` to the solution δ of Newton's equation for the residual r (critical_points.h). Returns false if the
  /// Hessian fails or δ is not finite.
  bool newton_step(const Vector& q, const Vector& lambda, const Vector& r, Vector& step) const {
    const Eigen::Index n = q.size(), n_constraints = lambda.size();
    Matrix H, G;
    if (!landscape_.hessian(q, lambda, H)) return false;
    landscape_.constraint_gradient(q, G);
    Matrix J(n + n_constraints, n + n_constraints);
    J << H, -G.transpose(), G, Matrix::Zero(n_constraints, n_constraints);
    step = -least_squares(J, r, singular);
    return step.allFinite();
  }

  /// Sets r = (∇V − Gᵀλ, g). Returns false if a derivative or the constraint fails or is not finite.
  bool residual(const Vector& q, const Vector& lambda, Vector& r) const {
    Vector dV, g;
    Matrix G;
    if (!landscape_.gradient(q, dV) || !landscape_.constraint(q, g)) return false;
    landscape_.constraint_gradient(q, G);
    r.resize(dV.size() + g.size());
    r << dV - G.transpose() * lambda, g;
    return r.allFinite();
  }

  /// Sets λ such that |∇V − Gᵀλ| is smallest, and sets `scale` to the norm of the gradient or of the Hessian, whichever
  /// is larger. Returns false if a derivative fails or is not finite.
  bool initial_multiplier(const Vector& q, Vector& lambda, double& scale) const {
    Vector dV;
    Matrix G;
    if (!landscape_.gradient(q, dV)) return false;
    landscape_.constraint_gradient(q, G);
    if (G.rows() > 0) lambda = least_squares(G.transpose(), dV, 1e-14);
    Matrix H;
    if (!landscape_.hessian(q, lambda, H)) return false;
    scale = std::max(dV.norm(), H.norm());
    return std::isfinite(scale);
  }

  Vector random_start() {
    const auto uniform = [&] {
      return static_cast<double>(generator_() >> 11) * 0x1p-53;
    };  // unlike std::uniform_real_distribution, gives the same numbers on every platform
    if (search_.start) return search_.start(uniform);
    Vector q = search_.center;
    for (Eigen::Index i = 0; i < q.size(); ++i)
      q[i] += (periods_[i] > 0 ? periods_[i] / 2 : search_.radius) * (2 * uniform() - 1);
    return q;
  }

  /// Maps each coordinate with a period P to (−P/2, P/2]. A value that exceeds −P/2 by less than `same_place` · P/2 is
  /// increased by P, so that points near this boundary get equal coordinates.
  Vector canonical(Vector q) const {
    for (Eigen::Index i = 0; i < q.size(); ++i)
      if (const double P = periods_[i]; P > 0) {
        q[i] = std::remainder(q[i], P);
        if (q[i] < -P / 2 * (1 - same_place)) q[i] += P;
      }
    return q;
  }

  /// Returns true if a and b have the same coordinates modulo the periods, or are regarded as points of one orbit of
  /// the symmetries (critical_points.h).
  bool same(const CriticalPoint& a, const CriticalPoint& b) const {
    const double scale = 1 + a.hessian_eigenvalues.cwiseAbs().maxCoeff();
    if (a.nullity > 0 && a.nullity == b.nullity && std::abs(a.V - b.V) < same_place * scale &&
        (a.hessian_eigenvalues - b.hessian_eigenvalues).norm() < same_place * scale)
      return true;
    Vector d = a.q - b.q;
    for (Eigen::Index i = 0; i < d.size(); ++i)
      if (periods_[i] > 0) d[i] = std::remainder(d[i], periods_[i]);
    return d.norm() < same_place * (1 + a.q.norm());
  }

  /// Sorts the points by increasing V. Points with V equal up to same_place are then sorted by their coordinates.
  static void sort(std::vector<CriticalPoint>& points) {
    std::ranges::sort(points, {}, &CriticalPoint::V);
    for (auto first = points.begin(); first != points.end();) {
      const auto last = std::find_if(first, points.end(), [&](const auto& p) { return p.V - first->V > same_place; });
      std::sort(first, last, [](const CriticalPoint& a, const CriticalPoint& b) {
        return std::lexicographical_compare(a.q.begin(), a.q.end(), b.q.begin(), b.q.end());
      });
      first = last;
    }
  }

  const AnyLandscape& landscape_;
  CriticalPointSearch search_;
  Vector periods_;
  std::mt19937_64 generator_;
};

/// Returns the mass matrix M at q, which is used as the matrix of a damping force −M v. M is positive definite, so
/// every system with this force is strongly dissipative.
Eigen::MatrixXd unit_damping(const AnyLandscape& landscape, const Eigen::VectorXd& q) {
  Eigen::MatrixXd M;
  landscape.mass(q, M);
  return M;
}

/// Replaces the rates and directions of the point by their values without added damping. Fails if
/// describe_critical_point fails.
Status find_own_rates(const AnyLandscape& landscape, CriticalPoint& p) {
  CriticalPoint undamped;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(p.q.size(), p.q.size());
  Status status = describe_critical_point(landscape, p.q, p.lambda, none, undamped);
  if (!status) return status;
  p.rates = undamped.rates;
  p.directions = undamped.directions;
  return status;
}

}  // namespace

Status find_critical_points(const AnyLandscape& landscape, const CriticalPointSearch& search, CriticalPoints& found) {
  return CriticalPointFinder(landscape, search).run(found);
}

Status find_equilibria(const AnyLandscape& landscape, bool dissipative, CriticalPointSearch search,
                       CriticalPoints& found) {
  if (!dissipative) search.added_damping = [&](const Eigen::VectorXd& q) { return unit_damping(landscape, q); };
  Status status = find_critical_points(landscape, search, found);
  if (dissipative) return status;
  for (CriticalPoint& point : found.points)
    if (status) status = find_own_rates(landscape, point);
  return status;
}

}  // namespace pseudorigid::mechanics
