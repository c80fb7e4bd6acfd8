/// The hydrostatic gauge of W shifts the multiplier by −c and nothing else (why the constraint is ∫ψ ln J):
/// W + c ln J adds to the force exactly the reaction of the constant multiplier −c, at any deformation, and the motion
/// stays the same up to round-off.

#include <gtest/gtest.h>

#include "continuum/balls.h"
#include "continuum/gauged_kernels.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;
constexpr double c = 3;

/// The ball with the force of W + c ln J.
struct GaugedBall {
  using Vector = continuum::Vector;
  using Multiplier = continuum::Vector;
  using Workspace = ElasticBall::Workspace;
  static constexpr int n_constraints = mechanics::dynamic_constraints;

  const ElasticBall& ball;
  std::unique_ptr<continuum::CellKernels> kernels = make_gauged_kernels(ball.space(), c);

  mechanics::Status force(double, const Vector& x, const Vector&, Workspace&, Vector& f) const {
    return kernels->force(x, f) > 0 ? mechanics::Status() : mechanics::Status::failure("J <= 0");
  }
  void apply_inverse_mass(const Vector& f, Vector& a) const { ball.apply_inverse_mass(f, a); }
  mechanics::Status constraint(const Vector& x, Multiplier& g) const { return ball.constraint(x, g); }
  void constraint_rate(const Vector& x, const Vector& v, Multiplier& r) const { ball.constraint_rate(x, v, r); }
  void constraint_curvature(const Vector& x, const Vector& v, Multiplier& r) const {
    ball.constraint_curvature(x, v, r);
  }
  void add_reaction(const Vector& x, const Multiplier& lambda, Vector& f) const { ball.add_reaction(x, lambda, f); }
  mechanics::SolveReport solve_gram(const Vector& x1, const Vector& x0, const Multiplier& r, Workspace& w,
                                    Multiplier& lambda) const {
    return ball.solve_gram(x1, x0, r, w, lambda);
  }
  double constraint_tolerance() const { return ball.constraint_tolerance(); }
  Vector make_vector() const { return ball.make_vector(); }
  Multiplier make_multiplier() const { return ball.make_multiplier(); }
  Workspace make_workspace() const { return ball.make_workspace(); }
};

struct Gauge : ::testing::Test {
  ElasticBall ball{octant, gauged_degree, 0, neo_hookean};
  GaugedBall gauged{ball};
  State<ElasticBall> start = affine_state(ball, diagonal(1.2, 1, 1 / 1.2), diagonal(0.24, 0.1, -0.3 / 1.2));
};

TEST_F(Gauge, ForceShiftsByTheReactionOfAConstant) {
  std::mt19937 generator(2);
  auto workspace = ball.make_workspace();
  Vector x = start.q, noise = random_field(x, generator), f = ball.make_vector(), f_gauged = f, shift = f;
  x.add(0.004, noise);
  ASSERT_TRUE(ball.force(0, x, start.v, workspace, f));
  ASSERT_TRUE(gauged.force(0, x, start.v, workspace, f_gauged));
  Vector one = ball.make_multiplier();
  const Vector& X = ball.space().reference_positions();
  ball.constraint_rate(X, X, one);  // tr Id = 3
  one *= -c / 3;
  ball.add_reaction(x, one, shift);
  EXPECT_GT(shift.linfty_norm(), 0.01);
  f_gauged.add(-1.0, f, -1.0, shift);
  EXPECT_LT(f_gauged.linfty_norm(), 1e-13);
}

TEST_F(Gauge, MotionIsTheSame) {
  const auto plain = run<mechanics::Rattle>(ball, start, 4, 8, 40);
  const auto shifted = run<mechanics::Rattle>(gauged, State<GaugedBall>{0, start.q, start.v}, 4, 8, 40);
  ASSERT_TRUE(plain.finished() && shifted.finished());
  double difference = 0;
  for (std::size_t k = 0; k < plain.states.size(); ++k) {
    const State<GaugedBall> state{0, plain.states[k].q, plain.states[k].v};
    difference = std::max(difference, distance(state, shifted.states[k]));
  }
  EXPECT_LT(difference, 1e-11);
  EXPECT_GT((ball.mass_moment(plain.last().q) - diagonal(1.2, 1, 1 / 1.2)).norm(), 0.05);
}

}  // namespace
}  // namespace pseudorigid::testing
