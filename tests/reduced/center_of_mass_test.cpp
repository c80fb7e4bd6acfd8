/// The centre of mass ẍ = b − Tx − cẋ against closed forms and against integration.

#include "reduced/center_of_mass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/differences.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using reduced::CenterOfMass;

const Vector3d x0(0.3, -0.2, 1.1), v0(-0.5, 0.7, 0.4), b(0.2, -0.1, -9.81);
constexpr double times[] = {0, 0.1, 1, 3.7, -2};

void expect_motion(const CenterOfMass::Motion& m, const Vector3d& x, const Vector3d& v, double tolerance) {
  EXPECT_LT((m.x - x).norm(), tolerance * (1 + x.norm()));
  EXPECT_LT((m.v - v).norm(), tolerance * (1 + v.norm()));
}

TEST(CenterOfMass, FallsFreely) {
  const CenterOfMass c{.position = x0, .velocity = v0, .acceleration = b};
  for (const double t : times) expect_motion(c.at(t), x0 + t * v0 + t * t / 2 * b, v0 + t * b, 1e-15);
  expect_motion(CenterOfMass{.position = x0, .velocity = v0}.at(1e6), x0 + 1e6 * v0, v0, 1e-15);
}

/// T = ω² Id: x = x_e + (x₀ − x_e) cos ωt + v₀ sin ωt/ω about x_e = b/ω²; long times too.
TEST(CenterOfMass, OscillatesInATrap) {
  const double w = 1.3;
  const CenterOfMass c{.position = x0, .velocity = v0, .acceleration = b, .quadratic = w * w * Matrix3d::Identity()};
  const Vector3d x_e = b / (w * w);
  for (const double t : {0.0, 0.1, 1.0, 3.7, -2.0, 100.0}) {
    const double cosine = std::cos(w * t), sine = std::sin(w * t);
    expect_motion(c.at(t), x_e + (x0 - x_e) * cosine + v0 * sine / w, v0 * cosine - w * (x0 - x_e) * sine, 1e-12);
  }
}

/// T = −σ² Id: cosh and sinh.
TEST(CenterOfMass, LeavesAnUnstableEquilibriumExponentially) {
  const double s = 0.9;
  const CenterOfMass c{.position = x0, .velocity = v0, .quadratic = -s * s * Matrix3d::Identity()};
  for (const double t : {0.0, 0.1, 1.0, 3.7, -2.0, 20.0}) {
    const double C = std::cosh(s * t), S = std::sinh(s * t);
    expect_motion(c.at(t), x0 * C + v0 * S / s, v0 * C + s * x0 * S, 1e-12);
  }
  EXPECT_FALSE(c.at(1e5).x.allFinite()) << "beyond all numbers";
}

/// Drag alone: x = x₀ + b t/c + (v₀ − b/c)(1 − e^{−ct})/c.
TEST(CenterOfMass, IsStoppedByDrag) {
  const double drag = 0.4;
  const CenterOfMass c{.position = x0, .velocity = v0, .acceleration = b, .drag = drag};
  for (const double t : times) {
    const double decay = std::exp(-drag * t);
    const Vector3d v_end = b / drag, lost = v0 - v_end;
    expect_motion(c.at(t), x0 + v_end * t + lost * (1 - decay) / drag, v_end + lost * decay, 1e-13);
  }
}

/// Trap and drag, under-damped, critical (a Jordan block) and over-damped at once on three axes.
TEST(CenterOfMass, DampedOscillation) {
  const double drag = 2;
  const Vector3d w_squared(4, 1, 0.25);
  const CenterOfMass c{.position = x0, .velocity = v0, .quadratic = w_squared.asDiagonal(), .drag = drag};
  for (const double t : times) {
    const double d = drag / 2, decay = std::exp(-d * t), under = std::sqrt(3.0), over = std::sqrt(0.75);
    const Vector3d C(std::cos(under * t), 1, std::cosh(over * t));
    const Vector3d S(std::sin(under * t) / under, t, std::sinh(over * t) / over);
    const Vector3d slip = v0 + d * x0;
    const Vector3d x = decay * (x0.cwiseProduct(C) + slip.cwiseProduct(S));
    const Vector3d v = decay * (v0.cwiseProduct(C) - (d * v0 + w_squared.cwiseProduct(x0)).cwiseProduct(S));
    expect_motion(c.at(t), x, v, 1e-13);
  }
}

/// ẍ = b − Tx − cẋ as it stands, for the integrator.
struct CenterField {
  using Vector = Vector3d;
  struct Workspace {};
  CenterOfMass c;
  mechanics::Status acceleration(double, const Vector& x, const Vector& v, Workspace&, Vector& a) const {
    a = c.acceleration - c.quadratic * x - c.drag * v;
    return {};
  }
  Vector make_vector() const { return Vector::Zero(); }
  Workspace make_workspace() const { return {}; }
};

/// All at once, T with its axes askew and one of them unstable.
TEST(CenterOfMass, IsTheIntegralOfItsLaw) {
  Matrix3d T;
  T << 1.2, 0.3, -0.1, 0.3, -0.2, 0.2, -0.1, 0.2, 0.7;
  ASSERT_LT(T.determinant(), 0);
  const CenterOfMass c{.position = x0, .velocity = v0, .acceleration = b, .quadratic = T, .drag = 0.3};
  const mechanics::VectorState<Vector3d> start{0, x0, v0};
  for (const auto& s : integrate_samples(CenterField{c}, start, 10, 40)) expect_motion(c.at(s.t), s.q, s.v, 1e-11);
}

/// Energies per mass: their sum is constant without drag, and falls at the rate c v² with it.
TEST(CenterOfMass, Energies) {
  Matrix3d T;
  T << 1.2, 0.3, -0.1, 0.3, 0.9, 0.2, -0.1, 0.2, 0.7;
  const auto energy = [](const CenterOfMass& c, double t) {
    const auto m = c.at(t);
    return CenterOfMass::kinetic(m) + c.potential(m);
  };
  const CenterOfMass free{.position = x0, .velocity = v0, .acceleration = b},
      trapped{.position = x0, .velocity = v0, .acceleration = b, .quadratic = T},
      dragged{.position = x0, .velocity = v0, .acceleration = b, .quadratic = T, .drag = 0.3};
  for (const double t : times) {
    EXPECT_NEAR(energy(free, t), energy(free, 0), 1e-11);
    EXPECT_NEAR(energy(trapped, t), energy(trapped, 0), 1e-11);
    const double h = 0.01, rate = first_difference([&](int k) { return energy(dragged, t + k * h); }, h);
    EXPECT_NEAR(rate, -0.3 * dragged.at(t).v.squaredNorm(), 1e-10);
  }
}

}  // namespace
}  // namespace pseudorigid::testing
