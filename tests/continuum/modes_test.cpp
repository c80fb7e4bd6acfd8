/// Modes of the ball at rest against the exact frequencies of the elastic sphere (PHYSICS 3 and 7.6).

#include "continuum/modes/modes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include "continuum/body/elastic_ball.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using namespace continuum;

struct Exact {
  ModeKind kind;
  int degree, overtone;
  double omega;
};

constexpr auto S = ModeKind::spheroidal, T = ModeKind::toroidal;
/// Those of PHYSICS 3.
constexpr Exact exact_frequencies[] = {{S, 1, 0, 3.870238580222}, {S, 2, 0, 2.665622189236}, {S, 2, 1, 5.473039811966},
                                       {S, 3, 0, 4.001936825190}, {T, 1, 0, 5.763459196895}, {T, 2, 0, 2.501132620409}};

const BallFrequency* find(const std::vector<BallFrequency>& frequencies, ModeKind kind, int degree, int overtone) {
  for (const BallFrequency& f : frequencies)
    if (f.kind == kind && f.degree == degree && f.overtone == overtone) return &f;
  return nullptr;
}

/// An octant at rest with its modes.
struct Octant {
  Octant(int degree, int n_refinements, int n_frequencies, const char* law = "neo-hookean",
         const materials::LawParameters& parameters = {}, bool incompressible = true)
      : space(BallMesh({{true, true, true}}, n_refinements), degree),
        law(materials::make_law(law, parameters, incompressible)),
        kernels(make_cell_kernels(space, this->law)),
        problem(space, *kernels, this->law, incompressible) {
    ModesReport report;
    const auto status = ball_modes(problem, n_frequencies, frequencies, report);
    EXPECT_TRUE(status) << status.reason();
  }
  BallSpace space;
  materials::AnyLaw law;
  std::unique_ptr<CellKernels> kernels;
  RestProblem problem;
  std::vector<BallFrequency> frequencies;
};

class ModesOfDegree : public ::testing::TestWithParam<int> {};

