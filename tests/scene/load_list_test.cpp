/// What holds of every load of the list: absent by default, named in the lines of `check`, refused by equilibria with
/// its sentence, converted to internal units by the units of its entries, and its rate the derivative of its forcing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/run/scene_to_model.h"
#include "scene/needs.h"
#include "scene/owners.h"
#include "scene/scene_files.h"
#include "scene/validate.h"
#include "support/differences.h"

namespace pseudorigid::scene {
namespace {

bool has_line(const std::vector<std::string>& lines, std::string_view text) {
  return std::ranges::find(lines, text) != lines.end();
}

/// Calls check(load, filled) for every load, `filled` with diagonal matrices and numbers about 0.1, and with one plane.
template <class Check>
void for_each_load(const Check& check) {
  loads::Loads().for_each([&]<class L>(const L& absent) {
    L filled = absent;
    double next = 0.1;
    const auto fill = [&]<class Value, class Kind>(Value& member, const Kind&, const About& about) {
      SCOPED_TRACE(about.path);
      EXPECT_EQ(owner_of(test::test_catalogue(), about.path), ball) << "its section is one of the ball's";
      if constexpr (std::is_same_v<Value, Matrix3>)
        for (int i = 0; i < 3; ++i) member[i][i] = next += 0.01;
      else if constexpr (std::is_same_v<Value, std::vector<double>>)
        member.assign(std::is_same_v<Kind, Numbers> && about.path.starts_with("Loads/Plane") ? 1 : 3, next += 0.01);
      else
        member = next += 0.01;
    };
    L::visit_entries(filled, fill);
    check(absent, filled);
  });
}

TEST(EveryLoad, IsAbsentByDefaultAndHasItsLines) {
  const Scene plain = test::ball_scene();
  for_each_load([&]<class L>(const L& absent, const L& filled) {
    EXPECT_FALSE(loads::present(absent));
    EXPECT_TRUE(loads::present(filled));
    Scene scene = plain;
    scene.loads.get<L>() = filled;
    if (L::skipped.empty()) return;
    const loads::BodyFacts ball{.incompressible = true, .volume_by_inertia = 5};
    EXPECT_TRUE(has_line(needs(plain).skipped, L::skipped));
    EXPECT_TRUE(has_line(needs(scene).needed, filled.needed(ball))) << filled.needed(ball);
    EXPECT_FALSE(has_line(needs(scene).skipped, L::skipped));
  });
}

TEST(EveryLoad, IsKnownToEquilibriaOrRefused) {
  int n_refused = 0;
  for_each_load([&]<class L>(const L&, const L& filled) {
    Scene scene = test::ball_scene();
    scene.models = {"reduced"};
    scene.analysis = Analysis::equilibrium;
    EXPECT_NO_THROW(validate(scene, {}));
    scene.loads.get<L>() = filled;
    if (L::no_equilibria.empty()) {
      EXPECT_NO_THROW(validate(scene, {}));
      return;
    }
    ++n_refused;
    try {
      validate(scene, {});
      ADD_FAILURE() << L::no_equilibria;
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find(L::no_equilibria), std::string::npos) << error.what();
    }
  });
  EXPECT_GE(n_refused, 3);
}

/// Bodies rest under every load but those that depend on time, and planes.
TEST(EveryLoad, IsKnownToEquilibriaAtRestUnlessItDependsOnTime) {
  for_each_load([&]<class L>(const L&, const L& filled) {
    Scene scene = test::ball_scene();
    scene.models = {"reduced"};
    scene.analysis = Analysis::equilibrium;
    scene.equilibria.family = Family::at_rest;
    EXPECT_NO_THROW(validate(scene, {}));
    scene.loads.get<L>() = filled;
    constexpr bool is_known = [] {
      if constexpr (requires { L::has_static_equilibria; }) return L::has_static_equilibria;
      return !loads::DependsOnTime<L>;
    }();
    if (!is_known)
      EXPECT_THROW(validate(scene, {}), UserError);
    else
      EXPECT_NO_THROW(validate(scene, {}));
  });
}

/// Modes are those of the ball alone, with its own gravity or without.
TEST(EveryLoad, KeepsModesFromBeingThoseOfTheBallAlone) {
  for_each_load([&]<class L>(const L&, const L& filled) {
    Scene scene = test::ball_scene();
    scene.models = {"continuum"};
    scene.analysis = Analysis::modes;
    EXPECT_NO_THROW(validate(scene, {}));
    scene.loads.get<L>() = filled;
    if (std::same_as<L, loads::SelfGravity>)
      EXPECT_NO_THROW(validate(scene, {}));
    else
      EXPECT_THROW(validate(scene, {}), UserError);
  });
}

/// All of a forcing in one vector.
Eigen::VectorXd numbers(const loads::Forcing& forcing) {
  std::vector<double> values;
  loads::Forcing::visit_pairs(forcing, forcing, [&]<class Value>(const Value& value, const Value&) {
    if constexpr (std::is_same_v<Value, double>)
      values.push_back(value);
    else if constexpr (std::is_same_v<Value, loads::Planes>)
      for (const loads::Plane& plane : value)
        values.insert(values.end(),
                      {plane.normal[0], plane.normal[1], plane.normal[2], plane.position, plane.stiffness,
                       plane.damping, plane.friction, plane.slip_speed, plane.speed, plane.amplitude, plane.frequency});
    else if constexpr (std::is_same_v<Value, mechanics::Companions>)
      for (const mechanics::Companion& companion : value) {
        values.push_back(companion.mass);
        for (const Eigen::Vector3d& part : {companion.position, companion.velocity.value_or(Eigen::Vector3d::Zero())})
          values.insert(values.end(), part.data(), part.data() + 3);
      }
    else if constexpr (std::is_same_v<Value, loads::Branches>)
      for (const materials::MaxwellBranch& branch : value.list)
        values.insert(values.end(), {branch.modulus, branch.relaxation_time});
    else
      values.insert(values.end(), value.data(), value.data() + value.size());
  });
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

/// How far the rate at t is from the derivative, in its own size: of differences with steps of all sizes the one that
/// agrees best, since a load may vary on any scale of time. A wrong rate agrees with none of them.
template <class L>
double error_of_rate(const L& load, double t) {
  const Eigen::VectorXd rate = numbers(load.forcing_rate(t));
  double least = HUGE_VAL;
  for (double h = 1; h > 1e-5; h /= 4) {
    const auto value = [&](int k) { return numbers(load.forcing(t + k * h)); };
    least = std::min(least, (testing::first_difference(value, h) - rate).norm());
  }
  return least / (1e-12 + rate.norm());
}

/// A tide with this scale of time, and a rate that is wrong by this factor.
struct QuickTide {
  double scale, factor = 1;
  loads::Forcing forcing(double t) const { return {.pressure = std::cos(t / scale)}; }
  loads::Forcing forcing_rate(double t) const { return {.pressure = -factor * std::sin(t / scale) / scale}; }
};

TEST(ErrorOfRate, IsSmallForEveryScaleOfTimeAndOnlyForTheRightRate) {
  for (const double scale : {0.01, 0.1, 1.0, 10.0, 1000.0}) {
    EXPECT_LT(error_of_rate(QuickTide{scale}, 0.7), 1e-9) << scale;
    EXPECT_GT(error_of_rate(QuickTide{scale, 1.001}, 0.7), 9e-4) << scale;
    // 2 of small steps, and somewhat below 1 of those so large that the difference is nearly 0.
    EXPECT_GT(error_of_rate(QuickTide{scale, -1}, 0.7), 0.5) << scale;
  }
}

TEST(EveryLoad, HasTheRateOfItsForcing) {
  for_each_load([&]<class L>(const L&, const L& filled) {
    if constexpr (loads::DependsOnTime<L>) {
      EXPECT_LT(error_of_rate(filled, 0.7), 1e-9);
      const double largest = numbers(filled.largest_forcing()).norm();
      for (double time = 0; time < 100; time += 0.37) {
        EXPECT_LE(numbers(filled.forcing(time)).norm(), largest * (1 + 1e-14));
        EXPECT_FALSE(filled.forcing(time).dissipative()) << "the energy taken is that of constant coefficients";
        EXPECT_EQ(filled.forcing(time).gravity_constant, 0);
      }
    }
  });
}

/// The sum of loads that rise begins at 0 without a kink, ends at the full loads, and has its rate.
TEST(Rise, TakesEveryLoadWithAPotentialFromZeroToItsStrength) {
  struct Risen {
    loads::Loads loads;
    loads::Forcing forcing(double t) const { return loads::driving(loads, t); }
    loads::Forcing forcing_rate(double t) const { return loads::driving_rate(loads, t); }
  };
  Risen risen;
  for_each_load([&]<class L>(const L&, const L& filled) { risen.loads.get<L>() = filled; });
  Risen at_once = risen;
  at_once.loads.get<loads::Rise>() = {};
  risen.loads.get<loads::Rise>() = {5};
  EXPECT_TRUE(loads::depend_on_time(risen.loads));
  EXPECT_EQ(numbers(risen.forcing(0)).norm(), 0);
  EXPECT_EQ(numbers(risen.forcing_rate(0)).norm(), 0);
  for (const double t : {0.3, 2.5, 4.9, 7.0}) EXPECT_LT(error_of_rate(risen, t), 1e-9) << t;
  for (const double t : {5.0, 8.0}) {
    const auto all = [t](const Risen& r) -> Eigen::VectorXd {
      return numbers(loads::constant_forcing(r.loads)) + numbers(r.forcing(t));
    };
    EXPECT_LT((all(risen) - all(at_once)).norm(), 1e-15);
    EXPECT_LT((numbers(risen.forcing_rate(t)) - numbers(at_once.forcing_rate(t))).norm(), 1e-15);
  }
  const loads::Forcing constant = loads::constant_forcing(risen.loads);
  EXPECT_GT(constant.gravity_constant, 0);
  EXPECT_TRUE(constant.dissipative());
  EXPECT_TRUE(constant.quadratic.isZero(0) && constant.acceleration.isZero(0) && constant.pressure == 0);
}

TEST(Rise, OfNoLoadIsNoDependenceOnTime) {
  EXPECT_FALSE(loads::depend_on_time(loads::Loads{loads::Rise{5}}));
  EXPECT_FALSE(loads::depend_on_time(loads::at_constant_volume(loads::Loads{loads::Rise{5}, loads::Pressure{1}})));
  EXPECT_TRUE(loads::depend_on_time(loads::Loads{loads::Rise{5}, loads::Pressure{1}}));
}

/// Another choice of units for the same body and the same loads has the same internal values.
TEST(EveryLoad, HasInternalValuesByTheUnitsOfItsEntries) {
  const double length = 2.5, density = 3, time = 0.7;
  const io::Units units = io::ball_units(length, density, time);
  for_each_load([&]<class L>(const L&, const L& filled) {
    Scene scene = test::ball_scene();
    scene.loads.get<L>() = filled;
    Scene other = scene;
    other.body.radius *= length;
    other.body.density *= density;
    other.material.shear_modulus = units.to_physical(scene.material.shear_modulus, "pressure");
    const auto scale = [&](auto& member, const auto&, const About& about) {
      const auto in_these_units = [&](double& value) { value = units.to_physical(value, about.unit); };
      using Value = std::decay_t<decltype(member)>;
      if constexpr (std::is_same_v<Value, double>)
        in_these_units(member);
      else if constexpr (std::is_same_v<Value, std::optional<double>>)
        in_these_units(*member);
      else if constexpr (std::is_same_v<Value, Matrix3>)
        for (auto& row : member) std::ranges::for_each(row, in_these_units);
      else if constexpr (!std::is_same_v<Value, bool>)
        std::ranges::for_each(member, in_these_units);
    };
    L::visit_entries(other.loads.get<L>(), scale);
    const auto forcing_of = [](const Scene& s) { return loads::largest_forcing(app::internal_loads(s).get<L>()); };
    const loads::Forcing a = forcing_of(scene), b = forcing_of(other);
    EXPECT_LT((numbers(a) - numbers(b)).norm(), 1e-14);
  });
}

}  // namespace
}  // namespace pseudorigid::scene
