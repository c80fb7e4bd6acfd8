/// The statements of Oliva, Geometric Mechanics, 5.1 and 5.3. Those of 5.2 are in tests/systems/jacobi_test.cpp, those
/// of 5.4 in statements_constraints_test.cpp.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "mechanics/core/chart_field.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/sphere_particle.h"
#include "support/differences.h"
#include "support/integrate.h"
#include "support/pendulum_chain.h"
#include "support/round_off.h"
#include "support/surface_curves.h"
#include "systems/double_pendulum_chart.h"
#include "systems/torus.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using mechanics::ChartField;
using mechanics::State;
using systems::DoublePendulumChart;

using std::numbers::pi;
template <class C>
using Vector = mechanics::ChartVector<C>;
template <class C>
std::vector<CurveJetIn<C::dimension>> jets_of(const C&) {
  Vector<C> low = Vector<C>::Constant(-pi), high = -low;
  low[0] = 0.2;  // away from the poles of a sphere
  high[0] = pi - 0.2;
  return random_jets_in<C::dimension>(low, high, 50);
}
constexpr DoublePendulumChart pendulum{1.3, 0.7, 0.9, 1.2, 2.1};

template <class C>
auto christoffel(const C& chart, const Vector<C>& q) {
  std::array<mechanics::ChartMatrix<C>, C::dimension> Gamma;
  const auto status = mechanics::christoffel_symbols(chart, q, Gamma);
  EXPECT_TRUE(status) << status.reason();
  return Gamma;
}

/// Calls test(chart) for each chart of the core's statements, of two, three and five dimensions.
template <class Test>
void for_each_chart(const Test& test) {
  test(systems::Sphere{1.7});
  test(systems::TorusSurface{});
  test(SphereParticleChart(SphereParticle{}));
  test(systems::Torus{{3, 1}, 1.3, 0.4, 0.2});
  test(pendulum);
  test(PendulumChain<3>{});
  test(PendulumChain<5>{});
}
template <class Test>
void for_each_chain(const Test& test) {
  test(PendulumChain<3>{});
  test(PendulumChain<5>{});
}

/// (5.3): (Dq̇/dt)ᵏ = q̈ᵏ + Γᵏ_ij q̇ⁱq̇ʲ. On the sphere Γ^θ_φφ = −sin θ cos θ, Γ^φ_θφ = cot θ.
TEST(Statement_Eq5_3, ChristoffelSymbolsOfTheSphere) {
  const systems::Sphere sphere{1.7};
  for (const auto& [q, v, a] : jets_of(sphere)) {
    const auto Gamma = christoffel(sphere, q);
    const double s = std::sin(q[0]), c = std::cos(q[0]);
    const Matrix2d of_theta{{0, 0}, {0, -s * c}}, of_phi{{0, c / s}, {c / s, 0}};
    EXPECT_LT((Gamma[0] - of_theta).norm(), round_off);
    EXPECT_LT((Gamma[1] - of_phi).norm(), round_off);
  }
}

/// (5.3) on the torus: Γ^w_uu = (3 + cos w) sin w, Γ^u_wu = −sin w/(3 + cos w).
TEST(Statement_Eq5_3, ChristoffelSymbolsOfTheTorus) {
  const systems::TorusSurface torus;
  for (const auto& [q, v, a] : jets_of(torus)) {
    const auto Gamma = christoffel(torus, q);
    const double s = std::sin(q[0]), rho = 3 + std::cos(q[0]);
    const Matrix2d of_w{{0, 0}, {0, rho * s}}, of_u{{0, -s / rho}, {-s / rho, 0}};
    EXPECT_LT((Gamma[0] - of_w).norm(), round_off);
    EXPECT_LT((Gamma[1] - of_u).norm(), round_off);
  }
}

/// (5.3) on the double pendulum: Γ_θ,φφ = m₂l₁l₂ sin(θ−φ) = −Γ_φ,θθ, the others 0.
TEST(Statement_Eq5_3, ChristoffelSymbolsOfTheDoublePendulum) {
  for (const auto& [q, v, a] : jets_of(pendulum)) {
    const auto Gamma = christoffel(pendulum, q);
    const double s = pendulum.m2 * pendulum.l1 * pendulum.l2 * std::sin(q[0] - q[1]);
    const Matrix2d first_theta{{0, 0}, {0, s}}, first_phi{{-s, 0}, {0, 0}};
    const Matrix2d inverse = pendulum.metric(q).inverse();
    for (int k = 0; k < 2; ++k)
      EXPECT_LT((Gamma[k] - inverse(k, 0) * first_theta - inverse(k, 1) * first_phi).norm(), round_off);
  }
}

