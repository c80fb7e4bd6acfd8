/// Behind one type a system is what it was: the same numbers to the last bit, and the same methods fit.

#include <gtest/gtest.h>

#include "mechanics/core/any_field.h"
#include "mechanics/core/any_system.h"
#include "mechanics/core/chart_field.h"
#include "mechanics/core/field_of.h"
#include "mechanics/methods/methods.h"
#include "systems/sample_systems.h"
#include "systems/spherical_pendulum_scene.h"
#include "systems/torus.h"

namespace pseudorigid::testing {
namespace {

using Eigen::VectorXd;
using mechanics::AnyField, mechanics::AnySystem, mechanics::State, mechanics::detail::flat;

/// A multiplier behind AnySystem; of no constraints there is none.
template <class Any, class Multiplier>
typename Any::Multiplier erased(const Multiplier& lambda) {
  if constexpr (Any::n_constraints == 0)
    return {};
  else
    return flat(lambda);
}

template <class S>
using AnyOf = AnySystem<mechanics::unconstrained<S> ? 0 : mechanics::dynamic_constraints>;

/// `v` and `lambda` are any, the state is on the constraints or near.
template <class S>
void expect_same_functions(const S& system, const typename S::Vector& q, const typename S::Vector& v,
                           const typename S::Multiplier& lambda) {
  using Any = AnyOf<S>;
  const Any any(system);
  const VectorXd x = flat(q), y = flat(v);
  auto w = system.make_workspace();
  auto any_w = any.make_workspace();
  auto f = system.make_vector(), g = f;
  VectorXd any_f = any.make_vector(), any_g = any_f;
  auto r = system.make_multiplier();
  auto any_r = any.make_multiplier();
  const auto any_lambda = erased<Any>(lambda);

  ASSERT_TRUE(system.force(0.3, q, v, w, f).ok() && any.force(0.3, x, y, any_w, any_f).ok());
  EXPECT_EQ(flat(f), any_f);
  system.apply_inverse_mass(f, f);
  any.apply_inverse_mass(any_f, any_f);
  EXPECT_EQ(flat(f), any_f) << "in place";
  system.apply_mass(v, f);
  any.apply_mass(y, any_f);
  EXPECT_EQ(flat(f), any_f);
  EXPECT_EQ(system.kinetic_energy(v), any.kinetic_energy(y));
  EXPECT_EQ(system.potential_energy(q), any.potential_energy(x));

  system.add_reaction(q, lambda, f);
  any.add_reaction(x, any_lambda, any_f);
  EXPECT_EQ(flat(f), any_f) << "added to what was there";
  system.add_reaction_rate(q, v, lambda, f);
  any.add_reaction_rate(x, y, any_lambda, any_f);
  EXPECT_EQ(flat(f), any_f);

  const auto expect_same_multipliers = [&] {
    if constexpr (Any::n_constraints != 0) {
      EXPECT_EQ(flat(r), any_r);
    }
  };
  ASSERT_TRUE(system.constraint(q, r).ok() && any.constraint(x, any_r).ok());
  expect_same_multipliers();
  system.constraint_rate(q, v, r);
  any.constraint_rate(x, y, any_r);
  expect_same_multipliers();
  system.constraint_curvature(q, v, r);
  any.constraint_curvature(x, y, any_r);
  expect_same_multipliers();
  ASSERT_TRUE(system.solve_gram(q, q, lambda, w, r).status && any.solve_gram(x, x, any_lambda, any_w, any_r).status);
  expect_same_multipliers();

  ASSERT_EQ(system.n_symmetries(), any.n_symmetries());
  for (int i = 0; i < system.n_symmetries(); ++i) {
    system.symmetry(i, q, v, f, g);
    any.symmetry(i, x, y, any_f, any_g);
    EXPECT_EQ(flat(f), any_f);
    EXPECT_EQ(flat(g), any_g);
  }

  EXPECT_EQ(any.constraint_tolerance(), system.constraint_tolerance());
  EXPECT_EQ(any.velocity_dependent(), mechanics::velocity_dependent(system));
  EXPECT_EQ(any.dissipative(), mechanics::dissipative(system));
  EXPECT_EQ(any.time_dependent(), mechanics::time_dependent(system));
}

/// Steps of RATTLE, and of the explicit method.
template <class S>
void expect_same_steps(const S& system, const State<S>& start) {
  using mechanics::Rattle, mechanics::DormandPrince8;
  const AnyOf<S> any(system);
  State<S> state = start;
  State<AnyOf<S>> any_state{start.t, flat(start.q), flat(start.v)};
  {
    Rattle::Workspace<S> w(system);
    Rattle::Workspace<AnyOf<S>> any_w(any);
    for (int i = 0; i < 100; ++i) {
      ASSERT_TRUE(Rattle::advance(system, 0.01, state, w));
      ASSERT_TRUE(Rattle::advance(any, 0.01, any_state, any_w));
    }
    ASSERT_TRUE(Rattle::project_velocity(system, state, w));
    ASSERT_TRUE(Rattle::project_velocity(any, any_state, any_w));
  }
  EXPECT_EQ(flat(state.q), any_state.q);
  EXPECT_EQ(flat(state.v), any_state.v);

  const auto field = mechanics::field_of(system);
  const auto any_field = mechanics::field_of(any);
  auto w = field.make_workspace();
  auto any_w = any_field.make_workspace();
  auto a = system.make_vector();
  VectorXd any_a = any.make_vector();
  ASSERT_TRUE(field.acceleration(state.t, state.q, state.v, w, a).ok() &&
              any_field.acceleration(state.t, any_state.q, any_state.v, any_w, any_a).ok());
  EXPECT_EQ(flat(a), any_a);
  state.q *= 1 + 1e-9;
  any_state.q *= 1 + 1e-9;
  ASSERT_TRUE(field.project(state.q, state.v, w).ok() && any_field.project(any_state.q, any_state.v, any_w).ok());
  EXPECT_EQ(flat(state.q), any_state.q);
  EXPECT_EQ(flat(state.v), any_state.v);
}

TEST(AnySystem, DoublePendulum) {
  const systems::DoublePendulum pendulum(generic_pendulum);
  const auto s = swinging(pendulum);
  expect_same_functions(pendulum, s.q, s.v, {0.4, -1.1});
  expect_same_steps(pendulum, s);
}

TEST(AnySystem, OneConstraint) {
  const systems::SphericalPendulum pendulum({.m = 2, .l = 1.5, .g = 0.7, .c = 0.1});
  const State<systems::SphericalPendulum> s{0, {0, 0.9, -1.2}, {0.4, 0, 0}};
  expect_same_functions(pendulum, s.q, s.v, -1.9);
}

TEST(AnySystem, RigidBodies) {
  const Eigen::Vector3d Omega(0.3, -0.2, 1.1);
  const systems::FixedPointBody top({tilted_E0(), generic_loads()});
  const auto turning = systems::turning(generic_rotation(), Omega);
  const systems::FixedPointBody::Multiplier lambda{0.2, -0.4, 0.1, 0.7, -0.3, 0.5};
  expect_same_functions(top, turning.q, turning.v, lambda);
  expect_same_steps(top, turning);
  const systems::FreeBody body({tilted_E0(), generic_loads_about_the_center()});
  const auto flying = systems::turning(generic_rotation(), Omega, {0.1, 0.2, 0.3}, {-0.2, 0.1, 0.4});
  expect_same_functions(body, flying.q, flying.v, lambda);
  expect_same_steps(body, flying);
}

TEST(AnySystem, WithoutConstraints) {
  auto parameters = isolated_points();
  parameters.drag = 0.1;
  const systems::MassPoints points(parameters);
  expect_same_functions(points, four_points().q, four_points().v, {});
  expect_same_steps(points, four_points());
}

template <class Field>
void expect_same_field(const Field& field, const State<Field>& s) {
  const AnyField any(field);
  VectorXd x = flat(s.q), y = flat(s.v), any_a = any.make_vector();
  auto w = field.make_workspace();
  auto any_w = any.make_workspace();
  auto a = field.make_vector();
  ASSERT_TRUE(field.acceleration(0.2, s.q, s.v, w, a).ok() && any.acceleration(0.2, x, y, any_w, any_a).ok());
  EXPECT_EQ(flat(a), any_a);
  EXPECT_EQ(any.velocity_dependent(), mechanics::velocity_dependent(field));
  EXPECT_EQ(any.dissipative(), mechanics::dissipative(field));
  EXPECT_EQ(any.time_dependent(), mechanics::time_dependent(field));
  auto q = s.q, v = s.v;
  if constexpr (mechanics::ProjectedField<Field>) {
    ASSERT_TRUE(field.project(q, v, w));
  }
  ASSERT_TRUE(any.project(x, y, any_w));
  EXPECT_EQ(flat(q), x);
  EXPECT_EQ(flat(v), y);
}

TEST(AnyField, Chart) {
  using Torus = mechanics::ChartField<systems::Torus>;
  expect_same_field(Torus(systems::Torus{{3, 1}, 1, 0.2, 0.1}), State<Torus>{0, {0.4, 1.1}, {0.3, -0.2}});
}

TEST(AnyField, WithInvariantManifold) {
  const auto top = HeavyTop{}.by_euler();
  auto s = top.turning(generic_rotation(), {0.3, -0.2, 1.1});
  s.q *= 1.01;
  expect_same_field(top, s);
}

/// The pendulum that does not say what its energies are.
struct WithoutEnergies : systems::SphericalPendulum {
  using SphericalPendulum::SphericalPendulum;
  double kinetic_energy(const Vector&) const = delete;
};

TEST(AnySystem, FitsTheMethodsThatItsOwnTypeFits) {
  const auto expect_same = []<class S>(const S& system) {
    const AnyOf<S> any(system);
    mechanics::for_each_method([&]<class Method>(Method) {
      constexpr bool fits = mechanics::method_fits<Method, S>();
      EXPECT_EQ(mechanics::fits<Method>(any), fits) << Method::name;
    });
  };
  expect_same(systems::SphericalPendulum({}));
  expect_same(WithoutEnergies(systems::SphericalPendulum::Parameters{}));
  expect_same(systems::MassPoints(isolated_points()));
  static_assert(!mechanics::method_fits<mechanics::EnergyMomentum, WithoutEnergies>());
}

}  // namespace
}  // namespace pseudorigid::testing
