#include "reduced/gauss_body_kernels.h"

#include <variant>

#include "materials/tensor.h"
#include "mechanics/core/gauss_iteration.h"
#include "reduced/gravity_in_lanes.h"

namespace pseudorigid::reduced {
namespace {

using mechanics::detail::StageLanes;
using Tensor = materials::Tensor<StageLanes>;
using mechanics::detail::in_all_lanes;
using mechanics::detail::load_lanes;
using mechanics::detail::root_of_lanes;

/// Returns the matrix with the nine entries p[0], …, p[8], which are stored by columns.
[[gnu::always_inline]] inline Tensor matrix(const StageLanes* p) {
  return {{{p[0], p[3], p[6]}, {p[1], p[4], p[7]}, {p[2], p[5], p[8]}}};
}
[[gnu::always_inline]] inline void store(const Tensor& A, StageLanes* p) {
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) p[k] = A(k % 3, k / 3);
}
/// Returns a matrix that is the same in all lanes. The numbers are stored by columns.
[[gnu::always_inline]] inline Tensor matrix(const Numbers9& x) {
  StageLanes p[9];
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) p[k] = in_all_lanes(x[k]);
  return matrix(p);
}
[[gnu::always_inline]] inline Tensor matrix(const std::array<mechanics::OfStages, 9>& x, int first_lane) {
  StageLanes p[9];
#pragma GCC unroll 9
  for (int k = 0; k < 9; ++k) p[k] = load_lanes(x[k].data() + first_lane);
  return matrix(p);
}
template <class Function>
[[gnu::always_inline]] inline Tensor entry_by_entry(Function f, const Tensor& A, const Tensor& B) {
  return materials::entrywise([&](const StageLanes& a, const StageLanes& b) { return f(a, b); }, A, B);
}
[[gnu::always_inline]] inline Tensor plus(const Tensor& A, const Tensor& B) {
  return entry_by_entry([](StageLanes a, StageLanes b) { return a + b; }, A, B);
}
[[gnu::always_inline]] inline Tensor minus(const Tensor& A, const Tensor& B) {
  return entry_by_entry([](StageLanes a, StageLanes b) { return a - b; }, A, B);
}
/// Returns A + s B.
[[gnu::always_inline]] inline Tensor plus(const Tensor& A, StageLanes s, const Tensor& B) {
  return entry_by_entry([&](StageLanes a, StageLanes b) { return a + s * b; }, A, B);
}

/// Returns numbers that are positive exactly in the lanes in which J > 0 and the law admits Q.
template <class Law>
[[gnu::always_inline]] inline StageLanes reserve_of(const Law& law, const Tensor& Q, StageLanes J) {
  if constexpr (materials::is_limited<Law>)
    return min(J, law.reserve(Q));
  else
    return J;
}

/// The field Q̈ = −(Vol/m̄) P + Λ Q⁻ᵀ/m̄ of a body without loads and with the inertia E₀ = m̄ Id. P is the stress, Vol
/// is the volume, and Λ is the multiplier, which is 0 on GL⁺(3). Some laws have a stress of the form αQ + β cof Q. Then
/// β has no effect on SL(3), because Λ compensates it. With C = cof Q and J = det Q,
///
///   Q̈ = sC − (Vol/m̄) αQ,   s = [tr((CᵀQ̇)²) + 3 (Vol/m̄) α J²] / (J C:C).
template <class Law, bool incompressible>
struct ElasticField {
  static constexpr int n = 9;
  const Law& law;
  double volume_per_inertia;

  template <class T>
  [[gnu::always_inline]] T operator()(int, const T* q, const T* v, T* a) const {
    const Tensor Q = matrix(q), C = materials::cofactor(Q);
    const T J = materials::determinant(Q, C);
    if constexpr (!incompressible) {
      store(in_all_lanes(-volume_per_inertia) * law.stress(Q), a);
    } else {
      const T curvature = materials::trace_of_square(materials::transposed_product(C, matrix(v)));
      const T denominator = J * materials::dot(C, C);
      if constexpr (requires { law.stress_coefficients(J); }) {
        const T of_Q = volume_per_inertia * law.stress_coefficients(J).of_F;
        const T s = (curvature + 3.0 * of_Q * (J * J)) / denominator;
        store(entry_by_entry([&](T c, T x) { return s * c - of_Q * x; }, C, Q), a);
      } else {
        const Tensor A = in_all_lanes(volume_per_inertia) * law.stress(Q);
        const T s = (curvature + J * materials::dot(C, A)) / denominator;
        store(entry_by_entry([&](T c, T x) { return s * c - x; }, C, A), a);
      }
    }
    return reserve_of(law, Q, J);
  }
};

