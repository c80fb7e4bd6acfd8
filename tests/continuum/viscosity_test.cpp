/// The viscous force of the kernels and the damping of motions.

#include <gtest/gtest.h>

#include <algorithm>

#include "continuum/balls.h"
#include "continuum/modes/rest_problem.h"
#include "mechanics/core/dense_algebra.h"
#include "mechanics/steps/largest_frequency.h"
#include "reduced/dissipative_body.h"
#include "reduced/pseudo_rigid_body.h"
#include "support/order_fit.h"

namespace pseudorigid::testing {
namespace {

using continuum::Vector;

struct ViscousKernel : ::testing::TestWithParam<int> {
  const CompressibleBall ball{whole, GetParam(), 0, neo_hookean};
  std::mt19937 generator{3};
  /// Noise of the size of the distance between nodes: no affine state, det F > 0.
  Vector positions() {
    Vector x = ball.affine_field(Matrix3d::Identity() + 0.2 * random_matrix(generator));
    x.add(0.004, random_field(x, generator));
    return x;
  }
  double viscous(const Vector& x, const Vector& v, Vector& f) const {
    f = 0.0;
    return ball.kernels().add_viscous_force(0.7, x, v, f);
  }
};

TEST_P(ViscousKernel, TakesThePowerThatItReturns) {
  const Vector x = positions(), v = random_field(x, generator);
  Vector f = ball.make_vector();
  const double power = viscous(x, v, f);
  EXPECT_GT(power, 0);
  EXPECT_NEAR(f * v, -power, 1e-12 * power);
}

TEST_P(ViscousKernel, LeavesRigidMotionsAlone) {
  const Vector x = positions();
  const Matrix3d turn = mechanics::cross_matrix(Vector3d(0.3, -0.8, 0.5));
  Vector v = ball.affine_field(Matrix3d::Zero(), Vector3d(1, 2, -1)), f = ball.make_vector();
  for (unsigned int i = 0; i < x.size(); i += 3)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) v[i + r] += turn(r, c) * x[i + c];
  EXPECT_LT(std::abs(viscous(x, v, f)), 1e-12);
  EXPECT_LT(f.linfty_norm(), 1e-12);
}

TEST_P(ViscousKernel, HasNoTorque) {
  const Vector x = positions(), v = random_field(x, generator);
  Vector f = ball.make_vector();
  viscous(x, v, f);
  ball.apply_inverse_mass(f, f);
  const Matrix3d moment = ball.nodal_moment(f, x);
  EXPECT_LT(mechanics::axial_vector(moment).norm(), 1e-13 * moment.norm());
}

/// At rest σ = 2η sym∇v is the elastic stress 2μ sym∇u of the neo-Hookean law without λ.
TEST_P(ViscousKernel, IsTheStiffnessOfAShearModulusAtRest) {
  const Vector& X = ball.space().reference_positions();
  const Vector u = random_field(X, generator);
  Vector f = ball.make_vector(), forward = f, backward = f, x = X;
  viscous(X, u, f);
  const double step = 1e-5;  // differences err by its square times third derivatives of 1e4 to 1e6
  x.add(step, u);
  ASSERT_GT(ball.kernels().force(x, forward), 0);
  x.add(-2 * step, u);
  ASSERT_GT(ball.kernels().force(x, backward), 0);
  forward.add(-1.0, backward);
  forward *= 0.7 / (2 * step);
  forward.add(-1.0, f);
  EXPECT_LT(forward.linfty_norm(), 1e-5 * f.linfty_norm());
}

INSTANTIATE_TEST_SUITE_P(Degree, ViscousKernel, ::testing::Values(2, 3, 5));

/// C = (η/μ)K at rest, so that γ = (η/μ)ω². As many
/// steps of Lanczos as the program makes: many more lose orthogonality, and a copy of the largest value that has not
/// converged yet adds its residual, up to some percent.
template <class Ball>
class LargestDamping : public ::testing::Test {};
using BothBalls = ::testing::Types<ElasticBall, CompressibleBall>;
TYPED_TEST_SUITE(LargestDamping, BothBalls);

TYPED_TEST(LargestDamping, IsThatOfTheStiffness) {
  constexpr double eta = 0.1, drag = 0.5;
  constexpr int n_lanczos = 24;
  const materials::AnyLaw law = materials::make_law("neo-hookean", {.shear_modulus = 1, .lame_lambda = 1e-12},
                                                    false);  // λ = 0: K is that of shear
  const TypeParam ball(octant, 3, 0, law, {loads::Viscosity{eta}, loads::Drag{drag}}), free(octant, 3, 0, law);
  auto workspace = ball.make_workspace(), free_workspace = free.make_workspace();
  const auto free_rest = affine_state(free, Matrix3d::Identity(), Matrix3d::Zero());
  const auto rest = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
  const auto omega = mechanics::largest_frequency(free, free_rest, free_workspace, n_lanczos);
  ASSERT_TRUE(omega.status);
  const auto damping = mechanics::largest_damping(ball, rest, workspace, omega.omega, n_lanczos);
  ASSERT_TRUE(damping.status);
  EXPECT_NEAR(damping.gamma, eta * omega.omega * omega.omega + drag, 1e-6 * damping.gamma);
  EXPECT_EQ(mechanics::largest_damping(free, free_rest, free_workspace, omega.omega, n_lanczos).gamma, 0);
}

/// η = 20, of which the largest rate of damping γ is above 10³: steps of hγ = 80 and more, up to the limit of the
/// elastic forces, and of hγ = 10 and less, if these resolve what is left of the start, with the order 2 in Q.
TYPED_TEST(LargestDamping, DoesNotLimitTheStep) {
  const TypeParam ball(octant, 2, 0, ciarlet_geymonat, {loads::Viscosity{20}, loads::Drag{0.5}});
  const auto start = affine_state(ball, diagonal(1.2, 1, 1 / 1.2), diagonal(0.24, 0, -0.2 / 1.2));
  constexpr double T = 0.8;
  std::vector<Matrix3d> Q;
  std::vector<ErrorPoint> points;
  for (const long n : {10, 80, 160, 320, 640}) {
    const auto r = run<mechanics::Rattle>(ball, start, T, 1, n);
    ASSERT_TRUE(r.finished()) << n << ": " << r.result.reason;
    if (n == 10) continue;
    Q.push_back(ball.mass_moment(r.last().q));
    if (Q.size() > 1) points.push_back({T / static_cast<double>(n), (Q[Q.size() - 2] - Q.back()).norm()});
  }
  EXPECT_NEAR(fit_order(points).order, 2, 0.25);
}

template <class Ball>
struct WithoutPreconditioner : Ball {
  using Ball::Ball;
  int n_damped_entries() const { return 0; }
};

/// The preconditioner of the linear systems for the velocity changes the work, not the motion.
TYPED_TEST(LargestDamping, HasTheSameMotionWithHalfTheProducts) {
  const loads::Loads viscous{loads::Viscosity{200}};
  const TypeParam ball(octant, 2, 0, ciarlet_geymonat, viscous);
  const WithoutPreconditioner<TypeParam> plain(octant, 2, 0, ciarlet_geymonat, viscous);
  const auto start = affine_state(ball, diagonal(1.2, 1, 1 / 1.2), diagonal(0.24, 0, -0.2 / 1.2));
  const auto fast = run<mechanics::Rattle>(ball, start, 4, 1, 100),
             slow = run<mechanics::Rattle>(plain, start, 4, 1, 100);
  ASSERT_TRUE(fast.finished() && slow.finished()) << fast.result.reason << slow.result.reason;
  EXPECT_LT(distance(fast.last(), slow.last()), 1e-10);
  EXPECT_LT(2 * fast.counters.n_force, slow.counters.n_force);
}

/// Amplitudes of a damped oscillation at equal intervals Δ obey a_{k+1} = 2e^{−δΔ}cos(νΔ) a_k − e^{−2δΔ} a_{k−1}: both
/// coefficients by least squares.
double decay_rate(const std::vector<double>& a, double interval) {
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (std::size_t k = 1; k + 1 < a.size(); ++k) {
    const Eigen::Vector2d row(a[k], a[k - 1]);
    A += row * row.transpose();
    b += row * a[k + 1];
  }
  return -std::log(-mechanics::solve(A, b)(1)) / (2 * interval);
}

constexpr double eta = 0.01, amplitude = 1e-6, end = 12;
constexpr int n_samples = 60;

/// PHYSICS 7.7: every mode decays at δ = ηω²/(2μ), S2 of the sphere at 3.5528 η.
TEST(ViscousDecay, OfTheModeS2) {
  const ElasticBall ball(octant, 4, 0, neo_hookean, {loads::Viscosity{eta}});
  const continuum::BallSpace space(continuum::BallMesh(octant, 0), 4);
  const auto kernels = continuum::make_cell_kernels(space, neo_hookean);
  const continuum::RestProblem problem(space, *kernels, neo_hookean, true);
  continuum::ParitySector symmetric(problem, continuum::parity_of_sector(0));
  ASSERT_TRUE(symmetric.factorize());
  // Its lowest mode; the next one, S4, loses by a factor of about 3 an iteration.
  Eigen::MatrixXd y = Eigen::VectorXd::Unit(static_cast<Eigen::Index>(symmetric.n_unknowns()), 0), z;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(symmetric.apply(y, z));
    y = z.normalized();
  }
  continuum::ParitySector::Modes modes;
  ASSERT_TRUE(symmetric.modes_of(y, modes));
  Vector S2 = symmetric.field_of(modes.u);
  S2 *= amplitude / S2.linfty_norm();

