#pragma once
/// Largest frequency of small motions about a state, tangent to the constraints: with λ the multiplier of the motion,
///
///   ω² = max over G u = 0 of  uᵀK u / uᵀM u,     K u = −D_q[f + G(q)ᵀλ] u   (central differences, λ and v fixed).
///
/// The stability limit of a method is a bound on hω. Lanczos' iteration for M⁻¹K in the inner product of M, with the
/// projection
///
///   u ← u − M⁻¹Gᵀ(G M⁻¹Gᵀ)⁻¹G u,
///
/// keeps each u together with its w = M u. So only M⁻¹ is needed, and ⟨u, u'⟩_M = uᵀw' also where M⁻¹ has zeros
/// (components that are held fixed: u = 0 there, whatever w is).

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "mechanics/constrained_system.h"

namespace pseudorigid::mechanics {

/// ω, or why it could not be had.
struct [[nodiscard]] FrequencyReport {
  Status status;
  double omega = 0;
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

/// Fixed numbers in (−1, 1) without pattern: every mode has a part in them.
template <class V>
void fill_irregular(V& x) {
  std::uint32_t bits = 1;
  for (double& value : local_values(x)) {
    bits = bits * 1664525u + 1013904223u;  // D. E. Knuth, The Art of Computer Programming 2, 3.3.4
    value = static_cast<double>(bits) / 2147483648.0 - 1;
  }
}

template <ConstrainedSystem S>
class TangentStiffness {
 public:
  TangentStiffness(const S& system, const State<S>& state, typename S::Workspace& workspace)
      : system_(system),
        state_(state),
        workspace_(workspace),
        q_(system.make_vector()),
        force_(system.make_vector()),
        lambda_(system.make_multiplier()),
        residual_(system.make_multiplier()),
        delta_(system.make_multiplier()) {}

  Status prepare() { return multiplier_of_motion(system_, state_, workspace_, lambda_); }

  /// w ← K u, u ← M⁻¹K u, projected.
  Status apply(const typename S::Vector& u, MassPair<S>& result) {
    const double size = max_norm(state_.q);
    const double increment = std::cbrt(std::numeric_limits<double>::epsilon()) * (size > 0 ? size : 1) / max_norm(u);
    scale(0.0, result.w);
    for (const double side : {1.0, -1.0}) {
      q_ = state_.q;
      axpy(side * increment, u, q_);
      if (Status status = system_.force(state_.t, q_, state_.v, workspace_, force_); !status) return status;
      if constexpr (!unconstrained<S>) system_.add_reaction(q_, lambda_, force_);
      axpy(-side / (2 * increment), force_, result.w);
    }
    system_.apply_inverse_mass(result.w, result.u);
    return project(result);
  }

  Status project(MassPair<S>& x) {
    if constexpr (!unconstrained<S>) {
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
  const S& system_;
  const State<S>& state_;
  typename S::Workspace& workspace_;
  typename S::Vector q_, force_;
  typename S::Multiplier lambda_, residual_, delta_;
};

/// Largest eigenvalue of the Lanczos matrix (diagonal alpha, beside it beta) and the residual of its vector,
/// |β_n s_n|: some eigenvalue lies that near.
double upper_ritz_value(const std::vector<double>& alpha, const std::vector<double>& beta);

}  // namespace detail

namespace detail {

/// How many independent displacements the constraints leave, where that can be known; the iteration has then seen all,
/// and what would follow is round-off that may grow without bound.
template <ConstrainedSystem S>
int most_directions(const S& system) {
  if constexpr (VectorSpace<typename S::Vector>::dense) {
    auto vector = system.make_vector();
    auto multiplier = system.make_multiplier();
    return static_cast<int>(local_values(vector).size()) - static_cast<int>(local_values(multiplier).size());
  }
  return std::numeric_limits<int>::max();
}

}  // namespace detail

/// ω from at most `n_iterations` steps of Lanczos, two forces each. The residual is added to the Ritz value, so that
/// few iterations rather err on the side of a large ω, a small step. Exact up to the differences (≈ 1e-9) once the
/// iteration has seen every mode; 0 where nothing oscillates.
template <ConstrainedSystem S>
FrequencyReport largest_frequency(const S& system, const State<S>& state, typename S::Workspace& workspace,
                                  int n_iterations) {
  detail::TangentStiffness<S> stiffness(system, state, workspace);
  if (Status status = stiffness.prepare(); !status) return {std::move(status)};

  detail::MassPair<S> x{system.make_vector(), system.make_vector()}, before = x, next = x;
  detail::fill_irregular(x.w);
  system.apply_inverse_mass(x.w, x.u);
  if (Status status = stiffness.project(x); !status) return {std::move(status)};

  std::vector<double> alpha, beta;
  double norm = x.norm(), largest = 0;
  n_iterations = std::min(n_iterations, detail::most_directions(system));
  for (int j = 0; j < n_iterations && norm > 1e-6 * largest; ++j) {
    x.scale_by(1 / norm);
    if (Status status = stiffness.apply(x.u, next); !status) return {std::move(status)};
    alpha.push_back(dot(x.u, next.w));
    next.add(-alpha.back(), x);
    if (j > 0) next.add(-beta.back(), before);
    norm = next.norm();
    beta.push_back(norm);
    largest = std::max({largest, std::abs(alpha.back()), norm});
    std::swap(before, x);
    std::swap(x, next);
  }
  if (alpha.empty()) return {};
  return {Status{}, std::sqrt(std::max(0.0, detail::upper_ritz_value(alpha, beta)))};
}

}  // namespace pseudorigid::mechanics
