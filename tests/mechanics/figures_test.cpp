/// The continuation along a family of figures of a body with one coordinate: f(x) = −V'(x) and h = 1, so that a figure
/// at the drive ν has V'(x) = ν.

#include "mechanics/equilibria/figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace {

using namespace pseudorigid::mechanics;

class Spring final : public FigureEquations {
 public:
  using Function = std::function<double(double)>;
  Spring(Function force, Function stiffness) : force_(std::move(force)), stiffness_(std::move(stiffness)) {}

  EquilibriumFigure affine(const Eigen::Vector3d& a, double drive) const override {
    return {Eigen::VectorXd::Constant(1, a[0]), {}, drive};
  }
  EquilibriumFigure at_rest() const { return affine(Eigen::Vector3d::Zero(), 0); }

  mutable std::vector<double> tangents_at;  ///< ν of each figure whose tangent was computed
  mutable int n_steps = 0;                  ///< Newton steps

 private:
  Status newton(const FigureCondition& condition, EquilibriumFigure& figure) const override {
    figure.drive = condition.value;
    for (int i = 0; i < 30; ++i) {
      const double r = condition.value - force_(figure.x[0]);
      if (std::abs(r) <= 1e-13 * std::abs(stiffness_(figure.x[0]))) return {};
      figure.x[0] += r / stiffness_(figure.x[0]);
      ++n_steps;
    }
    return Status::failure("no figure");
  }
  EquilibriumFigure tangent(const FigureCondition&, const EquilibriumFigure& figure, double) const override {
    tangents_at.push_back(figure.drive);
    return {Eigen::VectorXd::Constant(1, 1 / stiffness_(figure.x[0])), Eigen::VectorXd(), 1};
  }
  Status complete(EquilibriumFigure& figure) const override {
    figure.residual = std::abs(figure.drive - force_(figure.x[0]));
    return {};
  }
  bool is_admissible(const Eigen::VectorXd& x) const override { return x.allFinite(); }

  Function force_, stiffness_;
};

Spring hardening() {
  return {[](double x) { return x + x * x * x; }, [](double x) { return 1 + 3 * x * x; }};
}

TEST(FiguresFollow, ASmallLoadTakesOneStep) {
  Spring spring = hardening();
  EquilibriumFigure figure = spring.at_rest();
  const double x = 0.1;
  ASSERT_TRUE(spring.follow(0, {FigureParameter::drive, x + x * x * x}, figure));
  EXPECT_NEAR(figure.x[0], x, 1e-12);
  EXPECT_EQ(spring.tangents_at.size(), 1);
  EXPECT_LE(spring.n_steps, 3);
}

/// The number of steps follows from the way of x, not from the unit of the load.
TEST(FiguresFollow, NoPredictedMoveExceedsAQuarterOfTheRadius) {
  for (const double unit : {1.0, 1e6}) {
    Spring spring{[unit](double x) { return unit * (x + x * x * x); },
                  [unit](double x) { return unit * (1 + 3 * x * x); }};
    EquilibriumFigure figure = spring.at_rest();
    ASSERT_TRUE(spring.follow(0, {FigureParameter::drive, 10 * unit}, figure));
    EXPECT_NEAR(figure.x[0], 2, 1e-12);
    EXPECT_GE(spring.tangents_at.size(), 8);
    EXPECT_LE(spring.tangents_at.size(), 20);
    std::vector<double> drives = spring.tangents_at;
    drives.push_back(10 * unit);
    EquilibriumFigure at = spring.at_rest();
    for (std::size_t i = 0; i + 1 < drives.size(); ++i) {
      if (i > 0) {
        ASSERT_TRUE(spring.solve({FigureParameter::drive, drives[i]}, at));
      }
      const double rate = 1 / (unit * (1 + 3 * at.x[0] * at.x[0]));
      EXPECT_LE((drives[i + 1] - drives[i]) * rate, 0.25 * (1 + 1e-12));
    }
  }
}

TEST(FiguresFollow, GoesBackTheSameWay) {
  Spring spring = hardening();
  EquilibriumFigure figure = spring.at_rest();
  for (const double drive : {3.0, -2.0, 0.0}) {
    const double from = figure.drive;
    ASSERT_TRUE(spring.follow(from, {FigureParameter::drive, drive}, figure));
    EXPECT_NEAR(figure.x[0] + std::pow(figure.x[0], 3), drive, 1e-12);
  }
  EXPECT_FALSE(spring.follow(0, {FigureParameter::drive, std::numeric_limits<double>::infinity()}, figure));
}

/// V' = x/(1 + x) tends to 1. Steps become no shorter than 1/512 of the way.
TEST(FiguresFollow, EndsBeforeAFigureAtInfinity) {
  Spring spring{[](double x) { return x / (1 + x); }, [](double x) { return 1 / ((1 + x) * (1 + x)); }};
  EquilibriumFigure figure = spring.at_rest();
  EXPECT_FALSE(spring.follow(0, {FigureParameter::drive, 2}, figure));
  EXPECT_LE(figure.drive, 1);
  EXPECT_GE(figure.drive, 0.9);
  EXPECT_LE(spring.tangents_at.size(), 512);
}

TEST(FiguresFollow, EndsAtAFigureWithoutTangent) {
  Spring spring{[](double x) { return x; }, [](double x) { return x < 0.5 ? 1 : std::nan(""); }};
  EquilibriumFigure figure = spring.at_rest();
  EXPECT_FALSE(spring.follow(0, {FigureParameter::drive, 1}, figure));
  EXPECT_LE(figure.drive, 0.5);
}

/// V' = x − x² has its largest value 1/4 at x = 1/2. The last figure is within 1/512 of the way of the fold.
TEST(FiguresFollow, EndsAtAFold) {
  Spring spring{[](double x) { return x - x * x; }, [](double x) { return 1 - 2 * x; }};
  EquilibriumFigure figure = spring.at_rest();
  EXPECT_FALSE(spring.follow(0, {FigureParameter::drive, 1}, figure));
  EXPECT_LE(figure.drive, 0.25);
  EXPECT_GE(figure.drive, 0.25 - 2.0 / 512);
  EXPECT_LT(figure.x[0], 0.5);
  // A tangent is computed once at each figure, although steps from it fail.
  std::vector<double> drives = spring.tangents_at;
  EXPECT_EQ(std::ranges::adjacent_find(drives), drives.end());
}

}  // namespace
