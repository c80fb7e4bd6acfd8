/// Round-off of RATTLE on SL(3) is random: what has a sign would add up to a drift of energy and momenta in long runs.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "mechanics/methods/composition.h"
#include "reduced/bodies.h"

namespace pseudorigid::testing {

using Extended = Eigen::Matrix<long double, 3, 3>;
using ExtendedVector = Eigen::Matrix<long double, 3, 1>;

Extended extended(const Matrix3d& x) { return x.cast<long double>(); }
Extended extended(const Matrix3d& x, const Matrix3d& rounding) { return extended(x) + extended(rounding); }
ExtendedVector axial(const Extended& A) { return {A(1, 2) - A(2, 1), A(2, 0) - A(0, 2), A(0, 1) - A(1, 0)}; }

/// Mean of a random quantity and its standard error.
struct Mean {
  long n = 0;
  long double sum = 0, squares = 0;
  void add(long double x) { ++n, sum += x, squares += x * x; }
  double value() const { return static_cast<double>(sum / n); }
  double standard_error() const { return static_cast<double>(std::sqrt((squares / n - sum * sum / (n * n)) / n)); }
};

/// Configurations about that of the benchmark with a given det Q ≈ 1 up to the rounding of Q.
class RandomShape {
 public:
  Matrix3d operator()(long double determinant = 1) {
    Matrix3d Q = rotation_z(0.4) * diagonal(1.3, 1, 1 / 1.3) * matrix({1, 0.3, 0.2, -0.1, 1, 0.4, 0.2, -0.3, 1});
    Q += 1e-3 * any();
    Q /= std::cbrt(Q.determinant());
    const long double missing = determinant - extended(Q).determinant();
    return (extended(Q) * (1 + missing / 3)).cast<double>();
  }
  Matrix3d any() {
    return Matrix3d::NullaryExpr([&] { return uniform_(generator_); });
  }

 private:
  std::mt19937_64 generator_{1};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// Round-off of det Q as a double is 1e-16.
TEST(RoundOff, PositionsMeetTheConstraintBelowTheLastPlace) {
  const Sl3 body = neo_hookean_sl3();
  auto state = benchmark_state<Sl3>();
  mechanics::Rattle8::Workspace<Sl3> w(body);
  long double greatest = 0;
  for (int i = 0; i < 2000; ++i) {
    ASSERT_TRUE(mechanics::Rattle8::advance(body, 1.0 / 28, state, w).ok());
    greatest = std::max(greatest, std::abs(extended(state.q, w.q_rounding).determinant() - 1));
  }
  EXPECT_LT(greatest, 4e-18L);  // twice the tolerance of 1.6e-18, and round-off of this determinant
}

/// Where det Q is rounded to 1 − 2⁻⁵³ more often than to 1 + 2⁻⁵², s cof Q with s ≈ 1 must not get a mean torque. Five
/// standard errors; multiplication by 1/det Q has tens of them.
TEST(RoundOff, ForceAndReactionExertNoTorqueOnAverage) {
  const Sl3 body = neo_hookean_sl3();
  RandomShape shape;
  Sl3::Workspace w;
  std::array<Mean, 3> of_force, of_reaction;
  for (int n = 0; n < 20000; ++n) {
    const Matrix3d Q = shape(1 - 3e-16L);
    Matrix3d force = Matrix3d::Zero(), reaction = force;
    ASSERT_TRUE(body.force(0, Q, Q, w, force).ok());
    body.add_reaction(Q, 1.0, reaction);
    const ExtendedVector a = axial(extended(force) * extended(Q).transpose()),
                         b = axial(extended(reaction) * extended(Q).transpose());
    for (int i = 0; i < 3; ++i) of_force[i].add(a(i)), of_reaction[i].add(b(i));
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(std::abs(of_force[i].value()), 5 * of_force[i].standard_error()) << i;
    EXPECT_LT(std::abs(of_reaction[i].value()), 5 * of_reaction[i].standard_error()) << i;
  }
}

/// q_{n+1} = q_n + h v_{n+1/2}: the part of v that Newton's iteration has added moves q by h times itself, without a
/// relative error of mean h fl(1/h) − 1. First steps, which have no guess of the multiplier.
TEST(RoundOff, PositionMovesByTheVelocity) {
  const Sl3 body = neo_hookean_sl3();
  constexpr double h = 0.11;
  ASSERT_GT(std::abs(std::fma(h, 1 / h, -1.0)), 7e-17);
  RandomShape shape;
  Mean error_along, square;
  for (int i = 0; i < 20000; ++i) {
    const Matrix3d Q = shape();
    auto start = moving<Sl3>(Q, shape.any());
    mechanics::Rattle::Workspace<Sl3> w(body);
    ASSERT_TRUE(mechanics::Rattle::project_velocity(body, start, w).ok());
    w.v_rounding.setZero();
    auto end = start;
    ASSERT_TRUE(mechanics::Rattle::advance(body, h, end, w).ok());
    Matrix3d a_start = Matrix3d::Zero(), a_end = a_start;
    ASSERT_TRUE(body.force(0, start.q, start.v, w.system, a_start).ok());
    ASSERT_TRUE(body.force(0, end.q, end.v, w.system, a_end).ok());
    body.apply_inverse_mass(a_start, a_start);
    body.apply_inverse_mass(a_end, a_end);
    const Extended v_half = extended(end.v, w.v_rounding) - (h / 2.0L) * extended(a_end),
                   added = v_half - extended(start.v) - (h / 2.0L) * extended(a_start),
                   error = extended(end.q, w.q_rounding) - extended(start.q) - static_cast<long double>(h) * v_half;
    error_along.add(error.cwiseProduct(added).sum());
    square.add(h * added.squaredNorm());
  }
  EXPECT_LT(std::abs(error_along.value()), 5 * error_along.standard_error());
  EXPECT_LT(5 * error_along.standard_error(), 3e-17 * square.value());  // else the line above says nothing
}

}  // namespace pseudorigid::testing
