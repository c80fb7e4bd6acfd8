/// Polynomial bodies that turn steadily: figures, spectrum, special points. Internal units, μ = ρ = r = 1 where there
/// is elasticity, πGρ = 1 for the fluid.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "polynomial/body_figure_finder.h"
#include "polynomial/rest_modes.h"
#include "reduced/equilibrium_families.h"
#include "reduced/potential.h"

namespace pseudorigid::testing {
namespace {

using namespace polynomial;
using mechanics::SpecialKind;

BodySetup setup_of(std::string_view law, double pi_G_rho, int degree, bool incompressible = true) {
  BodySetup setup{.degree = degree,
                  .law = materials::make_law(law, {.shear_modulus = 1, .lame_lambda = 3}, incompressible)};
  setup.loads.get<loads::SelfGravity>().constant = pi_G_rho / std::numbers::pi;
  return setup;
}

const FamilyOfFigures by_eccentricity{Figure::spheroid, [](double e) -> FigureCondition {
                                        return {FigureParameter::log_ratio_31, 0.5 * std::log1p(-e * e)};
                                      }};
const FamilyOfFigures by_polar_axis{Figure::spheroid, [](double p) -> FigureCondition {
                                      return {FigureParameter::log_ratio_31, 1.5 * std::log(p)};
                                    }};
const FamilyOfFigures by_spin{Figure::spheroid, [](double spin) -> FigureCondition {
                                return {FigureParameter::drive, spin * spin};
                              }};

std::vector<double> values(double first, double last, int n) {
  std::vector<double> v;
  for (int k = 0; k < n; ++k) v.push_back(first + (last - first) * k / (n - 1));
  return v;
}

std::vector<double> frequencies(const FigureMember& member) {
  std::vector<double> f;
  for (const ClassStability& of_class : member.classes)
    for (const auto& rate : of_class.stability.rates) f.push_back(rate.s.imag());
  std::ranges::sort(f);
  return f;
}
int n_negative(const FigureMember& member) {
  int n = 0;
  for (const ClassStability& of_class : member.classes) n += of_class.stability.n_negative;
  return n;
}

const SpecialFigure* special_point(const FigureFamily& family, SpecialKind kind, int m) {
  const auto found = std::ranges::find_if(family.special, [&](const SpecialFigure& s) {
    return s.kind == kind && s.motions.m == m && !s.motions.odd_in_z;
  });
  return found == family.special.end() ? nullptr : &*found;
}
void expect_special(const FigureFamily& family, SpecialKind kind, int m, double parameter, double tolerance) {
  const SpecialFigure* found = special_point(family, kind, m);
  ASSERT_TRUE(found) << mechanics::name_of(kind) << ", m = " << m;
  EXPECT_NEAR(found->member.parameter, parameter, tolerance) << mechanics::name_of(kind) << ", m = " << m;
}

/// Of degree 1 the body is the pseudo-rigid one: figures, rates and directions, elastic, fluid, both, and compressible.
TEST(SteadyRotation, OfDegreeOneIsThePseudoRigidOne) {
  struct Case {
    std::string_view law;
    double pi_G_rho;
    bool incompressible;
  };
  for (const auto& [law, pi_G_rho, incompressible] : {Case{"neo-hookean", 0, true}, Case{"none", 1, true},
                                                      Case{"mooney-rivlin", 2, true}, Case{"neo-hookean", 0, false}}) {
    const BodySetup setup = setup_of(law, pi_G_rho, 1, incompressible);
    const reduced::Potential potential(setup.law, reduced::ReferenceBody::unit_ball(),
                                       {.gravity_constant = pi_G_rho / std::numbers::pi});
    const reduced::IsotropicBody<reduced::Potential> body{potential, 4 * std::numbers::pi / 15, incompressible};
    const auto known = reduced::spheroids(body, reduced::SpheroidParameter::eccentricity, {0.2, 0.97, 9});
    BodyFigureFinder finder(setup, incompressible, by_eccentricity);
    const FigureFamily found = finder.family(values(0.2, 0.97, 9));
    ASSERT_EQ(found.members.size(), known.points.size()) << law;
    ASSERT_EQ(found.special.size(), known.special.size()) << law;
    for (std::size_t k = 0; k < found.members.size(); ++k) {
      const auto& expected = known.points[k];
      const FigureMember& member = found.members[k];
      const double spin = expected.motion.omega[2];
      EXPECT_NEAR(member.figure.drive, spin * spin, 1e-11 * (1 + spin * spin)) << law;
      const Eigen::Matrix3d A = finder.spectrum().space().affine_part(finder.spectrum().whole(member.figure.x));
      EXPECT_LT((A.diagonal() - expected.semi_axes).norm(), 1e-11) << law;
      EXPECT_EQ(n_negative(member), expected.stability.n_negative) << law;
      std::vector<double> f;
      for (const auto& rate : expected.stability.rates) f.push_back(rate.s.imag());
      std::ranges::sort(f);
      const std::vector<double> of_member = frequencies(member);
      ASSERT_EQ(of_member.size(), f.size()) << law;
      for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(of_member[i], f[i], 1e-9) << law;
    }
    std::vector<double> special, of_known;
    for (const auto& point : found.special) special.push_back(point.member.parameter);
    for (const auto& point : known.special) of_known.push_back(point.point.parameter);
    std::ranges::sort(special);
    std::ranges::sort(of_known);
    for (std::size_t k = 0; k < special.size(); ++k) EXPECT_NEAR(special[k], of_known[k], 1e-9) << law;
  }
}

/// A fluid ellipsoid is a figure of every degree. What degree 1 knows of Maclaurin's spheroids stays (PHYSICS section
/// 6: 0.812670011, 0.929955685, 0.952886702), to the quadrature of gravity.
TEST(SteadyRotation, MaclaurinsSpheroidsKeepWhatDegreeOneKnows) {
  for (const int N : {1, 3, 4, 5}) {
    const FigureFamily family =
        BodyFigureFinder(setup_of("none", 1, N), true, by_eccentricity).family(values(0.79, 0.96, 4));
    expect_special(family, SpecialKind::index, 2, 0.812670011, 5e-9);
    expect_special(family, SpecialKind::fold, 0, 0.929955685, 6e-10);
    expect_special(family, SpecialKind::instability, 2, 0.952886702, 5e-7);
  }
}

/// The third harmonics come with degree 3: neutral for m = 3 at e = 0.89926 (Chandrasekhar, Ellipsoidal Figures of
/// Equilibrium), to five digits with more points of gravity than by default.
TEST(SteadyRotation, ThirdHarmonicsOfMaclaurinsSpheroids) {
  BodySetup setup = setup_of("none", 1, 3);
  setup.n_gravity_points = 12;
  const FigureFamily family = BodyFigureFinder(setup, true, by_eccentricity).family(values(0.87, 0.93, 2));
  expect_special(family, SpecialKind::index, 3, 0.89926, 5e-6);
}

/// Small spin: the surface has the ellipticity (5/38)Ω²a²/c² of Kelvin and Chree from degree 3 on, 1/10 at degree 1
/// (PHYSICS section 4). The next term is of the order Ω⁴.
TEST(SteadyRotation, EllipticityAtSmallSpin) {
  const double spin = 0.01;
  for (const auto& [N, expected] : {std::pair{1, 0.1}, {2, 0.1}, {3, 5.0 / 38}, {5, 5.0 / 38}}) {
    BodyFigureFinder finder(setup_of("neo-hookean", 0, N), true, by_spin);
    FigureMember member;
    ASSERT_TRUE(finder.member(spin, member));
    const PolynomialSpace& space = finder.spectrum().space();
    const Eigen::VectorXd x = finder.spectrum().whole(member.figure.x);
    const double equator = space.value(space.functions_at({1, 0, 0}), x)[0],
                 pole = space.value(space.functions_at({0, 0, 1}), x)[2];
    EXPECT_NEAR((equator - pole) / (spin * spin), expected, spin * spin) << N;
  }
}

/// With gravity as well: (5/4)(Ω²/g)/(1 + 19μ/(2ρgr)) with g = 4πGρr/3 (PHYSICS section 4), to the difference between
/// the mass moment and the surface. The quadrature of gravity has an error of 1e-6 of the force, which is as large as
/// the centrifugal force here.
TEST(SteadyRotation, SlowSpinsUnderGravity) {
  for (const int N : {3, 5}) {
    std::vector<double> of_e;
    for (const double e : {0.001, 0.01}) {
      BodyFigureFinder finder(setup_of("neo-hookean", 1, N), true, by_eccentricity);
      FigureMember member;
      ASSERT_TRUE(finder.member(e, member));
      of_e.push_back(member.figure.drive / (e * e));
    }
    const double g = 4.0 / 3, expected = 0.4 * g * (1 + 19 / (2 * g));
    EXPECT_NEAR(of_e[0], of_e[1], 1e-4 * of_e[1]) << N;
    EXPECT_NEAR(of_e[0], expected, 1e-5 * expected) << N;
  }
}

/// The spin of a disc tends to that of the plane problem c²Δx + Ω²x = 0 with free edges on the ball, in polynomials:
/// the least Rayleigh quotient of r and r³ is the lower root w of 4/7 − (44/315)w + (4/2205)w², 2.082057 as its root;
/// the limit N → ∞ is the zero 2.081576 of j₁′ (PHYSICS section 11). The disc a₃ ~ 0.01 is short of it by about ℓ.
TEST(SteadyRotation, CriticalSpin) {
  const double of_cubic = std::sqrt((44.0 / 315 - std::sqrt(44.0 * 44 / (315.0 * 315) - 64.0 / 15435)) / (8.0 / 2205));
  EXPECT_NEAR(of_cubic, 2.082057, 5e-7);
  for (const auto& [N, expected] : {std::pair{1, std::sqrt(5.0)}, {3, of_cubic}, {5, 2.081576}}) {
    FigureMember member;
    ASSERT_TRUE(BodyFigureFinder(setup_of("neo-hookean", 0, N), true, by_polar_axis).member(0.02, member));
    EXPECT_NEAR(std::sqrt(member.figure.drive), expected, 1e-4) << N;
    EXPECT_LT(std::sqrt(member.figure.drive), expected) << N;
  }
}

/// At rest, all frequencies that rest_modes.h lists are found with their 2n + 1 copies.
TEST(SteadyRotation, AtRestTheSpectrumIsThatOfTheModes) {
  for (const int N : {1, 3, 5}) {
    const BodySetup setup = setup_of("neo-hookean", 0, N);
    std::vector<RestFrequency> modes;
    ASSERT_TRUE(rest_frequencies(setup, true, 1000, modes));
    ASSERT_FALSE(modes.empty());
    FigureMember member;
    ASSERT_TRUE(BodyFigureFinder(setup, true, by_eccentricity).member(0, member));
    const std::vector<double> found = frequencies(member);
    for (const RestFrequency& mode : modes)
      EXPECT_GE(std::ranges::count_if(found, [&](double f) { return std::abs(f - mode.omega) < 1e-8; }),
                2 * mode.degree + 1)
          << N << ": " << mode.omega;
  }
}

/// Jacobi's ellipsoids lose their stability to the pear at a₂/a₁ = 0.432232 (Chandrasekhar § 40), from degree 3 on: a
/// rate begins where a direction becomes negative, in the motions that are odd under the half turn.
TEST(SteadyRotation, JacobisEllipsoidsBecomePears) {
  for (const int N : {1, 3}) {
    BodySetup setup = setup_of("none", 1, N);
    setup.n_gravity_points = 12;
    const reduced::Potential potential(setup.law, reduced::ReferenceBody::unit_ball(),
                                       {.gravity_constant = 1 / std::numbers::pi});
    const reduced::IsotropicBody<reduced::Potential> body{potential, 4 * std::numbers::pi / 15, true};
    BodyFigureFinder finder(setup, true,
                            {Figure::ellipsoid,
                             [](double ratio) -> FigureCondition {
                               return {FigureParameter::log_ratio_21, std::log(ratio)};
                             },
                             [&](double& ratio_of_spheroid) {
                               reduced::SteadyMotion m;
                               auto status = reduced::jacobi_motion(body, 0.99999, m);
                               ratio_of_spheroid = m.A(2, 2) / m.A(0, 0);
                               return status;
                             }});
    std::vector<double> fractions;
    const FigureFamily family =
        finder.family({0.41, 0.46}, {}, [&](double fraction, const FigureFamily&) { fractions.push_back(fraction); });
    EXPECT_EQ(fractions, (std::vector{0.0, 0.5}));
    ASSERT_EQ(family.members.size(), 2u);
    if (N == 1) {
      EXPECT_TRUE(family.special.empty());
      continue;
    }
    expect_special(family, SpecialKind::index, 1, 0.432232, 2e-5);
    expect_special(family, SpecialKind::instability, 1, 0.432232, 2e-5);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