  auto state = affine_state(ball, Matrix3d::Identity(), Matrix3d::Zero());
  std::copy(S2.begin(), S2.end(), state.v.begin());
  Vector momentum = state.v;
  momentum.scale(ball.space().mass());
  const auto r = run<mechanics::Rattle>(ball, state, end, n_samples, 60);  // h = 1/300
  ASSERT_TRUE(r.finished()) << r.result.reason;
  std::vector<double> a;
  for (const auto& s : r.states) a.push_back(s.v * momentum);
  const double delta = decay_rate(a, end / n_samples), exact = eta * 2.665622189236 * 2.665622189236 / 2;
  std::printf("S2 decays at %.7f eta, exact %.7f, relative difference %.1e\n", delta / eta, exact / eta,
              delta / exact - 1);
  EXPECT_NEAR(exact / eta, 3.5528, 1e-4);
  EXPECT_NEAR(delta / exact, 1, 1e-4);
}

TEST(ViscousDecay, OfThePseudoRigidBall) {
  using Body = reduced::PseudoRigidBody<CiarletGeymonat, true>;
  const reduced::DissipativeBody<Body> body({neo_hookean, reduced::ReferenceBody::unit_ball()}, {.viscosity = eta});
  const auto start = body.state_of({0, Matrix3d::Identity(), amplitude * diagonal(1, 0, -1)});
  const auto r = run<mechanics::Rattle>(body, start, end, n_samples, 60);
  ASSERT_TRUE(r.finished());
  std::vector<double> a;
  for (const auto& s : r.states) a.push_back(s.v(0, 0));
  const double delta = decay_rate(a, end / n_samples);
  std::printf("the pseudo-rigid ball decays at %.7f eta\n", delta / eta);
  EXPECT_NEAR(delta / eta, 5, 5e-4);
}

