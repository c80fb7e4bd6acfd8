#pragma once
/// A Gauss step (gauss_16.h) between its ends. The polynomial through the accelerations a_j of the stages is, by
/// Legendre's polynomials P_k on [0, 1],
///
///   a(t + θh) = Σ_k A_k P_k(θ),   A_k = (2k+1) Σ_j b_j P_k(c_j) a_j,
///   v(t + θh) = v + h Σ_k A_k ∫₀^θ P_k,   q(t + θh) = q + θh v + h² Σ_k A_k ∫₀^θ ∫₀ P_k,
///
/// and a step of order 16 has q between its ends to order 10, v to order 9.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mechanics/core/gauss_stages.h"

namespace pseudorigid::mechanics {

/// A part of a step that has been made in one.
template <class Vector>
struct GaussPiece {
  double t = 0, h = 0;
  Vector q, v;                   ///< at t
  std::vector<OfStages> stages;  ///< by entry

  void at(double time, Vector& q_there, Vector& v_there) const {
    const double theta = (time - t) / h;
    const Integrals of = integrals(theta);
    for (std::size_t k = 0; k < stages.size(); ++k) {
      double once = 0, twice = 0;
      for (std::size_t order = 0; order < gauss::n_stages; ++order) {
        double A = 0;
        for (std::size_t j = 0; j < gauss::n_stages; ++j)
          A += static_cast<double>(gauss::detail::expansions[j][order]) * stages[k][j];
        once += A * of.once[order];
        twice += A * of.twice[order];
      }
      const double v_k = v.data()[k];
      v_there.data()[k] = v_k + h * once;
      q_there.data()[k] = q.data()[k] + h * (theta * v_k + h * twice);
    }
  }

 private:
  struct Integrals {
    std::array<double, gauss::n_stages> once{}, twice{};
  };
  /// ∫₀^θ P_k and ∫₀^θ ∫₀ P_k, by ∫₀ P_k = (P_{k+1} − P_{k−1}) / (4k + 2).
  static Integrals integrals(double theta) {
    constexpr std::size_t n = gauss::n_stages;
    std::array<double, n + 2> P{1, 2 * theta - 1};
    for (std::size_t k = 1; k <= n; ++k) {
      const double m = static_cast<double>(k);
      P[k + 1] = ((2 * m + 1) * P[1] * P[k] - m * P[k - 1]) / (m + 1);
    }
    std::array<double, n + 1> once{theta};
    for (std::size_t k = 1; k <= n; ++k) once[k] = (P[k + 1] - P[k - 1]) / static_cast<double>(4 * k + 2);
    Integrals of;
    of.once[0] = theta;
    of.twice[0] = 0.5 * theta * theta;
    for (std::size_t k = 1; k < n; ++k) {
      of.once[k] = once[k];
      of.twice[k] = (once[k + 1] - once[k - 1]) / static_cast<double>(4 * k + 2);
    }
    return of;
  }
};

/// Estimated error of v between the ends of a step. The error of q is less, by about h/20. If the Legendre coefficients
/// fall like ρᵏ, the tail is about ρ^6.5, and the first that is missing is ρ^8. C was fitted: on the problems of
/// docs/benchmarks.md, with h from 1/8 to 1, the error was 0.04 to 2.5 times the estimate.
inline double interpolation_error(const GaussStages& s) {
  constexpr double C = 0.02;
  return C * std::abs(s.h) * s.scale * s.tail * std::sqrt(std::sqrt(s.tail));
}

}  // namespace pseudorigid::mechanics
