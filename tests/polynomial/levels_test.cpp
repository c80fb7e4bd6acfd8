/// The inner loops compiled for each level of x86-64 that this processor has compute the same to round-off.

#include "polynomial/levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pseudorigid::testing {
namespace {

using Numbers = std::vector<double>;

constexpr int n_levels = 3, n_groups = polynomial::point_block, n_radii = 5, n_directions = 9,
              width = 2 * polynomial::point_block;
constexpr int n_points = 3 * polynomial::point_block;

Numbers wave(int size, double phase) {
  Numbers values(size);
  for (int i = 0; i < size; ++i) values[i] = std::sin(1.3 * i + phase);
  return values;
}

/// F at the points, close to the identity.
Numbers deformation() {
  Numbers F = wave(9 * n_points, 0.4);
  for (int i = 0; i < 9 * n_points; ++i) F[i] = 0.1 * F[i] + (i / n_points % 4 == 0 ? 1 : 0);
  return F;
}

std::vector<Numbers> results(const polynomial::DenseKernels& kernels) {
  const Numbers radial = wave(n_levels * n_radii * n_groups, 0), c = wave(n_levels * n_groups, 1);
  const Numbers D = wave(9 * width, 5), terms = wave(3 * n_radii * width, 6),
                fields = wave(3 * n_radii * n_directions, 7);
  const Numbers w(n_points, 0.7), F = deformation(), H = wave(9 * n_points, 3);
  const materials::AnyLaw law = materials::CiarletGeymonat{1.2, 0.8};
  Numbers at_radii(n_radii * n_groups), coefficients(n_levels * n_groups), P(9 * n_points), rate(9 * n_points),
      logarithm(n_points);
  const Numbers table = wave(n_levels * n_points, 9), at_table = wave(n_points, 10);
  Numbers combined(n_points), contracted(n_levels);
  kernels.combine(table.data(), n_levels, n_points, c.data(), combined.data());
  kernels.contract(table.data(), n_levels, n_points, at_table.data(), contracted.data());
  Numbers of_terms(3 * n_radii * n_directions), of_fields(3 * n_radii * n_directions);
  kernels.combine_radially(radial.data(), n_levels, n_radii, n_groups, c.data(), at_radii.data());
  kernels.contract_radially(radial.data(), n_levels, n_radii, n_groups, at_radii.data(), coefficients.data());
  Numbers product = wave(n_levels * n_groups, 8);
  kernels.multiply(radial.data(), n_groups, n_levels, D.data(), n_groups, n_groups, product.data(), true);
  const int field = n_radii * n_directions;
  std::array<double*, 3> y{of_terms.data(), of_terms.data() + field, of_terms.data() + 2 * field};
  kernels.fields_of_terms(D.data(), n_radii, n_directions, width, terms.data(), y.data());
  const std::array<const double*, 3> x{fields.data(), fields.data() + field, fields.data() + 2 * field};
  kernels.terms_of_fields(D.data(), n_radii, n_directions, width, x.data(), of_fields.data());
  const double least = kernels.stress(law, 0.3, n_points, w.data(), F.data(), P.data());
  kernels.stress_rate(law, 0.3, n_points, w.data(), F.data(), H.data(), rate.data());
  const double least_of_log = kernels.log_jacobian(n_points, w.data(), F.data(), logarithm.data());
  const auto sums = kernels.energy(law, 0.3, n_points, w.data(), F.data());
  return {at_radii,
          coefficients,
          product,
          combined,
          contracted,
          of_terms,
          of_fields,
          P,
          rate,
          logarithm,
          {least, least_of_log, sums.elastic, sums.volumetric}};
}

TEST(DenseKernelsOfLevels, AgreeToRoundOff) {
  std::vector<Numbers> expected;
  int n_levels = 0;
  for (const auto& build : builds_of_dense_levels()) {
    if (!build.runs_here()) continue;
    ++n_levels;
    const auto found = results(*build.table);
    if (expected.empty()) expected = found;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      const double size = std::abs(*std::ranges::max_element(expected[k], {}, [](double x) { return std::abs(x); }));
      EXPECT_GT(size, 1e-2) << k;
      for (std::size_t i = 0; i < expected[k].size(); ++i)
        EXPECT_NEAR(found[k][i], expected[k][i], 1e-13 * size) << build.instructions << ", kernel " << k;
    }
  }
  if (n_levels < 2) GTEST_SKIP() << "there is nothing to compare on this processor";
}

}  // namespace
}  // namespace pseudorigid::testing
