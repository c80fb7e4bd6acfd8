/// Products with the stiffness of the cells, and the linear equations of figures by V-cycles.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "continuum/modes/parity_sector.h"
#include "continuum/statics/ball_figures.h"
#include "continuum/statics/multigrid.h"
#include "materials/law_table.h"

namespace pseudorigid::testing {
namespace {

using namespace continuum;

struct Case {
  std::string name;
  bool incompressible;
  double kappa, gamma;  ///< stiffness of the stabilisation, and γ = ρgr/μ
};
const std::vector<Case> cases{{"incompressible", true, 0, 0},
                              {"stabilised", true, 2, 0},
                              {"gravitating", true, 2, 4},
                              {"compressible", false, 0, 0}};

/// A strained state of a ball in one octant.
struct StrainedBall {
  StrainedBall(const Case& of, int degree, int n_refinements, Drive drive = Drive::loads)
      : refinements(n_refinements),
        figures(setup(of, degree, n_refinements, drive)),
        x(figures.positions(figures.affine({1.1, 0.97, of.incompressible ? 1 / 1.1 / 0.97 : 0.95}, 0))),
        lambda(figures.body().space().make_multiplier()) {
    if (!of.incompressible) lambda = Vector();
  }
  static FigureSetup setup(const Case& of, int degree, int n_refinements, Drive drive) {
    FigureSetup result{.degree = degree,
                       .n_refinements = n_refinements,
                       .stored = {materials::make_law(of.incompressible ? "neo-hookean" : "ciarlet-geymonat",
                                                      {.shear_modulus = 1, .lame_lambda = 2}, of.incompressible),
                                  of.kappa},
                       .loads = {},
                       .incompressible = of.incompressible,
                       .drive = drive,
                       .figure = mechanics::Figure::ellipsoid};
    if (of.gamma > 0) result.loads.get<loads::SelfGravity>().constant = 3 * of.gamma / (4 * std::numbers::pi);
    return result;
  }
  FigureState state(double drive = 0) const { return figures.state(x, lambda, drive); }
  const BallBody& body() const { return figures.body(); }
  /// Fixed irregular numbers, which are 0 for components that a plane fixes.
  Vector irregular() const {
    Vector u = body().make_vector();
    body().fill_irregular(u);
    body().space().clear_fixed(u);
    return u;
  }