/// (5.3) in three and five dimensions: Γᵏ_ij = gᵏˡΓ_l,ij with Γ_l,ii = M l_l l_i sin(q_l − q_i), the others 0.
TEST(Statement_Eq5_3, ChristoffelSymbolsOfPendulumChains) {
  for_each_chain([](const auto& chain) {
    using C = std::decay_t<decltype(chain)>;
    constexpr int n = C::dimension;
    for (const auto& jet : jets_of(chain)) {
      const auto Gamma = christoffel(chain, jet.q);
      const MatrixXd inverse = mechanics::solve(chain.metric(jet.q), mechanics::ChartMatrix<C>::Identity());
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          for (int k = 0; k < n; ++k) {
            double exact = 0;
            for (int l = 0; l < n; ++l) exact += inverse(k, l) * C::first_kind(jet.q, l, i, j);
            EXPECT_NEAR(Gamma[k](i, j), exact, round_off * (1 + inverse.norm()));
          }
    }
  });
}

/// (5.3), the acceleration of a curve is the tangential part of that of its image: JᵀJ(Dq̇/dt) = Jᵀẍ.
TEST(Statement_Eq5_3, AccelerationIsTheTangentialPartOfThatOfTheImage) {
  for_each_chain([](const auto& chain) {
    using C = std::decay_t<decltype(chain)>;
    constexpr int n = C::dimension;
    const ChartField field(chain);
    for (const auto& jet : jets_of(chain)) {
      Vector<C> D;
      ASSERT_TRUE(field.covariant_acceleration(jet.q, jet.v, jet.a, D));
      const auto path = chain.weighted_embedding(taylor(jet));
      const auto place = chain.weighted_embedding(mechanics::independent(jet.q));
      Vector<C> by_image = Vector<C>::Zero();  // Jᵀẍ
      for (int i = 0; i < 2 * n; ++i) by_image += path[i].derivatives()[0].derivatives()[0] * place[i].derivatives();
      EXPECT_LT((mechanics::apply_mass(chain, jet.q, D) - by_image).norm(), round_off * (1 + by_image.norm()));
    }
  });
}

/// Exercise 5.1.1: μ(Dq̇/dt) = d/dt ∂K/∂q̇ − ∂K/∂q, for any curve. The right side is that of the definition: p = g q̇ is
/// differentiated along the curve, K at constant q̇.
TEST(Statement_Ex5_1_1, CovariantFormIsLagrangeForm) {
  for_each_chart([](const auto& chart) {
    using C = std::decay_t<decltype(chart)>;
    constexpr int n = C::dimension;
    const ChartField<C> field(chart);
    for (const auto& jet : jets_of(chart)) {
      Vector<C> D;
      ASSERT_TRUE(field.covariant_acceleration(jet.q, jet.v, jet.a, D));

      const auto q = taylor(jet);
      const Eigen::Matrix<TimeDual, n, n> g = chart.metric(q);
      Vector<C> lagrange = Vector<C>::Zero();  // d/dt (g_ij q̇ʲ)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          lagrange[i] += g(i, j).value().derivatives()[0] * jet.v[j] + g(i, j).value().value() * jet.a[j];
      const auto x = mechanics::independent(jet.q);
      const Eigen::Matrix<mechanics::Dual<double, n>, n, n> g_of_q = chart.metric(x);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) lagrange -= 0.5 * jet.v[i] * jet.v[j] * g_of_q(i, j).derivatives();

      EXPECT_LT((mechanics::apply_mass(chart, jet.q, D) - lagrange).norm(), round_off * (1 + lagrange.norm()));
    }
  });
}

