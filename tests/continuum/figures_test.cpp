/// Figures of equilibrium of the finite-element ball and small motions about them, in internal units μ = ρ = r = 1.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "continuum/modes/modes.h"
#include "continuum/statics/figure_stability.h"
#include "continuum/statics/observe_figure.h"
#include "materials/law_table.h"
#include "polynomial/body_figure_finder.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using namespace continuum;
using mechanics::EquilibriumFigure, mechanics::Figure, mechanics::FigureParameter;

FigureSetup setup_of(std::string_view law, Drive drive, Figure figure, int degree, int refinements = 0,
                     bool incompressible = true) {
  return {.degree = degree,
          .n_refinements = refinements,
          .stored = {materials::make_law(law, {.shear_modulus = 1, .lame_lambda = 3}, incompressible), 0},
          .loads = {},
          .incompressible = incompressible,
          .drive = drive,
          .figure = figure};
}

/// A spinning neo-Hookean ball with self-gravity of the strength γ = ρgr/μ.
FigureSetup spinning(int degree, int refinements = 0, double gamma = 0, Figure figure = Figure::spheroid) {
  FigureSetup setup = setup_of("neo-hookean", Drive::rotation, figure, degree, refinements);
  setup.loads.get<loads::SelfGravity>().constant = 3 * gamma / (4 * std::numbers::pi);
  setup.stored.volumetric_stiffness = gamma / 2;  // as a scene chooses it
  return setup;
}

/// The figure with the drive or the ratio of axes `value`, found from the undeformed ball.
EquilibriumFigure figure_at(const BallFigures& figures, FigureParameter parameter, double value) {
  EquilibriumFigure figure = figures.affine(Eigen::Vector3d::Ones(), 0);
  mechanics::Status status = figures.solve({parameter, 0}, figure);
  if (status) status = figures.follow(0, {parameter, value}, figure);
  EXPECT_TRUE(status) << status.reason();
  EXPECT_LT(figure.residual, 1e-11);
  return figure;
}

struct Observed {
  mechanics::ContinuumObservables o;
  Eigen::Vector3d surface = Eigen::Vector3d::Zero();
};
Observed observed(const BallFigures& figures, const EquilibriumFigure& figure) {
  Observed result;
  EXPECT_TRUE(observe_figure(figures, figure, result.o, result.surface));
  return result;
}

std::vector<double> frequencies(const std::vector<mechanics::ClassStability>& classes) {
  std::vector<double> all;
  for (const auto& of_class : classes)
    for (const auto& rate : of_class.stability.rates)
      if (rate.s.imag() > 0) all.push_back(rate.s.imag());
  std::ranges::sort(all);
  return all;
}

/// Under a dead traction P̄ the deformation F is homogeneous, P(F) − λF⁻ᵀ = P̄, for every law and mesh.
TEST(BallFigures, AreHomogeneousUnderDeadTraction) {
  for (const bool incompressible : {true, false})
    for (const char* law : {"neo-hookean", "mooney-rivlin", "gent"}) {
      FigureSetup setup = setup_of(law, Drive::loads, Figure::ellipsoid, 3, 0, incompressible);
      const Eigen::Vector3d traction(0.4, 0.1, -0.2);
      setup.loads.get<loads::Traction>().nominal_stress = {0.4, 0, 0, 0, 0.1, 0, 0, 0, -0.2};
      const BallFigures figures(setup);
      const EquilibriumFigure figure = figure_at(figures, FigureParameter::drive, 1);
      const Observed seen = observed(figures, figure);
      EXPECT_LT(seen.o.nonaffine_displacement, 1e-12) << law;
      const Eigen::Vector3d a = seen.o.Q.diagonal();
      const auto stress = std::visit(
          [&](const auto& known) {
            return known.stress(materials::Tensor<double>{{{a[0], 0, 0}, {0, a[1], 0}, {0, 0, a[2]}}});
          },
          setup.stored.law);
      const double lambda = incompressible ? (stress(0, 0) - traction[0]) * a[0] : 0;
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(stress(i, i) - lambda / a[i], traction[i], 1e-12) << law;
    }
}

