#pragma once
/// Symmetric composition of a symmetric method Φ of order 2, with s substeps (Hairer, Lubich, Wanner, Geometric
/// Numerical Integration, V.3.2):
///
///   Ψ_h = Φ_{γ_s h} ∘ … ∘ Φ_{γ_1 h},   γ_i = γ_{s+1−i},   Σγ_i = 1.
///
/// The composed method is symmetric. If Φ is symplectic, the composed method is symplectic too. A set of coefficients
/// γ_i has the order and the stability limit of the composed method as members. The limit is the largest hω for which
/// the composition is stable, if Φ is the Störmer–Verlet method for an oscillator ẍ = −ω²x. It was computed from the
/// trace of the matrix of a composed step. If chosen_by_auto is true, the entry Method = auto of a scene may choose the
/// method.
///
/// A composition does not take compliant constraints (constrained_system.h). Each substep of RATTLE then turns a fast
/// mode in a metric that depends on γ_i. If a composed step turns the mode by a multiple of π, the mode can grow. With
/// Suzuki's coefficients it grew by up to 0.4 % in a step, in a scan of the stiffness of one mode.

#include <array>
#include <cstddef>

#include "mechanics/core/constrained_system.h"
#include "mechanics/methods/rattle.h"

namespace pseudorigid::mechanics {

/// Coefficients of order 4 with 5 stages: γ₁ = γ₂ = 1/(4 − 4^{1/3}), γ₃ = 1 − 4γ₁ (M. Suzuki, Phys. Lett. A 146 (1990)
/// 319).
struct Suzuki4 {
  static constexpr int order = 4;
  static constexpr double stability_limit = 2.72;
  static constexpr std::array<double, 5> gamma{0.41449077179437573714235406286076, 0.41449077179437573714235406286076,
                                               -0.65796308717750294856941625144306, 0.41449077179437573714235406286076,
                                               0.41449077179437573714235406286076};
};

/// Coefficients of order 6 with 9 stages: scheme s9odr6a of W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089.
struct KahanLi6 {
  static constexpr int order = 6;
  static constexpr double stability_limit = 2.53;
  static constexpr std::array<double, 9> gamma{
      0.39216144400731413927925056,  0.33259913678935943859974864, -0.70624617255763935980996482,
      0.08221359629355080023149045,  0.79854399093482996339895035, 0.08221359629355080023149045,
      -0.70624617255763935980996482, 0.33259913678935943859974864, 0.39216144400731413927925056};
};

/// Coefficients of order 8 with 17 stages: scheme s17odr8a of W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089.
struct KahanLi8 {
  static constexpr int order = 8;
  static constexpr double stability_limit = 3.09;
  static constexpr std::array<double, 17> gamma{
      0.13020248308889008087881763,  0.56116298177510838456196441,  -0.38947496264484728640807860,
      0.15884190655515560089621075,  -0.39590389413323757733623154, 0.18453964097831570709183254,
      0.25837438768632204729397911,  0.29501172360931029887096624,  -0.60550853383003451169892108,
      0.29501172360931029887096624,  0.25837438768632204729397911,  0.18453964097831570709183254,
      -0.39590389413323757733623154, 0.15884190655515560089621075,  -0.38947496264484728640807860,
      0.56116298177510838456196441,  0.13020248308889008087881763};
};

template <class Base, class Coefficients>
struct Composition {
  static_assert(Base::symmetric && Base::order == 2, "the coefficients are those for symmetric methods of order 2");
  static constexpr int order = Coefficients::order;
  static constexpr int n_stages = static_cast<int>(Coefficients::gamma.size()) * Base::n_stages;
  static constexpr bool symplectic = Base::symplectic, symmetric = true;
  static constexpr bool adaptive = false, takes_any_vector = Base::takes_any_vector;
  static constexpr double stability_limit = Coefficients::stability_limit;

  template <class S>
  using Workspace = typename Base::template Workspace<S>;
  template <class S>
  static constexpr bool fits = Base::template fits<S>;

  /// Returns a failure for dissipative systems and for systems that the base method does not accept. Some substeps go
  /// backwards in time, and dissipation would add energy in these substeps.
  template <class S>
  static Status accepts(const S& system) {
    if (dissipative(system))
      return Status::failure(
          "compositions take some substeps backwards in time, where dissipation would feed energy in; use rattle or "
          "explicit-8");
    return Base::accepts(system);
  }

  /// Makes one step, which has s substeps of the method Φ = Base. Fails if a substep fails. The state is then not
  /// valid.
  template <ConstrainedSystem S>
  static Status advance(const S& system, double h, State<S>& state, Workspace<S>& w) {
    for (const double gamma : Coefficients::gamma)
      if (Status status = Base::advance(system, gamma * h, state, w); !status) return status;
    return {};
  }

  template <ConstrainedSystem S>
  static Status project_velocity(const S& system, State<S>& state, Workspace<S>& w) {
    return Base::project_velocity(system, state, w);
  }
};

struct Rattle4 : Composition<Rattle, Suzuki4> {
  static constexpr bool chosen_by_auto = true;
  static constexpr const char* name = "rattle-4";
  static constexpr const char* documentation = "RATTLE composed to order 4, 5 forces a step";
};
struct Rattle6 : Composition<Rattle, KahanLi6> {
  static constexpr bool chosen_by_auto = true;
  static constexpr const char* name = "rattle-6";
  static constexpr const char* documentation = "RATTLE composed to order 6, 9 forces a step";
};
struct Rattle8 : Composition<Rattle, KahanLi8> {
  static constexpr bool chosen_by_auto = true;
  static constexpr const char* name = "rattle-8";
  static constexpr const char* documentation = "RATTLE composed to order 8, 17 forces a step";
};

}  // namespace pseudorigid::mechanics