/// (5.19): v̇_k = −Γᵏ_ij v_i v_j + f_k in three and five dimensions, with Γ and f = −μ⁻¹dU in closed form.
TEST(Statement_Eq5_19, SecondOrderSystemOfPendulumChains) {
  for_each_chain([](const auto& chain) {
    using C = std::decay_t<decltype(chain)>;
    constexpr int n = C::dimension;
    const ChartField field(chain);
    auto w = field.make_workspace();
    for (const auto& jet : jets_of(chain)) {
      Vector<C> a, rhs = Vector<C>::Zero();
      ASSERT_TRUE(field.acceleration(0, jet.q, jet.v, w, a));
      for (int l = 0; l < n; ++l) {
        rhs[l] = -chain.gravity * C::hanging_mass(l) * C::length(l) * std::sin(jet.q[l]);
        for (int i = 0; i < n; ++i) rhs[l] -= C::first_kind(jet.q, l, i, i) * jet.v[i] * jet.v[i];
      }
      const MatrixXd inverse = mechanics::solve(chain.metric(jet.q), mechanics::ChartMatrix<C>::Identity());
      const Vector<C> exact = inverse * rhs;
      EXPECT_LT((a - exact).norm(), round_off * (1 + inverse.norm() * rhs.norm()));
    }
  });
}

/// Of a motion of the field through (q, v) at the middle of nine times h apart, d/dt ∂K/∂q̇ by differences of the
/// states, which know nothing of the equation that made them.
template <class C>
Vector<C> momentum_rate(const ChartField<C>& field, const State<ChartField<C>>& middle, double h) {
  return first_difference(
      [&](int k) -> Vector<C> {
        const auto s = integrate(field, middle, k * h);
        Vector<C> p;  // ∂K/∂q̇: K is quadratic in q̇
        for (int j = 0; j < C::dimension; ++j)
          p[j] = 0.5 * (mechanics::kinetic_energy(field.chart(), s.q, s.v + Vector<C>::Unit(j)) -
                        mechanics::kinetic_energy(field.chart(), s.q, s.v - Vector<C>::Unit(j)));
        return p;
      },
      h);
}

/// (5.7), (5.20): motions obey μ(Dq̇/dt) = F(q̇), that is d/dt ∂K/∂q̇ − ∂K/∂q = −dU + μD(q̇), along what the program
/// integrates; with the friction of the torus too.
TEST(Statement_Eq5_7, MotionsObeyTheGeneralizedNewtonLaw) {
  constexpr double h = 0.004;  // small against the distance of 0.2 from a sphere's pole
  for_each_chart([](const auto& chart) {
    using C = std::decay_t<decltype(chart)>;
    const ChartField<C> field(chart);
    for (const auto& jet : jets_of(chart)) {
      Vector<C> expected;  // ∂(K − U)/∂q + μD
      for (int j = 0; j < C::dimension; ++j)
        expected[j] = first_difference(
            [&](int k) {
              const Vector<C> q = jet.q + h * k * Vector<C>::Unit(j);
              return mechanics::kinetic_energy(chart, q, jet.v) - mechanics::potential_energy(chart, q);
            },
            h);
      if constexpr (mechanics::HasDissipation<C>) expected -= chart.c * chart.metric(jet.q) * jet.v;
      const Vector<C> rate = momentum_rate(field, State<ChartField<C>>{0, jet.q, jet.v}, h);
      EXPECT_LT((rate - expected).norm(), 1e-9 * (1 + rate.norm())) << "round-off 1e-15/h, truncation h⁸p⁽⁹⁾/630";
    }
  });
}

