#include "io/trajectory.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace pseudorigid::io::test {
namespace {

using mechanics::ContinuumObservables;

constexpr scene::Quantities everything{.orbit = false};  // by default, of a body without companions
using Reduced = Trajectory<mechanics::ReducedObservables>;
using Continuum = Trajectory<ContinuumObservables>;
const std::string reduced_header =
    "time,Q11,Q12,Q13,Q21,Q22,Q23,Q31,Q32,Q33,Qdot11,Qdot12,Qdot13,Qdot21,Qdot22,Qdot23,Qdot31,Qdot32,Qdot33,"
    "x1,x2,x3,v1,v2,v3,kinetic,elastic,gravitational,external,dissipated,energy,J1,J2,J3,Z1,Z2,Z3,"
    "volume_ratio,multiplier,a1,a2,a3";
const std::string continuum_header =
    reduced_header +
    ",F11,F12,F13,F21,F22,F23,F31,F32,F33,nonaffine_kinetic_fraction,nonaffine_displacement,min_jacobian,volume_error,"
    "max_volume_error";

Eigen::Matrix3d diagonal(double a, double b, double c) { return Eigen::Vector3d(a, b, c).asDiagonal(); }

/// Every number another one, so that no two columns can be mistaken for each other.
ContinuumObservables distinct_observables() {
  ContinuumObservables o;
  o.Q << 11, 12, 13, 21, 22, 23, 31, 32, 33;
  o.Qdot = o.Q.array() + 100;
  o.F = o.Q.array() + 200;
  o.center << 41, 42, 43;
  o.velocity << 51, 52, 53;
  o.kinetic = 61, o.elastic = 62, o.gravitational = 63, o.external = 64, o.dissipated = 65;
  o.angular_momentum << 71, 72, 73;
  o.circulation << 81, 82, 83;
  o.volume_ratio = 91;
  o.multiplier = 92;
  o.semi_axes << 95, 94, 93;
  o.over_points = {3, 0.5};
  o.volumetric = 99, o.nonaffine_kinetic_fraction = 96, o.nonaffine_displacement = 97, o.min_jacobian = 98;
  o.volume_error = 1, o.max_volume_error = 2;
  o.orbit.position << 101, 102, 103;
  o.orbit.velocity << 104, 105, 106;
  o.orbit.second_position << 107, 108, 109;
  o.orbit.second_velocity << 110, 111, 112;
  o.orbit.elements = {113, 114, 115, 116, 117, 118};
  o.orbit.lag = 119, o.orbit.k2 = 120, o.orbit.inverse_Q = 121, o.orbit.obliquity = 122;
  o.orbit.torque << 123, 124, 125;
  o.orbit.spin << 126, 127, 128;
  o.orbit.total_momentum << 129, 130, 131;
  o.stress = {132, 133, 134};
  return o;
}

double value(const std::vector<std::string>& columns, const std::vector<double>& row, const std::string& name) {
  return row.at(std::ranges::find(columns, name) - columns.begin());
}

TEST(Trajectory, HeadersAreThoseOfTheContract) {
  EXPECT_EQ(fmt::format("{}", fmt::join(Reduced(everything).names(), ",")), reduced_header);
  EXPECT_EQ(fmt::format("{}", fmt::join(Continuum(everything).names(), ",")), continuum_header);
}

TEST(Trajectory, EveryGroupCanBeLeftOutAndTimeStays) {
  const scene::Quantities nothing{false, false, false, false, false, false, false, false, false, false};
  EXPECT_EQ(Reduced(nothing).names(), std::vector<std::string>{"time"});
  const ContinuumObservables o = distinct_observables();
  constexpr scene::Quantities all_groups{true, true, true, true, true, true, true, true,
                                         true, true, true, true, true, true, true, true};
  const std::vector<std::string> all = Continuum(all_groups).names();
  std::vector<double> full_row, row;
  Continuum(all_groups).row(7, o, full_row);
  for (int mask = 0; mask < 2048; ++mask) {
    const scene::Quantities some{bool(mask & 1),   bool(mask & 2),   bool(mask & 4),   bool(mask & 8),
                                 bool(mask & 512), bool(mask & 16),  bool(mask & 32),  bool(mask & 64),
                                 bool(mask & 128), bool(mask & 256), bool(mask & 1024)};
    const Continuum trajectory(some);
    const std::vector<std::string>& columns = trajectory.names();
    trajectory.row(7, o, row);
    ASSERT_EQ(columns.size(), row.size());
    for (std::size_t i = 0; i < row.size(); ++i) EXPECT_EQ(row[i], value(all, full_row, columns[i])) << columns[i];
    mechanics::ReducedObservables of_reduced{o};
    of_reduced.over_points.clear();
    Reduced(some).row(7, of_reduced, row);
    EXPECT_EQ(row.size(), Reduced(some).names().size());
  }
}

TEST(Trajectory, ValuesStandUnderTheirNames) {
  std::vector<double> row;
  Continuum(everything).row(7, distinct_observables(), row);
  const auto columns = Continuum(everything).names();
  const std::vector<std::pair<std::string, double>> expected{{"time", 7},
                                                             {"Q12", 12},
                                                             {"Q21", 21},
                                                             {"Qdot13", 113},
                                                             {"x3", 43},
                                                             {"v1", 51},
                                                             {"kinetic", 61},
                                                             {"elastic", 62},
                                                             {"J2", 72},
                                                             {"gravitational", 63},
                                                             {"external", 64},
                                                             {"dissipated", 65},
                                                             {"energy", 315},
                                                             {"Z3", 83},
                                                             {"volume_ratio", 91},
                                                             {"a1", 95},
                                                             {"a3", 93},
                                                             {"F32", 232},
                                                             {"F23", 223},
                                                             {"nonaffine_kinetic_fraction", 96},
                                                             {"a2", 94},
                                                             {"multiplier", 92},
                                                             {"min_jacobian", 98},
                                                             {"J1", 71},
                                                             {"nonaffine_displacement", 97},
                                                             {"volume_error", 1},
                                                             {"max_volume_error", 2}};
  for (const auto& [name, number] : expected) EXPECT_EQ(value(columns, row, name), number) << name;
}

TEST(Trajectory, UnitsHaveTheDimensionOfEachColumn) {
  // Powers of two, so that the products are exact: length 2, mass 4, time 1/8.
  const Units units{.length = 2, .mass = 4, .time = 0.125};
  std::vector<double> plain, scaled;
  Continuum(everything).row(7, distinct_observables(), plain);
  Continuum(everything, units).row(7, distinct_observables(), scaled);
  const auto columns = Continuum(everything).names();
  const auto factor = [&](const std::string& name) {
    return value(columns, scaled, name) / value(columns, plain, name);
  };
  for (const char* name : {"time", "Q11", "Q23", "F31", "volume_ratio", "min_jacobian", "volume_error",
                           "max_volume_error", "nonaffine_kinetic_fraction"})
    EXPECT_EQ(factor(name), 1) << name;
  for (const char* name : {"Qdot11", "Qdot32"}) EXPECT_EQ(factor(name), 8) << name;
  for (const char* name : {"x1", "a1", "a2", "a3"}) EXPECT_EQ(factor(name), 2) << name;
  for (const char* name : {"v1", "v3"}) EXPECT_EQ(factor(name), 2 * 8) << name;
  for (const char* name : {"kinetic", "elastic", "gravitational", "external", "dissipated", "energy"})
    EXPECT_EQ(factor(name), 4 * 4 * 64) << name;
  for (const char* name : {"J1", "J3", "Z1", "Z2"}) EXPECT_EQ(factor(name), 4 * 4 * 8) << name;
  EXPECT_EQ(factor("multiplier"), 64);
}

/// Of a pure shear with F = diag(3, 1/3, 2), everywhere the same but for one point.
TEST(Trajectory, StretchesAreSingularValues) {
  std::vector<double> row;
  const scene::Quantities stretches{false, false, false, false, false, false, false, false, false, true};
  const Continuum trajectory(stretches);
  ContinuumObservables o;
  o.F = diagonal(3, 1.0 / 3, 2);
  o.over_points = mechanics::observe_over_points(trajectory.request(), [](const auto& value) {
    return std::min(value(diagonal(3, 1.0 / 3, 2)), value(diagonal(5, 0.2, 1)));
  });
  trajectory.row(0, o, row);
  EXPECT_EQ(trajectory.names(),
            (std::vector<std::string>{"time", "stretch1", "stretch2", "stretch3", "max_stretch", "min_stretch"}));
  const double expected[] = {0, 3, 2, 1.0 / 3, 5, 0.2};
  for (std::size_t i = 0; i < row.size(); ++i) EXPECT_NEAR(row[i], expected[i], 1e-15) << i;
}

/// A model that forgets an observable has no number for it, not a zero.
TEST(Trajectory, WhatIsNotObservedIsNoNumber) {
  std::vector<double> row;
  Reduced(everything).row(0, {}, row);
  EXPECT_TRUE(std::all_of(row.begin() + 1, row.end(), [](double x) { return std::isnan(x); }));
  Continuum(everything).row(0, {}, row);
  EXPECT_TRUE(std::all_of(row.begin() + 1, row.end(), [](double x) { return std::isnan(x); }));
}

/// Who asks for a group has it, whatever else is asked for.
TEST(Trajectory, EveryGroupIsAskedForByItsWord) {
  for (const mechanics::QuantityGroup& group : mechanics::quantity_groups) {
    scene::Quantities alone{false, false, false, false, false, false, false, false, false, false};
    alone.*group.member = true;
    EXPECT_TRUE(Reduced(alone).request().*group.member) << group.name;
    EXPECT_GT(Reduced(alone).names().size() + Continuum(alone).names().size(), 2u) << group.name;
  }
}

/// Each documented column stands for one to nine of the header.
TEST(Trajectory, EveryColumnIsDocumented) {
  for (const scene::Column& column : documented_columns<ContinuumObservables>()) {
    EXPECT_FALSE(column.documentation.empty()) << column.name;
    const std::string first = column.name.substr(0, column.name.find(' '));
    constexpr scene::Quantities all_groups{true, true, true, true, true, true, true, true,
                                           true, true, true, true, true, true, true, true};
    EXPECT_EQ(std::ranges::count(Continuum(all_groups).names(), first), 1) << first;
  }
}

/// Every unit of a column, against the product of its factors.
TEST(Units, AreProductsOfTheirFactors) {
  const Units units{.length = 3, .mass = 5, .time = 7};
  struct {
    scene::Unit unit;
    double factor;
  } const expected[] = {{"", 1},
                        {"length", 3},
                        {"length/time", 3.0 / 7},
                        {"1/time", 1.0 / 7},
                        {"1/time^2", 1.0 / 49},
                        {"mass*length^2/time", 45.0 / 7},
                        {"mass*length^2/time^2", 45.0 / 49},
                        {"pressure", 5.0 / (3 * 49)},
                        {"pressure*time", 5.0 / (3 * 7)},
                        {"length^3/mass/time^2", 27.0 / (5 * 49)}};
  for (const auto& [unit, factor] : expected)
    EXPECT_DOUBLE_EQ(units.to_physical(2, unit), 2 * factor) << std::string_view(unit);
}

TEST(Units, OfABallAreRadiusMassAndWaveTime) {
  const Units units = ball_units(3, 5, 1);  // r/c with c = √(45/5) = 3
  EXPECT_DOUBLE_EQ(units.length, 3);
  EXPECT_DOUBLE_EQ(units.mass, 5 * 27);
  EXPECT_DOUBLE_EQ(units.time, 1);
  EXPECT_DOUBLE_EQ(units.stress(), 45);  // the unit of stress is the shear modulus
}

}  // namespace
}  // namespace pseudorigid::io::test
