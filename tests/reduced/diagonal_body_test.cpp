/// The diagonal form of the pseudo-rigid body: the same motion as (5.120) with nine numbers.

#include "reduced/diagonal_body.h"

#include <gtest/gtest.h>

#include "mechanics/core/explicit_multiplier.h"
#include "reduced/potentials.h"
#include "support/conserved.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

using reduced::DiagonalBody;

Matrix3d diagonal_quadratic() { return diagonal(-0.2, 0.1, 0.3); }
/// Elastic; with gravity; with an external potential; all, on a reference ellipsoid; a fluid with gravity.
template <class Body>
std::vector<Body> diagonal_bodies() {
  const Loads all{0.3, diagonal_quadratic(), reduced::ReferenceBody::ellipsoid({1.2, 0.9, 0.8})};
  std::vector<Body> bodies;
  for (const auto& [name, law] : laws(Body::n_constraints > 0))
    if (name == "neo-hookean" || name == "mooney-rivlin")
      for (const auto& loads : {Loads{}, Loads{0.3}, Loads{0, diagonal_quadratic()}, all})
        bodies.push_back(loaded_body<Body>(law, loads));
  if (Body::n_constraints > 0) bodies.push_back(loaded_body<Body>(materials::Fluid{}, {0.3}));
  return bodies;
}
template <class Body>
State<Body> diagonal_start() {
  const Matrix3d Q = diagonal(1.3, 1, 1 / 1.3);
  return moving<Body>(Q, Q * diagonal(0.5, -0.9, 0.4));  // axes cross
}

template <class Body>
class DiagonalForm : public ::testing::Test {};
using BothGroups = ::testing::Types<LoadedSl3, LoadedGl3>;
TYPED_TEST_SUITE(DiagonalForm, BothGroups);

/// Fixed steps, the same steps: round-off is all that is between the two. The observables are those of the body.
TYPED_TEST(DiagonalForm, HasTheMotionOfTheFullForm) {
  using Body = TypeParam;
  for (const Body& body : diagonal_bodies<Body>()) {
    const auto start = diagonal_start<Body>();
    const DiagonalBody<Body> three(body);
    const auto full = run<mechanics::Rattle8>(body, start, 6, 30, 10);
    const auto short_form = run<mechanics::Rattle8>(three, three.state_of(start), 6, 30, 10);
    ASSERT_TRUE(full.finished() && short_form.finished()) << full.result.reason << short_form.result.reason;
    for (std::size_t k = 0; k < full.states.size(); ++k) {
      EXPECT_LT(distance(three.motion(short_form.states[k]), full.states[k]), 1e-12);
      const auto o = observed(three, short_form.states[k]), p = observed(body, full.states[k]);
      EXPECT_NEAR(o.kinetic, p.kinetic, 1e-12);
      EXPECT_NEAR(o.energy(), p.energy(), 1e-12);
      EXPECT_NEAR(o.multiplier, p.multiplier, 1e-11);
      EXPECT_NEAR(o.volume_ratio, p.volume_ratio, 1e-12);
      EXPECT_EQ(o.angular_momentum, Vector3d::Zero());
      EXPECT_EQ(o.circulation, Vector3d::Zero());
    }
    EXPECT_GT((full.states[5].q - start.q).norm(), 0.1);
  }
}

/// The same with the explicit multiplier and error control.
TYPED_TEST(DiagonalForm, HasTheMotionOfTheFullFormByItsExplicitMultiplier) {
  using Body = TypeParam;
  for (const Body& body : diagonal_bodies<Body>()) {
    const auto start = diagonal_start<Body>();
    const DiagonalBody<Body> three(body);
    const auto full = integrate(mechanics::ExplicitMultiplier(body), start, 4);
    const auto end = integrate(mechanics::ExplicitMultiplier(three), three.state_of(start), 4);
    EXPECT_LT(distance(three.motion(end), full), 1e-11) << "two errors at the tolerance 1e-13";
  }
}

/// It is a conservative system of its own: K, V, M and the rate of its reaction are consistent.
TYPED_TEST(DiagonalForm, KeepsItsEnergyByTheConservingMethod) {
  using Body = TypeParam;
  for (const Body& body : diagonal_bodies<Body>()) {
    const DiagonalBody<Body> three(body);
    const auto start = three.state_of(diagonal_start<Body>());
    EXPECT_NEAR(energy(three, start), energy(body, diagonal_start<Body>()), 1e-14);
    expect_everything_kept<mechanics::EnergyMomentum>(three, start, 0.02, 300);
  }
}

TYPED_TEST(DiagonalForm, StatesGoThereAndBack) {
  using Body = TypeParam;
  const DiagonalBody<Body> three(loaded_body<Body>(Law{1, 2}, {}));
  const auto start = diagonal_start<Body>();
  const auto back = three.motion(three.state_of({2.5, start.q, start.v}));
  EXPECT_EQ(back.t, 2.5);
  EXPECT_EQ(back.q, start.q);
  EXPECT_EQ(back.v, start.v);
}

/// Half a turn: diagonal, with two negative entries.
TEST(DiagonalBody, MayBeTurnedByHalfATurn) {
  const auto plain = elastic_sl3({0.3, diagonal_quadratic()});
  State<LoadedSl3> two_turned = diagonal_start<LoadedSl3>();
  two_turned.q = diagonal(-1.3, -1, 1 / 1.3);
  two_turned.v = Matrix3d::Zero();
  const DiagonalBody<LoadedSl3> three(plain);
  const auto full = run<mechanics::Rattle8>(plain, two_turned, 3, 1, 150);
  const auto short_form = run<mechanics::Rattle8>(three, three.state_of(two_turned), 3, 1, 150);
  EXPECT_LT(distance(three.motion(short_form.last()), full.last()), 1e-12);
}

}  // namespace
}  // namespace pseudorigid::testing
