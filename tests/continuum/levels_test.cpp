/// The kernels compiled for each level of x86-64 that this processor has compute the same to round-off: with 2, 4 and 8
/// lanes, with and without fused operations.

#include "continuum/levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "continuum/balls.h"

namespace pseudorigid::testing {
namespace {

using Numbers = std::vector<double>;

/// What each kernel makes of a deformed ball.
std::vector<Numbers> results(const continuum::KernelTable& table, const ElasticBall& ball) {
  std::mt19937 generator{11};
  continuum::Vector x = ball.affine_field(diagonal(1.1, 0.8, 1.2));
  x.add(0.01, random_field(x, generator));
  const continuum::Vector v = random_field(x, generator), lambda = random_field(ball.make_multiplier(), generator);
  const auto kernels = table.make_local_kernels(degree_of_levels, local_cells(ball.space()), {ciarlet_geymonat, 0.3});
  const Numbers zero(x.locally_owned_size()), none(lambda.locally_owned_size());
  std::vector<Numbers> all;
  all.push_back(zero);
  const double least = kernels->add_force(x.begin(), all.back().data());
  all.push_back({least, kernels->constraint(x.begin(), all.emplace_back(none).data())});
  kernels->constraint_rate(x.begin(), v.begin(), all.emplace_back(none).data());
  kernels->constraint_curvature(x.begin(), v.begin(), all.emplace_back(none).data());
  kernels->add_reaction(x.begin(), lambda.begin(), all.emplace_back(zero).data());
  kernels->add_viscous_force(0.7, x.begin(), v.begin(), all.emplace_back(zero).data());
  const auto sums = kernels->integrals(x.begin(), v.begin());
  all.push_back({sums.elastic, sums.volumetric, sums.volume});
  return all;
}

std::vector<const mechanics::KernelBuild<continuum::KernelTable>*> builds_here() {
  std::vector<const mechanics::KernelBuild<continuum::KernelTable>*> here;
  for (const auto& build : builds_of_degree_4())
    if (build.runs_here()) here.push_back(&build);
  return here;
}

/// An octant has four cells, for which a level may take fewer lanes than it has; half a ball has 16.
TEST(Levels, AgreeToRoundOff) {
  const auto here = builds_here();
  if (here.size() < 2) GTEST_SKIP() << "there is nothing to compare on this processor";
  for (const Sector& sector : {octant, half}) {
    const ElasticBall ball(sector, degree_of_levels, 0, ciarlet_geymonat);
    const auto expected = results(*here.back()->table, ball);
    for (const auto* build : here) {
      const auto found = results(*build->table, ball);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        double size = 0, difference = 0;
        for (std::size_t i = 0; i < expected[k].size(); ++i) {
          size = std::max(size, std::abs(expected[k][i]));
          difference = std::max(difference, std::abs(found[k][i] - expected[k][i]));
        }
        EXPECT_GT(size, 1e-3);
        EXPECT_LT(difference, 1e-13 * size)
            << build->instructions << ", kernel " << k << ": sums of some hundred terms";
      }
    }
  }
}

TEST(Levels, MultiplyAlikeToSinglePrecision) {
  const std::size_t n = 77;
  std::vector<float> entries(n * (n + 1) / 2), x(n);
  for (std::size_t i = 0; i < entries.size(); ++i) entries[i] = static_cast<float>(std::sin(1.0 + 0.7 * double(i)));
  for (std::size_t i = 0; i < n; ++i) x[i] = static_cast<float>(std::cos(2.0 * double(i)));
  std::vector<float> expected(n);
  builds_here().back()->table->multiply_packed(entries.data(), n, x.data(), expected.data());
  for (const auto* build : builds_here()) {
    std::vector<float> y(n, 7);
    build->table->multiply_packed(entries.data(), n, x.data(), y.data());
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(y[i], expected[i], 77 * 6e-8 * 4) << build->instructions;
  }
}

TEST(Levels, MultiplyMatricesOfCells) {
  for (const std::size_t n_rows : {8u, 24u, 56u, 64u, 88u, 120u})
    for (const std::size_t n_columns : {1u, 4u, 27u, 35u}) {
      std::vector<float> A(n_rows * n_columns), of_columns(n_columns), of_rows(n_rows);
      for (std::size_t i = 0; i < A.size(); ++i) A[i] = static_cast<float>(std::sin(1.0 + 0.7 * double(i)));
      for (std::size_t i = 0; i < n_columns; ++i) of_columns[i] = static_cast<float>(std::cos(2.0 * double(i)));
      for (std::size_t i = 0; i < n_rows; ++i) of_rows[i] = static_cast<float>(std::cos(3.0 * double(i)));
      for (const auto* build : builds_here()) {
        std::vector<float> y(n_rows, 0.5f), z(n_columns, 7);
        build->table->add_product(A.data(), n_rows, n_columns, of_columns.data(), y.data());
        build->table->multiply_transposed(A.data(), n_rows, n_columns, of_rows.data(), z.data());
        constexpr double round_off = 6e-8 * 4;  // a term
        for (std::size_t r = 0; r < n_rows; ++r) {
          double expected = 0.5;
          for (std::size_t c = 0; c < n_columns; ++c) expected += double(A[c * n_rows + r]) * of_columns[c];
          EXPECT_NEAR(y[r], expected, double(n_columns) * round_off) << build->instructions;
        }
        for (std::size_t c = 0; c < n_columns; ++c) {
          double expected = 0;
          for (std::size_t r = 0; r < n_rows; ++r) expected += double(A[c * n_rows + r]) * of_rows[r];
          EXPECT_NEAR(z[c], expected, double(n_rows) * round_off) << build->instructions;
        }
      }
    }
}

}  // namespace
}  // namespace pseudorigid::testing