/// Pointer to a function that sets P to the stress of a law and returns reserve_of. Because of this pointer, each law
/// is compiled once, and not once for each field.
using Stress = StageLanes (*)(const materials::AnyLaw& law, const Tensor& Q, StageLanes J, Tensor& P);
template <class Law>
StageLanes stress_of(const materials::AnyLaw& any, const Tensor& Q, StageLanes J, Tensor& P) {
  const Law& law = *std::get_if<Law>(&any);
  P = law.stress(Q);
  return reserve_of(law, Q, J);
}

/// Adds −∂V/∂Q to f, with the energy V of external_energy. C is cof Q.
[[gnu::always_inline]] inline void add_external(const Tensor& Q, const Tensor& C, const Tensor& E0, double volume,
                                                const Tensor& quadratic, const Tensor& traction, StageLanes pressure,
                                                Tensor& f) {
  f = minus(f, materials::product(materials::product(quadratic, Q), E0));
  f = plus(f, in_all_lanes(volume), traction);
  f = plus(f, -(volume * pressure), C);
}
/// The energy of the quadratic potential, the traction and the pressure (external_potential.h), with J = det Q.
[[gnu::always_inline]] inline StageLanes external_energy(const Tensor& Q, StageLanes J, const Tensor& E0, double volume,
                                                         const Tensor& quadratic, const Tensor& traction,
                                                         StageLanes pressure) {
  return 0.5 * materials::dot(materials::product(materials::product(quadratic, Q), E0), Q) +
         volume * (pressure * J - materials::dot(traction, Q));
}

/// Derivative of the energy of self-gravity with respect to Q. The ellipsoid is the image of the unit ball under QS,
/// with the matrix S of the shape. The function is not inlined, because it would use registers that the remaining code
/// needs.
[[gnu::noinline]] Tensor gravity_of(const BodyOfStages& body, const Tensor& Q) {
  const Tensor S = matrix(body.shape);
  const Tensor S_transposed{{{S(0, 0), S(1, 0), S(2, 0)}, {S(0, 1), S(1, 1), S(2, 1)}, {S(0, 2), S(1, 2), S(2, 2)}}};
  const Tensor force = ellipsoid_force(
      body.gravity_strength, materials::product(Q, S), [](StageLanes x) { return root_of_lanes(x); },
      [](StageLanes x) { return mechanics::detail::greatest_lane(x.v); });
  return materials::product(force, S_transposed);
}

/// The field of a body with any inertia and any loads that do not depend on time. If `entries` is with_accounts,
/// dissipation and loads that depend on time are added. Returns reserve_of.
template <BodyEntries entries, bool incompressible>
struct GeneralField {
  static constexpr int n = entries == BodyEntries::diagonal ? 3 : entries == BodyEntries::matrix ? 9 : 12;
  const BodyOfStages& body;
  const AccountsOfStages* accounts;
  Stress stress;

  template <class T>
  [[gnu::always_inline]] T operator()(int first_lane, const T* q, const T* v, T* a) const {
    const Tensor Q = matrix_of(q), V = matrix_of(v), C = materials::cofactor(Q);
    const Tensor E0 = matrix(body.E0), E0_inverse = matrix(body.E0_inverse);
    const T J = materials::determinant(Q, C);
    Tensor P;
    const T reserve = stress(body.law, Q, J, P);
    Tensor f = materials::entrywise([this](const T& p) { return -body.volume * p; }, P);
    if (body.loaded) {
      if (body.gravity_strength != 0) f = minus(f, gravity_of(body, Q));
      add_external(Q, C, E0, body.volume, matrix(body.quadratic), matrix(body.nominal_traction),
                   in_all_lanes(body.pressure), f);
    }
    if constexpr (entries == BodyEntries::with_accounts) add_accounts(first_lane, Q, V, C, J, E0, f, a);
    const Tensor A = materials::product(f, E0_inverse);
    if constexpr (incompressible) {
      const Tensor B = materials::product(C, E0_inverse);
      const T curvature = materials::trace_of_square(materials::transposed_product(C, V));
      const T s = (curvature - J * materials::dot(C, A)) / (J * materials::dot(C, B));
      store_of(plus(A, s, B), a);
    } else {
      store_of(A, a);
    }
    return reserve;
  }

