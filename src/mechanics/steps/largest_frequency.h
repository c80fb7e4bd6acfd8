#pragma once
/// Largest frequency ω of small motions about a state that are tangent to the constraints g = 0. With the mass M, the
/// force f, G = Dg and the multiplier λ of the motion,
///
///   ω² = max over G u = 0 of  uᵀK u / uᵀM u,     K u = −D_q[f + G(q)ᵀλ] u   (by differences, λ and v fixed).
///
/// The stability limit of a method with the step h bounds hω. If forces dissipate energy, the largest damping rate γ is
///
///   γ = max over G u = 0 of  uᵀC u / uᵀM u,      C u = −D_v f u.
///
/// γ limits the step of a method that finds the velocity by an iteration on the damping. Lanczos' iteration for M⁻¹K or
/// M⁻¹C in the inner product of M gives ω² or γ. The projection
///
///   u ← u − M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹G u,
///
/// makes u tangent to the constraints. Each u is stored together with w = M u, so only M⁻¹ is needed, and ⟨u, u'⟩_M =
/// uᵀw'. If components are held fixed, M⁻¹ may be 0 for them, so that u is 0 in these components. For dense vectors,
/// differences are central, with errors of about 1e-10. For distributed vectors, whose force evaluations are costly,
/// differences are forward, with errors of about 1e-8.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "mechanics/core/constrained_system.h"
#include "mechanics/core/damping.h"
#include "mechanics/core/second_order_field.h"

namespace pseudorigid::mechanics {

/// The frequency ω. If `status` is a failure, ω could not be computed, and `omega` is not valid.
struct [[nodiscard]] FrequencyReport {
  Status status;
  double omega = 0;
};
/// The damping rate γ. If `status` is a failure, γ could not be computed, and `gamma` is not valid.
struct [[nodiscard]] DampingReport {
  Status status;
  double gamma = 0;
};

namespace detail {

/// A displacement u and w = M u.
template <class S>
struct MassPair {
  typename S::Vector u, w;

  void add(double a, const MassPair& x) {
    axpy(a, x.u, u);
    axpy(a, x.w, w);
  }
  void scale_by(double a) {
    scale(a, u);
    scale(a, w);
  }
  double norm() const { return std::sqrt(std::max(0.0, dot(u, w))); }
};

/// Fills x with pseudo-random numbers in [−1, 1). Such a vector has a component along every mode. The numbers are the
/// same at every call, so that results are reproducible. A system with distributed vectors has its own member
/// `fill_irregular`, whose numbers do not depend on the number of ranks.
template <class S>
void fill_irregular(const S& system, typename S::Vector& x) {
  if constexpr (requires { system.fill_irregular(x); }) return system.fill_irregular(x);
  std::uint32_t bits = 1;
  for (double& value : local_values(x)) {
    // The bits come from a linear congruential generator modulo 2³² with a known multiplier (D. E. Knuth, The Art of
    // Computer Programming 2, 3.3.4).
    bits = bits * 1664525u + 1013904223u;
    value = static_cast<double>(bits) / 2147483648.0 - 1;
  }
}

/// The operator K, or C if `of_velocity` is true. Both are computed by differences of the force. If the damping is not
/// linear in v, the system itself applies C.
template <ConstrainedSystem S>
class TangentOperator {
 public:
  /// `scale` is the size of the vector that the differences change: |q| for K, and |v| for C. If `scale` is 0, 1 is
  /// used. The object refers to `system`, `state` and `workspace`.
  TangentOperator(const S& system, const State<S>& state, typename S::Workspace& workspace, bool of_velocity,
                  double scale)
      : system_(system),
        state_(state),
        workspace_(workspace),
        of_velocity_(of_velocity),
        increment_((central ? std::cbrt(epsilon) : std::sqrt(epsilon)) * (scale > 0 ? scale : 1)),
        moved_(state),
        force_(system.make_vector()),
        force_at_state_(central ? typename S::Vector{} : system.make_vector()),
        lambda_(system.make_multiplier()),
        residual_(system.make_multiplier()),
        delta_(system.make_multiplier()) {}

  /// Computes λ for K, and the force at the state for forward differences. `apply` needs both. Fails if the force or a
  /// Gram solve fails.
  Status prepare() {
    if constexpr (Compliant<S>)
      if (is_compliant(system_)) {
        if (Status status = multiplier_of_compliance(system_, state_.q, lambda_); !status) return status;
        return central ? Status() : evaluate(force_at_state_);
      }
    if (!of_velocity_)
      if (Status status = multiplier_of_motion(system_, state_, workspace_, lambda_); !status) return status;
    if constexpr (central) return {};
    return evaluate(force_at_state_);
  }