TEST_P(ModesOfDegree, ConvergeWithTwiceTheDegree) {
  const int k = GetParam(),
            coarse = k == 2 ? 1 : 0;  // the octant of 4 quadratic cells cannot tell degree 5 from others
  std::array<std::vector<ErrorPoint>, std::size(exact_frequencies)> errors;
  for (int r = coarse; r <= coarse + 1; ++r) {
    const Octant octant(k, r, 9);
    for (std::size_t i = 0; i < std::size(exact_frequencies); ++i) {
      const auto& [kind, degree, overtone, omega] = exact_frequencies[i];
      const BallFrequency* f = find(octant.frequencies, kind, degree, overtone);
      ASSERT_NE(f, nullptr) << (kind == S ? "S" : "T") << degree << " of degree " << k;
      EXPECT_EQ(f->multiplicity, 2 * degree + 1);
      errors[i].push_back({std::pow(0.5, r), std::max(std::abs(f->least - omega), std::abs(f->largest - omega))});
    }
  }
  for (std::size_t i = 0; i < std::size(exact_frequencies); ++i) {
    const double order = fit_order(errors[i]).order;
    const std::string name = (exact_frequencies[i].kind == S ? "S" : "T") +
                             std::to_string(exact_frequencies[i].degree) + "_" +
                             std::to_string(exact_frequencies[i].overtone);
    RecordProperty(name, std::to_string(order));
    std::printf("k = %d, %s: errors %.2e, %.2e, order %.2f\n", k, name.c_str(), errors[i][0].error, errors[i][1].error,
                order);
    EXPECT_GE(order, 2 * k - 0.3) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Ball, ModesOfDegree, ::testing::Values(2, 3, 4));

/// The nine lowest frequencies with all their copies, rigid motions left out.
TEST(Modes, ComeInOrderWithKindDegreeAndOvertone) {
  const Octant octant(4, 0, 9);
  constexpr Exact expected[] = {{T, 2, 0, 2.501133}, {S, 2, 0, 2.665622}, {T, 3, 0, 3.864700},
                                {S, 1, 0, 3.870239}, {S, 3, 0, 4.001937}, {T, 4, 0, 5.094620},
                                {S, 4, 0, 5.160821}, {S, 2, 1, 5.473040}, {T, 1, 0, 5.763459}};
  ASSERT_EQ(octant.frequencies.size(), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    const BallFrequency& f = octant.frequencies[i];
    EXPECT_EQ(f.kind, expected[i].kind) << i;
    EXPECT_EQ(f.degree, expected[i].degree) << i;
    EXPECT_EQ(f.overtone, expected[i].overtone) << i;
    EXPECT_EQ(f.multiplicity, 2 * f.degree + 1) << i;
    EXPECT_NEAR(f.omega, expected[i].omega, 6e-4) << i;  // the mesh's error, largest for T4
    EXPECT_GT(f.share, 0.999) << i;
  }
}

TEST(Modes, LowestSpheroidalModeToNineDigits) {
  const Octant octant(6, 0, 2);
  const BallFrequency* f = find(octant.frequencies, S, 2, 0);
  ASSERT_NE(f, nullptr);
  std::printf("S2 at k = 6: relative errors %.1e to %.1e\n", f->least / 2.665622189236 - 1,
              f->largest / 2.665622189236 - 1);
  EXPECT_NEAR(f->least / 2.665622189236, 1, 1e-9);
  EXPECT_NEAR(f->largest / 2.665622189236, 1, 1e-9);
}

/// ω² = uᵀKu/uᵀMu and Gu = 0 with the force and the constraint of the motion, M¨u = −Ku + Gᵀλ.
TEST(Modes, AreThoseOfTheMotionsForceAndConstraint) {
  const Octant octant(3, 0, 5, "mooney-rivlin", {.mooney_fraction = 0.3});
  const Vector& X = octant.space.reference_positions();
  for (const BallFrequency& f : octant.frequencies) {
    const double eps = 1e-4;
    Vector x = X, forward = octant.space.make_vector(), backward = forward, momentum = f.shape;
    x.add(eps, f.shape);
    octant.kernels->force(x, forward);
    x.add(-2 * eps, f.shape);
    octant.kernels->force(x, backward);
    momentum.scale(octant.space.mass());
    const double omega_squared = (f.shape * backward - f.shape * forward) / (2 * eps) / (f.shape * momentum);
    // Differences err by ε² times third derivatives of order 1 to 10.
    EXPECT_NEAR(omega_squared / (f.least * f.least), 1, 1e-6);
    Vector divergence = octant.space.make_multiplier();
    octant.kernels->constraint_rate(X, f.shape, divergence);
    EXPECT_LT(divergence.linfty_norm(), 1e-10);
  }
}

/// All laws are 2μ ε on fields without divergence; Saint Venant–Kirchhoff as printed is so with 2μ in the place of μ,
/// and stressed at rest.
TEST(Modes, DependOnTheLawByItsShearModulusOnly) {
  for (const auto& law : materials::law_table) {
    if (law.name == "none") continue;
    const Octant octant(4, 0, 2, std::string(law.name).c_str(), {.lame_lambda = 1.7, .mooney_fraction = 0.4});
    const double modulus = law.name == "saint-venant-kirchhoff (as printed)" ? 2 : 1;
    EXPECT_NEAR(octant.problem.elasticity.moduli.shear, modulus, 1e-14) << law.name;
    const BallFrequency* f = find(octant.frequencies, S, 2, 0);
    ASSERT_NE(f, nullptr) << law.name;
    EXPECT_NEAR(f->omega / std::sqrt(modulus), 2.665622189236, 1e-5) << law.name;  // what divergence is left in cells
  }
}

/// Radial mode of the compressible ball, x cot x = 1 − (x²/4)(c_p/c_s)² (PHYSICS 7.7).
TEST(Modes, RadialModeOfTheCompressibleBall) {
  const double ratio_squared = 1.5 + 2;  // (λ + 2μ)/μ
  double low = 1.6, high = 3.1;
  const auto residual = [&](double x) { return x / std::tan(x) - 1 + x * x / 4 * ratio_squared; };
  for (int i = 0; i < 60; ++i)
    ((residual(0.5 * (low + high)) > 0) == (residual(low) > 0) ? low : high) = 0.5 * (low + high);
  const Octant octant(6, 0, 8, "neo-hookean", {.lame_lambda = 1.5}, false);
  const BallFrequency* f = find(octant.frequencies, S, 0, 0);
  ASSERT_NE(f, nullptr);
  std::printf("radial mode: %.12f, exact %.12f\n", f->omega, low * std::sqrt(ratio_squared));
  EXPECT_NEAR(f->omega / (low * std::sqrt(ratio_squared)), 1, 1e-8);
}

/// Displacements are reflected with the parity of the mode: continuous over the planes, and largest 1.
TEST(Modes, ShapesAreContinuousOverTheSymmetryPlanes) {
  const Octant octant(3, 0, 3);
  const Vector& X = octant.space.reference_positions();
  for (const BallFrequency& f : octant.frequencies) {
    double largest = 0;
    for (unsigned int node = 0; node < octant.space.n_nodes(); ++node) {
      double square = 0;
      for (unsigned int c = 0; c < 3; ++c) {
        square += std::pow(f.shape.local_element(3 * node + c), 2);
        for (unsigned int plane = 0; plane < 3; ++plane) {
          const bool on_plane = X.local_element(3 * node + plane) == 0;
          if (on_plane && f.parity.holds(static_cast<int>(c), static_cast<int>(plane))) {
            EXPECT_EQ(f.shape.local_element(3 * node + c), 0);
          }
        }
      }
      largest = std::max(largest, std::sqrt(square));
    }
    EXPECT_NEAR(largest, 1, 1e-14);
    const std::vector<double> whole = mode_displacement(octant.space, f.parity, f.shape);
    const std::size_t per_image = whole.size() / 8;
    for (int j = 0; j < 3; ++j)  // the image in the plane of normal j: u(R_j X) = s_j R_j u(X)
      for (std::size_t i = 0; i < per_image; ++i)
        EXPECT_EQ(whole[(std::size_t{1} << j) * per_image + i],
                  (static_cast<int>(i % 3) == j ? -1 : 1) * f.parity.sign[j] * whole[i]);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