  int refinements;
  BallFigures figures;
  Vector x, lambda;
};

double distance(Vector a, const Vector& b) {
  a -= b;
  return a.l2_norm() / b.l2_norm();
}

TEST(Stiffness, ProductAndDiagonalAreThoseOfTheMatrices) {
  for (int degree = 1; degree <= 8; ++degree) {
    const StrainedBall ball(cases.back(), degree, degree < 3 ? 1 : 0);
    const BallSpace& space = ball.body().space();
    const CellStiffness cells(space);
    StiffnessCoefficients c;
    const Vector u = ball.irregular();
    Vector expected = ball.body().make_vector(), product = expected;
    for (unsigned int cell = 0; cell < space.n_cells(); ++cell) {
      c.push_back(tangent_coefficients(cells, ball.state(), cell, Balance::multiplier));
      const Eigen::MatrixXd K = cells.cell_matrix(c.back());
      EXPECT_LT((cells.diagonal(c.back()) - K.diagonal()).norm(), 1e-13 * K.diagonal().norm()) << degree;
      Eigen::VectorXd of_cell(K.cols());
      const auto entry = [&](Eigen::Index i) { return space.entry_of(cell, i); };
      for (Eigen::Index i = 0; i < of_cell.size(); ++i) of_cell[i] = u.local_element(entry(i));
      of_cell = (K * of_cell).eval();
      for (Eigen::Index i = 0; i < of_cell.size(); ++i) expected.local_element(entry(i)) += of_cell[i];
    }
    ball.body().kernels().stiffness_product(*make_stiffness(ball.body().kernels(), c), u, product);
    EXPECT_LT(distance(product, expected), 1e-6) << degree;  // single precision
  }
}

TEST(Stiffness, ProductIsTheDerivativeOfTheForces) {
  for (const Case& of : cases) {
    const StrainedBall ball(of, 4, 0, Drive::rotation);
    const double spin_squared = 0.3, h = 1e-5;
    const FigureState state = ball.state(spin_squared);
    Multigrid multigrid(state, nullptr, 0);
    ASSERT_TRUE(multigrid.factorize()) << of.name;
    const Vector u = ball.irregular();
    Vector product = ball.body().make_vector(), expected = product;
    multigrid.product(u, product);
    const auto add_force = [&](double step, double factor) {
      Vector y = ball.x, f = ball.body().make_vector();
      y.add(step, u);
      ball.body().kernels().force(y, f);
      if (ball.body().gravity()) {
        ASSERT_TRUE(ball.body().gravity()->add(y, f));
      }
      for (unsigned int i = 0; i < y.locally_owned_size(); ++i)
        if (i % 3 != 2)
          f.local_element(i) += spin_squared * ball.body().space().mass().local_element(i) * y.local_element(i);
      expected.add(factor, f);
    };
    add_force(h, -0.5 / h);
    add_force(-h, 0.5 / h);
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      if (ball.body().space().inverse_mass().local_element(i) == 0)
        product.local_element(i) = expected.local_element(i) = 0;
    EXPECT_LT(distance(product, expected), 1e-6) << of.name;
  }
}

TEST(MultigridTransfer, RestrictionIsTheTransposedInterpolation) {
  struct Levels {
    int finer_degree, finer_refinements, degree, refinements;
  };
  for (const auto& of : {Levels{5, 1, 3, 1}, Levels{1, 2, 1, 1}, Levels{3, 1, 2, 0}}) {
    const StrainedBall finer(cases.back(), of.finer_degree, of.finer_refinements),
        coarser(cases.back(), of.degree, of.refinements);
    const MultigridTransfer transfer(finer.body().space(), coarser.body().space());
    const Vector r = finer.irregular(), u = coarser.irregular();
    Vector restricted = coarser.body().make_vector(), interpolated = finer.body().make_vector();
    transfer.restrict_to_coarser(r, restricted);
    transfer.add_interpolated(u, interpolated);
    EXPECT_NEAR(restricted * u, r * interpolated, 1e-12 * r.l2_norm() * u.l2_norm()) << of.finer_degree;
    EXPECT_LT(distance(transfer.at_coarser_nodes(interpolated), u), 1e-13) << of.finer_degree;
  }
}

/// The numbers of a coarser mesh differ from those that its own cells have by the curvature of the cells.
TEST(MultigridTransfer, NumbersOfTheStiffnessConverge) {
  double before = 0;
  for (const int refinements : {1, 2}) {
    const StrainedBall finer(cases.back(), 2, refinements + 1), coarser(cases.back(), 2, refinements);
    const auto numbers = [](const StrainedBall& ball) {
      const CellStiffness cells(ball.body().space());
      StiffnessCoefficients c;
      for (unsigned int cell = 0; cell < ball.body().space().n_cells(); ++cell)
        c.push_back(tangent_coefficients(cells, ball.state(), cell, Balance::multiplier));
      return c;
    };
    const MultigridTransfer transfer(finer.body().space(), coarser.body().space());
    const StiffnessCoefficients found = transfer.at_coarser_points(numbers(finer)), expected = numbers(coarser);
    double difference = 0, size = 0;
    for (std::size_t cell = 0; cell < found.size(); ++cell) {
      difference += (found[cell] - expected[cell]).squaredNorm();
      size += expected[cell].squaredNorm();
    }
    const double relative = std::sqrt(difference / size);
    EXPECT_LT(relative, 0.05);
    if (before > 0) {
      EXPECT_LT(relative, before / 3);  // the geometry of elements of degree 2 converges with order 2 or more
    }
    before = relative;
  }
}

TEST(Multigrid, SolutionIsThatOfAFactorization) {
  for (const Case& of : cases)
    for (const bool holds : {false, true}) {
      const StrainedBall ball(of, 4, 1);
      HeldDirection held{ball.irregular(), 0.01};
      const HeldDirection* direction = holds ? &held : nullptr;
      Multigrid multigrid(ball.state(), direction, 1);
      ASSERT_TRUE(multigrid.factorize()) << of.name;
      const TangentProblem problem(ball.state(), 0, direction);
      ParitySector sector(problem, parity_of_sector(0));
      ASSERT_TRUE(sector.factorize()) << of.name;
      const Vector f = ball.irregular();
      Vector h = ball.lambda, u = ball.body().make_vector(), lambda = ball.lambda;
      for (unsigned int i = 0; i < h.locally_owned_size(); ++i) h.local_element(i) = 1e-3 * std::cos(5 * i);
      const auto report = multigrid.solve(f, h, 1e-10, u, lambda);
      ASSERT_TRUE(report.status) << of.name << ": " << report.status.reason();
      Eigen::VectorXd displacement, multiplier;
      const Eigen::VectorXd of_constraint = Eigen::Map<const Eigen::VectorXd>(h.begin(), h.locally_owned_size());
      ASSERT_TRUE(sector.solve(sector.entries_of(f), of_constraint, 1e-12, displacement, multiplier).status);
      EXPECT_LT(distance(u, sector.field_of(displacement)), 1e-5) << of.name;  // single precision
      if (!of.incompressible) continue;
      const Eigen::Map<const Eigen::VectorXd> found(lambda.begin(), multiplier.size());
      EXPECT_LT((found - multiplier).norm(), 1e-5 * multiplier.norm()) << of.name;
    }
}

/// From 1107 to 53,955 unknowns.
TEST(Multigrid, IterationsDoNotGrowWithMeshAndDegree) {
  for (const Case& of : {cases[0], cases[1], cases[3]}) {
    int fewest = 1000, most = 0;
    for (const auto& [degree, refinements] :
         {std::pair(2, 1), {2, 2}, {2, 3}, {3, 1}, {4, 0}, {4, 1}, {4, 2}, {5, 1}, {6, 1}, {7, 1}, {8, 0}, {8, 1}}) {
      const StrainedBall ball(of, degree, refinements);
      Multigrid multigrid(ball.state(), nullptr, refinements);
      ASSERT_TRUE(multigrid.factorize());
      Vector f = ball.body().make_vector(), u = f, lambda = ball.lambda;  // a tide
      for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
        f.local_element(i) =
            (i % 3 == 0 ? 1 : -0.5) * ball.body().space().mass().local_element(i) * ball.x.local_element(i);
      ball.body().space().clear_fixed(f);
      const auto report = multigrid.solve(f, ball.lambda, 1e-6, u, lambda);
      ASSERT_TRUE(report.status) << report.status.reason();
      fewest = std::min(fewest, report.iterations);
      most = std::max(most, report.iterations);
      RecordProperty(of.name + std::to_string(degree) + std::to_string(refinements), report.iterations);
    }
    EXPECT_LE(most, 1.5 * fewest) << of.name;
  }
}

}  // namespace
}  // namespace pseudorigid::testing