  /// Sets result.w to K u (or C u) and result.u to M⁻¹ times this vector, and projects both. If the force fails, the
  /// increment of the difference is divided by 10, up to five times. Later calls use the smaller increment. The force
  /// can fail for a body that is thin compared with its length. Fails if the force fails with the smallest increment,
  /// or if the Gram solve fails.
  Status apply(const typename S::Vector& u, MassPair<S>& result) {
    Status status = difference(u, result.w);
    for (int n_smaller = 0; !status && n_smaller < 5; ++n_smaller) {
      increment_ /= 10;
      status = difference(u, result.w);
    }
    if (!status) return status;
    system_.apply_inverse_mass(result.w, result.u);
    return project(result);
  }

  /// Projects x.u onto the tangent space of the constraints, and changes x.w = M u accordingly. Fails if the Gram solve
  /// fails.
  Status project(MassPair<S>& x) {
    if constexpr (!unconstrained<S>) {
      if (!is_constrained(system_)) return {};
      system_.constraint_rate(state_.q, x.u, residual_);
      scale(-1.0, residual_);
      if (auto report = system_.solve_gram(state_.q, state_.q, residual_, workspace_, delta_); !report.status)
        return std::move(report.status);
      scale(0.0, force_);
      system_.add_reaction(state_.q, delta_, force_);
      axpy(1.0, force_, x.w);
      system_.apply_inverse_mass(force_, force_);
      axpy(1.0, force_, x.u);
    }
    return {};
  }

 private:
  /// Computes w = K u, or w = C u if `of_velocity_` is true, by a difference of forces. If the damping is not linear in
  /// the velocity, the system applies C itself, because a difference would need changes far below the slip speed of
  /// friction. Fails if the force fails.
  Status difference(const typename S::Vector& u, typename S::Vector& w) {
    if constexpr (Damped<S>)
      if (of_velocity_ && !damping_is_linear(system_)) {
        scale(0.0, w);
        system_.add_damping(state_, u, Linearization::tangent, w);
        scale(-1.0, w);
        return {};
      }
    const double increment = increment_ / max_norm(u);
    typename S::Vector& changed = of_velocity_ ? moved_.v : moved_.q;
    scale(0.0, w);
    const auto add_side = [&](double side, double weight) {
      changed = of_velocity_ ? state_.v : state_.q;
      axpy(side * increment, u, changed);
      Status status = evaluate(force_);
      if (status) axpy(-weight / increment, force_, w);
      return status;
    };
    if constexpr (central) {
      if (Status status = add_side(1, 0.5); !status) return status;
      return add_side(-1, -0.5);
    } else {
      axpy(1 / increment, force_at_state_, w);
      return add_side(1, 1);
    }
  }

  /// Sets `force` to f + G(q)ᵀλ at `moved_`, or to f if `of_velocity_` is true. Fails if the force fails.
  Status evaluate(typename S::Vector& force) {
    if (Status status = system_.force(state_.t, moved_.q, moved_.v, workspace_, force); !status) return status;
    if constexpr (!unconstrained<S>)
      if (!of_velocity_) system_.add_reaction(moved_.q, lambda_, force);
    return {};
  }

  static constexpr bool central = VectorSpace<typename S::Vector>::dense;
  static constexpr double epsilon = std::numeric_limits<double>::epsilon();