/// Chree: the ellipticity of the surface is 5/38 Ω² for small spins, and the mean strain −1/15 Ω² along the axis.
TEST(BallFigures, OfSmallSpinHaveTheEllipticityOfChree) {
  const auto error_of = [](int degree, int refinements) {
    const BallFigures figures(spinning(degree, refinements));
    const auto coefficients = [&](double spin_squared) -> Eigen::Vector2d {
      const Observed seen = observed(figures, figure_at(figures, FigureParameter::drive, spin_squared));
      return Eigen::Vector2d(seen.surface[0] - seen.surface[2], seen.o.F(2, 2) - 1) / spin_squared;
    };
    // The extrapolation to Ω = 0 leaves an error of the order Ω⁴.
    const Eigen::Vector2d limit = 2 * coefficients(1e-4) - coefficients(2e-4);
    return Eigen::Vector2d((limit - Eigen::Vector2d(5.0 / 38, -1.0 / 15)).cwiseAbs());
  };
  std::vector<ErrorPoint> points;
  for (const int r : {0, 1, 2}) points.push_back({std::pow(0.5, r), error_of(2, r)[0]});
  EXPECT_GT(fit_order(points).order, 2.5) << points[0].error << ' ' << points[1].error << ' ' << points[2].error;
  const Eigen::Vector2d of_degree_6 = error_of(6, 0);
  EXPECT_LT(of_degree_6[0], 1e-6);
  EXPECT_LT(of_degree_6[1], 1e-7);
}

/// Without rotation, the rates are the frequencies of modes.h.
TEST(FigureStability, AtRestIsThatOfTheModes) {
  FigureSetup setup = spinning(3);
  const BallFigures figures(setup);
  const EquilibriumFigure rest = figure_at(figures, FigureParameter::drive, 0);
  std::vector<mechanics::ClassStability> classes;
  ASSERT_TRUE(stability_of(figures, rest, 6, {}, classes));
  const std::vector<double> found = frequencies(classes);
  const RestProblem problem(figures.body().space(), figures.body().kernels(), setup.stored, true);
  std::vector<BallFrequency> modes;
  ModesReport report;
  ASSERT_TRUE(ball_modes(problem, 2, modes, report));
  // T2 and S2, five copies each, which the mesh separates
  EXPECT_NEAR(found.front(), modes[0].least, 1e-10);
  EXPECT_NEAR(found[4], modes[0].largest, 1e-10);
  EXPECT_NEAR(found[5], modes[1].least, 1e-10);
  EXPECT_NEAR(found[9], modes[1].largest, 1e-10);
}

/// The force of Coriolis splits a toroidal frequency of degree n by ±mΩ/(n(n + 1)) to first order. For T2 and m = 1 the
/// difference of the pair is Ω/3, up to terms of order Ω³.
TEST(FigureStability, SlowRotationSplitsToroidalModes) {
  std::vector<ErrorPoint> points;
  for (const double spin : {0.05, 0.1, 0.2}) {
    const BallFigures figures(spinning(4));
    const EquilibriumFigure figure = figure_at(figures, FigureParameter::drive, spin * spin);
    std::vector<mechanics::ClassStability> classes;
    ASSERT_TRUE(stability_of(figures, figure, 6, {}, classes));
    const auto& even_in_z = classes[1];  // odd under the half turn: T2 with m = ±1 is the lowest pair
    ASSERT_FALSE(even_in_z.motions.odd_in_z);
    ASSERT_EQ(even_in_z.motions.m, 1);
    const std::vector<double> pair = frequencies({even_in_z});
    points.push_back({spin, std::abs((pair[1] - pair[0]) / spin - 1.0 / 3)});
  }
  EXPECT_NEAR(fit_order(points).order, 2, 0.1);
  EXPECT_LT(points[0].error, 1e-3);
}