/// (5.4), 5.1: μ(v) = ⟨v, ·⟩, twice the polarised kinetic energy, is invertible, and μ⁻¹(−dU) = −grad U, i.e.
/// ⟨grad U, w⟩ = dU(w), the slope of U along w.
TEST(Statement_Eq5_4, MassOperatorIsInvertible) {
  for_each_chart([](const auto& chart) {
    using C = std::decay_t<decltype(chart)>;
    for (const auto& jet : jets_of(chart)) {
      const auto& [q, v, w] = jet;
      const auto K = [&, q = q](const Vector<C>& u) { return mechanics::kinetic_energy(chart, q, u); };
      const auto inner = [&](const Vector<C>& a, const Vector<C>& b) { return 0.5 * (K(a + b) - K(a - b)); };
      const Vector<C> p = mechanics::apply_mass(chart, q, v);
      EXPECT_NEAR(p.dot(w), inner(v, w), round_off * (1 + p.norm()));
      Vector<C> back;
      ASSERT_TRUE(mechanics::apply_inverse_mass(chart.metric(q), p, back));
      EXPECT_LT((back - v).norm(), round_off * 10);

      Vector<C> gradient;
      const Vector<C> dU = mechanics::potential_differential(chart, q);
      ASSERT_TRUE(mechanics::apply_inverse_mass(chart.metric(q), dU, gradient));
      const double slope = first_difference(
          [&, q = q, w = w](int k) { return mechanics::potential_energy(chart, q + 0.01 * k * w); }, 0.01);
      EXPECT_NEAR(inner(gradient, w), slope, 1e-12 * (1 + dU.norm())) << "round-off 1e-15/h, truncation h⁸";
    }
  });
}

/// Proposition 5.1.2: E_m = K + U is constant along the motions of a conservative system.
TEST(Statement_5_1_2, EnergyIsConstantOnConservativeMotions) {
  const ChartField field(pendulum);
  const State<ChartField<DoublePendulumChart>> start{0, {2.0, -1.0}, {0.3, 0.5}};
  const double E = field.energy(start.q, start.v);
  for (const auto& state : integrate_samples(field, start, 20, 40))
    EXPECT_NEAR(field.energy(state.q, state.v), E, 1e-11);  // some 10³ steps, each of local error 1e-13

  // The statement is about conservative systems: with drag the energy goes.
  const systems::Torus rough{{3, 1}, 1, 0.1, 0};
  const ChartField with_drag(rough);
  const auto end = integrate(with_drag, State<ChartField<systems::Torus>>{0, {1, 1}, {0.5, 0.2}}, 5);
  EXPECT_LT(with_drag.energy(end.q, end.v), with_drag.energy({1, 1}, {0.5, 0.2}) - 0.01);
}

/// Proposition 5.3.1: E = S + C_v(μ⁻¹F), S the geodesic flow.
TEST(Statement_5_3_1, FieldIsGeodesicFlowPlusVerticalLiftOfTheForce) {
  const ChartField<systems::TorusSurface> geodesics(systems::TorusSurface{});
  const systems::Torus torus{{3, 1}, 1.3, 0.4, 0.2};
  const ChartField field(torus);
  auto w = field.make_workspace();
  auto w_geodesics = geodesics.make_workspace();
  for (const auto& [q, v, ignored] : jets_of(torus)) {
    Vector2d E, S, lift;
    ASSERT_TRUE(field.acceleration(0, q, v, w, E));
    ASSERT_TRUE(geodesics.acceleration(0, q, v, w_geodesics, S));
    ASSERT_TRUE(mechanics::apply_inverse_mass(torus.metric(q), field.force(0, q, v), lift));
    EXPECT_LT((E - S - lift).norm(), round_off);
  }
}

/// Proposition 5.3.1: E_m⁻¹(h) is invariant, i.e. dE_m(E) = 0 everywhere, if F = −dU.
TEST(Statement_5_3_1, EnergyLevelsAreInvariant) {
  const auto derivative_of_energy = [](const auto& chart, const CurveJet& jet) {
    const ChartField field(chart);
    auto w = field.make_workspace();
    Vector2d a;
    EXPECT_TRUE(field.acceleration(0, jet.q, jet.v, w, a));
    // E_m is a function on TQ; the trajectory is (q + τ v, v + τ a) to first order.
    const auto q = taylor(CurveJet{jet.q, jet.v, Vector2d::Zero()});
    const Eigen::Matrix<TimeDual, 2, 2> g = chart.metric(q);
    double dE = chart.potential(q).value().derivatives()[0];
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        dE += 0.5 * g(i, j).value().derivatives()[0] * jet.v[i] * jet.v[j] + g(i, j).value().value() * jet.v[i] * a[j];
    return dE;
  };
  for (const CurveJet& jet : jets_of(pendulum)) {
    EXPECT_NEAR(derivative_of_energy(pendulum, jet), 0, round_off);
    EXPECT_NEAR(derivative_of_energy(SphereParticleChart(SphereParticle{}), jet), 0, round_off);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