  const S& system_;
  const State<S>& state_;
  typename S::Workspace& workspace_;
  bool of_velocity_;
  double increment_;
  State<S> moved_;
  typename S::Vector force_, force_at_state_;
  typename S::Multiplier lambda_, residual_, delta_;
};

/// The largest eigenvalue `value` of the Lanczos matrix T_n, and the residual |β_n s_n| of its eigenvector s, which has
/// the norm 1 and the last component s_n. T_n is tridiagonal with the diagonal `alpha`. Its off-diagonal consists of
/// the numbers in `beta` except the last, β_n. The operator has an eigenvalue that differs from `value` by at most
/// `residual`.
struct RitzValue {
  double value = 0, residual = 0;
};
/// Returns the largest eigenvalue and its residual after n = alpha.size() ≥ 1 steps of Lanczos. `beta` must have the
/// same size as `alpha`.
RitzValue largest_ritz_value(const std::vector<double>& alpha, const std::vector<double>& beta);

/// Returns the number of independent displacements tangent to the constraints, or the largest int for distributed
/// vectors. After this number of steps, Lanczos' iteration is exact. Further vectors would consist of round-off.
template <ConstrainedSystem S>
int most_directions(const S& system) {
  if constexpr (VectorSpace<typename S::Vector>::dense) {
    auto vector = system.make_vector();
    auto multiplier = system.make_multiplier();
    const std::size_t n_constraints = is_constrained(system) ? local_values(multiplier).size() : 0;
    return static_cast<int>(local_values(vector).size() - n_constraints);
  }
  return std::numeric_limits<int>::max();
}

/// Sets `value` to an upper estimate of the largest eigenvalue of M⁻¹K or M⁻¹C, with at most `n_iterations` steps of
/// Lanczos. The estimate is the sum of the largest Ritz value and its residual, or 0 if this sum is negative. The
/// iteration ends earlier if the residual is at most `accuracy` times the eigenvalue, or if the next vector would be
/// round-off. Fails if the force or a Gram solve fails.
template <ConstrainedSystem S>
Status largest_eigenvalue(TangentOperator<S> tangent, const S& system, int n_iterations, double accuracy,
                          double& value) {
  if (Status status = tangent.prepare(); !status) return status;

  MassPair<S> x{system.make_vector(), system.make_vector()}, before = x, next = x;
  fill_irregular(system, x.w);
  system.apply_inverse_mass(x.w, x.u);
  if (Status status = tangent.project(x); !status) return status;

  std::vector<double> alpha, beta;
  RitzValue ritz;
  double norm = x.norm(), largest = 0;
  n_iterations = std::min(n_iterations, most_directions(system));
  for (int j = 0; j < n_iterations && norm > 1e-6 * largest; ++j) {
    x.scale_by(1 / norm);
    if (Status status = tangent.apply(x.u, next); !status) return status;
    alpha.push_back(dot(x.u, next.w));
    next.add(-alpha.back(), x);
    if (j > 0) next.add(-beta.back(), before);
    norm = next.norm();
    beta.push_back(norm);
    largest = std::max({largest, std::abs(alpha.back()), norm});
    std::swap(before, x);
    std::swap(x, next);
    if (accuracy == 0 && j + 1 < n_iterations && norm > 1e-6 * largest) continue;
    ritz = largest_ritz_value(alpha, beta);
    if (ritz.residual <= accuracy * ritz.value) break;
  }
  value = std::max(0.0, ritz.value + ritz.residual);
  return {};
}

}  // namespace detail

/// Returns ω from at most `n_iterations` steps of Lanczos. The iteration ends earlier if the relative uncertainty of ω²
/// is at most `accuracy`. The residual of the eigenvalue is added to ω². A short iteration therefore usually gives an ω
/// that is too large and a step that is too small, which is safe. If the number of steps is the number of modes, only
/// the differences of the force cause errors. If this estimate of ω² is negative, ω is 0.
template <ConstrainedSystem S>
FrequencyReport largest_frequency(const S& system, const State<S>& state, typename S::Workspace& workspace,
                                  int n_iterations, double accuracy = 0) {
  double omega_squared = 0;
  Status status =
      detail::largest_eigenvalue(detail::TangentOperator<S>(system, state, workspace, false, max_norm(state.q)), system,
                                 n_iterations, accuracy, omega_squared);
  return {std::move(status), std::sqrt(omega_squared)};
}

/// Returns the largest damping rate γ, with `n_iterations` and `accuracy` as in largest_frequency. `omega` is the
/// largest frequency ω. The increments of the differences are proportional to the larger of |v| and ω|q|. If the system
/// does not dissipate energy, γ is 0.
template <ConstrainedSystem S>
DampingReport largest_damping(const S& system, const State<S>& state, typename S::Workspace& workspace, double omega,
                              int n_iterations, double accuracy = 0) {
  DampingReport report;
  if (!dissipative(system)) return report;
  const double scale = std::max(max_norm(state.v), omega * max_norm(state.q));
  report.status = detail::largest_eigenvalue(detail::TangentOperator<S>(system, state, workspace, true, scale), system,
                                             n_iterations, accuracy, report.gamma);
  return report;
}

}  // namespace pseudorigid::mechanics
