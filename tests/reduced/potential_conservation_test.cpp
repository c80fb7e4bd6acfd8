/// What motions under every potential keep, as each method promises, and Dedekind's duality: every law of the table on
/// SL(3) and GL⁺(3), with and without gravity, with and without a quadratic external potential.

#include <gtest/gtest.h>

#include <algorithm>

#include "mechanics/core/explicit_multiplier.h"
#include "reduced/potentials.h"
#include "support/conserved.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

std::vector<Loads> all_loads() {
  return {{}, {weak_gravity}, {0, generic_quadratic()}, {weak_gravity, generic_quadratic()}};
}
/// Every law under every load, with the time that its motion lasts for: on GL⁺(3) the Saint Venant–Kirchhoff law as
/// printed depends on |F| alone, so that shears meet no resistance and turn the body inside out after t = 1.
template <class Body, class Check>
void for_each_body(const Check& check) {
  for (const auto& [name, law] : laws(Body::n_constraints > 0))
    for (const auto& loads : all_loads()) {
      const bool lasts = Body::n_constraints > 0 || name != "saint-venant-kirchhoff (as printed)";
      SCOPED_TRACE(std::string(name) + (loads.G != 0 ? ", gravity" : "") +
                   (loads.quadratic.isZero() ? "" : ", quadratic potential"));
      check(loaded_body<Body>(law, loads), lasts ? 10 : 1);
    }
}

template <class Body>
class EveryPotential : public ::testing::Test {};
using BothGroups = ::testing::Types<LoadedSl3, LoadedGl3>;
TYPED_TEST_SUITE(EveryPotential, BothGroups);

/// Energy, momenta (with an external potential there are none) and constraint to 1e-13.
TYPED_TEST(EveryPotential, EnergyMomentumKeepsEverything) {
  for_each_body<TypeParam>([](const TypeParam& body, int end) {
    EXPECT_EQ(body.n_symmetries(), body.energy_density().depends_on_direction() ? 0 : 6);
    for (const int steps : {50, 20})  // in a unit of time
      expect_everything_kept<mechanics::EnergyMomentum>(body, benchmark_state<TypeParam>(), 1.0 / steps, steps * end);
  });
}

/// The largest departures from the start along some states.
struct Change {
  double energy = 0, angular_momentum = 0, circulation = 0;
};
template <class Body>
Change largest_change(const Body& body, const std::vector<State<Body>>& states) {
  Change change;
  const auto start = observed(body, states.front());
  for (const auto& s : states) {
    const auto o = observed(body, s);
    change.energy = std::max(change.energy, std::abs(o.energy() - start.energy()));
    change.angular_momentum = std::max(change.angular_momentum, (o.angular_momentum - start.angular_momentum).norm());
    change.circulation = std::max(change.circulation, (o.circulation - start.circulation).norm());
  }
  return change;
}
/// J and Z are kept to `tolerance` where no external potential acts, and change where one does.
template <class Body>
void expect_momenta_kept(const Body& body, const Change& change, double tolerance) {
  if (!body.energy_density().depends_on_direction()) {
    EXPECT_LT(change.angular_momentum, tolerance);
    EXPECT_LT(change.circulation, tolerance);
  } else {
    EXPECT_GT(change.angular_momentum, 1e-2) << "T has no symmetry";
    EXPECT_LT(change.circulation, tolerance) << "the loads do not know the turns of the ball";
  }
}

/// RATTLE of order 8: momenta to round-off, the energy error small and bounded: it does not grow from the first half of
/// the run to the rest.
TYPED_TEST(EveryPotential, Rattle8KeepsMomentaAndBoundsTheEnergyError) {
  for_each_body<TypeParam>([](const TypeParam& body, int end) {
    const auto r = run<mechanics::Rattle8>(body, benchmark_state<TypeParam>(), end, 20 * end, 2);
    ASSERT_TRUE(r.finished()) << r.result.reason;
    const auto whole = largest_change(body, r.states);
    const auto early = largest_change<TypeParam>(body, {r.states.begin(), r.states.begin() + 10 * end});
    EXPECT_LT(whole.energy, 1e-7);
    EXPECT_LT(whole.energy, 3 * early.energy + 1e-11);
    expect_momenta_kept(body, whole, 1e-13);
  });
}

/// The explicit method of order 8 keeps all to its tolerance 1e-13, times a factor of the motion.
TYPED_TEST(EveryPotential, Explicit8KeepsEverythingToItsTolerance) {
  for_each_body<TypeParam>([](const TypeParam& body, int end) {
    const mechanics::ExplicitMultiplier field(body);
    const auto change = largest_change(body, integrate_samples(field, benchmark_state<TypeParam>(), end, 20));
    EXPECT_LT(change.energy, 1e-11);
    expect_momenta_kept(body, change, 1e-11);
  });
}

template <class Body>
double distance_of_duals(const Body& body, double end) {
  const auto start = benchmark_state<Body>();
  const auto motion = run<mechanics::Rattle8>(body, start, end, 10, 20);
  const auto dual = run<mechanics::Rattle8>(body, transposed(start), end, 10, 20);
  EXPECT_TRUE(motion.finished() && dual.finished());
  double largest = 0;
  for (std::size_t k = 0; k < motion.states.size(); ++k)
    largest = std::max(largest, distance(transposed(motion.states[k]), dual.states[k]));
  return largest;
}

/// "Q(t) a solution ⇒ Q(t)ᵀ a solution" for every isotropic potential, gravity among them: the method transposes with
/// the motion, so that only round-off is between the two. A quadratic external potential is not isotropic.
TYPED_TEST(EveryPotential, TransposedMotionsAreMotions) {
  for_each_body<TypeParam>([](const TypeParam& body, int end) {
    if (body.energy_density().depends_on_direction()) {
      EXPECT_GT(distance_of_duals(body, std::min(end, 3)), 1e-3);
    } else {
      EXPECT_LT(distance_of_duals(body, std::min(end, 3)), 1e-12);
    }
  });
}

}  // namespace
}  // namespace pseudorigid::testing
