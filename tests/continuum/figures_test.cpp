/// Figures of equilibrium of the finite-element ball, in internal units μ = ρ = r = 1.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "continuum/statics/figure_stability.h"
#include "materials/law_table.h"

namespace pseudorigid::testing {
namespace {

using namespace continuum;
using mechanics::FigureCondition, mechanics::FigureParameter;

FigureSetup spinning(int degree, int refinements, double gamma = 0) {
  FigureSetup setup{degree, refinements, {materials::make_law("neo-hookean", {.shear_modulus = 1}, true), 0}, {}, true,
                    Drive::rotation, mechanics::Figure::spheroid};
  setup.loads.get<loads::SelfGravity>().constant = 3 * gamma / (4 * std::numbers::pi);
  return setup;
}

[[maybe_unused]] void show(const char* what, const BallFigures& figures, const mechanics::Status& status, const mechanics::EquilibriumFigure& figure) {
  const Vector x = figures.positions(figure);
  const Eigen::Matrix3d A = figures.body().mass_moment(x);
  double surface[3] = {0, 0, 0};
  const Vector& X = figures.body().space().reference_positions();
  for (unsigned int n = 0; n < figures.body().space().n_nodes(); ++n)
    for (int c = 0; c < 3; ++c)
      if (std::abs(X.local_element(3 * n + c) - 1) < 1e-12) surface[c] = x.local_element(3 * n + c);
  std::printf("%s: %s newton %ld fact %ld products %ld residual %.2e drive %.12g A %.12f %.12f %.12f surface %.12f %.12f\n", what, status.reason().c_str(), figures.counts().newton,
              figures.counts().factorizations, figures.counts().linear_products, figure.residual, figure.drive, A(0, 0), A(1, 1), A(2, 2), surface[0], surface[2]);
}

TEST(BallFigures, Try) {
  for (const double nu : {0.0, 0.01, 0.3, 2.0})
    for (const int k : {3, 4}) for (const int m : {4, 8, 12}) {
      BallFigures figures(spinning(k, 0));
      auto figure = figures.affine({1, 1, 1}, 0);
      auto status = figures.solve({FigureParameter::log_ratio_31, 0}, figure);
      if (status) status = figures.follow(0, {FigureParameter::log_ratio_31, -nu / 3}, figure);
      std::vector<mechanics::ClassStability> classes;
      const auto start = std::chrono::steady_clock::now();
      if (status) status = stability_of(figures, figure, m, classes);
      std::printf("nu %g k %d m %d %s %.2f s\n", nu, k, m, status.reason().c_str(), std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
      for (const auto& c : classes) {
        std::printf("  odd %d m %d: negative %d growth %.3g rates:", c.motions.odd_in_z, c.motions.m, c.stability.n_negative, c.stability.growth_rate);
        int n = 0;
        for (const auto& r : c.stability.rates) if (r.s.imag() > 0 && n++ < 6) std::printf(" %.6f", r.s.imag());
        std::printf(" second");
        for (int i = 0; i < 4 && i < c.stability.second_variation.size(); ++i) std::printf(" %.2e", c.stability.second_variation[i]);
        std::printf("\n");
      }
    }
}

}  // namespace
}  // namespace pseudorigid::testing