/// The figure and the rates of a fast rotation are those of a polynomial body of high degree.
TEST(BallFigures, OfAFastSpinAgreeWithAPolynomialBody) {
  const double ratio = -0.4;  // ln(a₃/a₁), at Ω = 1.5
  const BallFigures figures(spinning(5));
  const EquilibriumFigure figure = figure_at(figures, FigureParameter::log_ratio_31, ratio);
  const polynomial::BodySetup setup{.degree = 9, .law = materials::make_law("neo-hookean", {.shear_modulus = 1}, true)};
  polynomial::BodyFigureFinder finder(setup, true, {Figure::spheroid, [](double value) -> mechanics::FigureCondition {
                                                      return {FigureParameter::log_ratio_31, value};
                                                    }});
  mechanics::FigureMember member;
  ASSERT_TRUE(finder.member(ratio, member));
  EXPECT_NEAR(figure.drive, member.figure.drive, 1e-6);
  std::vector<mechanics::ClassStability> classes;
  ASSERT_TRUE(stability_of(figures, figure, 12, {}, classes));
  const std::vector<double> found = frequencies(classes), expected = frequencies(member.classes);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(found[i], expected[i], 2e-5) << i;
  for (const auto& of_class : classes) EXPECT_EQ(of_class.stability.n_negative, 0);
}

/// With gravity, the spins of polynomial bodies with a ratio of axes tend to the spin of the elements. Beyond the
/// bifurcation to ellipsoids, both have the same number of negative directions of the energy.
TEST(BallFigures, WithGravityAreTheLimitOfPolynomialBodies) {
  const double gamma = 10, e = 0.93, ratio = 0.5 * std::log1p(-e * e);
  std::vector<double> squares, of_polynomials;
  int n_negative = 0, expected = 0;
  for (const int degree : {3, 4}) {
    const BallFigures figures(spinning(degree, 0, gamma));
    const EquilibriumFigure figure = figure_at(figures, FigureParameter::log_ratio_31, ratio);
    squares.push_back(figure.drive);
    if (degree > 3) continue;
    std::vector<mechanics::ClassStability> classes;
    ASSERT_TRUE(stability_of(figures, figure, 8, {}, classes));
    for (const auto& of_class : classes) n_negative += of_class.stability.n_negative;
  }
  for (const int degree : {5, 7}) {
    polynomial::BodySetup setup{.degree = degree,
                                .law = materials::make_law("neo-hookean", {.shear_modulus = 1}, true)};
    setup.volumetric_stiffness = gamma / 2;
    setup.loads.get<loads::SelfGravity>().constant = 3 * gamma / (4 * std::numbers::pi);
    polynomial::BodyFigureFinder finder(setup, true, {Figure::spheroid, [](double value) -> mechanics::FigureCondition {
                                                        return {FigureParameter::log_ratio_31, value};
                                                      }});
    mechanics::FigureMember member;
    ASSERT_TRUE(finder.member(ratio, member));
    of_polynomials.push_back(member.figure.drive);
    if (degree > 5) continue;
    for (const auto& of_class : member.classes) expected += of_class.stability.n_negative;
  }
  EXPECT_NEAR(squares[0], squares[1], 1e-4 * squares[1]);
  const double of_5 = std::abs(of_polynomials[0] - squares[1]), of_7 = std::abs(of_polynomials[1] - squares[1]);
  EXPECT_LT(of_7, of_5 / 3);
  EXPECT_LT(of_7, 1e-3 * squares[1]);
  EXPECT_EQ(n_negative, expected);
  EXPECT_GT(n_negative, 0);
}

/// A tide that pulls the ball apart: the loads rise until no figure is found, and the last one is kept.
TEST(BallFigures, KeepTheLastFigureIfTheFamilyEnds) {
  FigureSetup setup = setup_of("neo-hookean", Drive::loads, Figure::ellipsoid, 3);
  setup.stored.volumetric_stiffness = 3;
  setup.loads.get<loads::Tide>().tensor = {-6, 0, 0, 0, -6, 0, 0, 0, 12};
  const BallFigures figures(setup);
  EquilibriumFigure figure = figures.affine(Eigen::Vector3d::Ones(), 0);
  ASSERT_TRUE(figures.solve({FigureParameter::drive, 0}, figure));
  EXPECT_FALSE(figures.follow(0, {FigureParameter::drive, 1}, figure));
  EXPECT_GT(figure.drive, 0.05);
  EXPECT_LT(figure.drive, 1);
  EquilibriumFigure again = figure;
  EXPECT_TRUE(figures.solve({FigureParameter::drive, figure.drive}, again));
  EXPECT_LT((again.x - figure.x).norm(), 1e-9);
}

}  // namespace
}  // namespace pseudorigid::testing