 private:
  template <class T>
  [[gnu::always_inline]] static Tensor matrix_of(const T* p) {
    const T zero = in_all_lanes(0);
    if constexpr (entries == BodyEntries::diagonal)
      return {{{p[0], zero, zero}, {zero, p[1], zero}, {zero, zero, p[2]}}};
    else
      return matrix(p);
  }
  template <class T>
  [[gnu::always_inline]] static void store_of(const Tensor& A, T* p) {
    if constexpr (entries == BodyEntries::diagonal)
      for (int k = 0; k < 3; ++k) p[k] = A(k, k);
    else
      store(A, p);
  }

  /// Adds the forces of dissipation and of loads that depend on time to f. Sets the accelerations of the further
  /// coordinates s and s' to the dissipated and the given power (dissipative_body.h).
  template <class T>
  [[gnu::always_inline]] void add_accounts(int first_lane, const Tensor& Q, const Tensor& V, const Tensor& C, T J,
                                           const Tensor& E0, Tensor& f, T* a) const {
    T power = in_all_lanes(0), given = in_all_lanes(0);
    if (accounts->viscosity != 0) {  // the force −2η Vol d C with the velocity V and d = sym(V Cᵀ)/J
      const auto product_with_transposed = [&](int i, int j) {
        return V(i, 0) * C(j, 0) + V(i, 1) * C(j, 1) + V(i, 2) * C(j, 2);
      };
      const T half = 0.5 / J;
      Tensor d;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) d(i, j) = half * (product_with_transposed(i, j) + product_with_transposed(j, i));
      const double strength = 2 * accounts->viscosity * body.volume;
      f = plus(f, in_all_lanes(-strength), materials::product(d, C));
      power = power + strength * (J * materials::dot(d, d));
    }
    if (accounts->drag != 0) {
      const Tensor momentum = materials::product(V, E0);
      f = plus(f, in_all_lanes(-accounts->drag), momentum);
      power = power + accounts->drag * materials::dot(momentum, V);
    }
    if (accounts->driven) {
      const auto &now = accounts->driving, &rate = accounts->driving_rate;
      add_external(Q, C, E0, body.volume, matrix(now.quadratic, first_lane), matrix(now.nominal_traction, first_lane),
                   load_lanes(now.pressure.data() + first_lane), f);
      given = external_energy(Q, J, E0, body.volume, matrix(rate.quadratic, first_lane),
                              matrix(rate.nominal_traction, first_lane), load_lanes(rate.pressure.data() + first_lane));
    }
    a[9] = power;
    a[10] = given;
    a[11] = in_all_lanes(0);
  }
};

template <BodyEntries entries>
void solve_general(const BodyOfStages& body, const AccountsOfStages* accounts, mechanics::GaussStages& stages) {
  const Stress stress = std::visit([]<class Law>(const Law&) -> Stress { return &stress_of<Law>; }, body.law);
  if (body.incompressible)
    mechanics::detail::iterate_in_lanes(GeneralField<entries, true>{body, accounts, stress}, stages);
  else
    mechanics::detail::iterate_in_lanes(GeneralField<entries, false>{body, accounts, stress}, stages);
}

}  // namespace

void solve_stages_in_lanes(const BodyOfStages& body, BodyEntries entries, const AccountsOfStages* accounts,
                           mechanics::GaussStages& stages) {
  if (entries == BodyEntries::diagonal) return solve_general<BodyEntries::diagonal>(body, accounts, stages);
  if (entries == BodyEntries::with_accounts) return solve_general<BodyEntries::with_accounts>(body, accounts, stages);
  if (body.loaded || !body.isotropic) return solve_general<BodyEntries::matrix>(body, accounts, stages);
  std::visit(
      [&]<class Law>(const Law& law) {
        const double ratio = body.volume * body.inverse_m_bar;
        if (body.incompressible)
          mechanics::detail::iterate_in_lanes(ElasticField<Law, true>{law, ratio}, stages);
        else
          mechanics::detail::iterate_in_lanes(ElasticField<Law, false>{law, ratio}, stages);
      },
      body.law);
}

}  // namespace pseudorigid::reduced