template <class Ball>
class EnergyBalance : public ::testing::Test {};
TYPED_TEST_SUITE(EnergyBalance, BothBalls);

/// Energy with what dissipation has taken is constant up to the error of the method, of order 2.
TYPED_TEST(EnergyBalance, HasTheOrderOfTheMethod) {
  const TypeParam ball(octant, 2, 0, ciarlet_geymonat, all_loads(octant));
  const auto start = affine_state(ball, diagonal(1.2, 1, 1 / 1.2), diagonal(0.24, 0.1, -0.3 / 1.2));
  const double energy = observed(ball, start, {{.multiplier = false}}).energy();
  std::vector<ErrorPoint> points;
  constexpr double T = 0.4;
  for (const long n : {40, 80, 160}) {
    const auto r = run<mechanics::Rattle>(ball, start, T, 1, n);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    const auto o = observed(ball, r.last(), {{.multiplier = false}});
    EXPECT_GT(o.dissipated, 0.05);
    points.push_back({T / static_cast<double>(n), std::abs(o.energy() - energy)});
    std::printf("%ld steps: energy changes by %.2e, dissipated %.4f\n", n, points.back().error, o.dissipated);
  }
  EXPECT_NEAR(fit_order(points).order, 2, 0.1);
}

}  // namespace
}  // namespace pseudorigid::testing
