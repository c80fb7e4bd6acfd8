/// Sums of stored energy, self-gravity and a quadratic external potential (Oliva 5.7.8–5.7.9) on general reference
/// bodies: values, derivatives, the multiplier, and the same body described from two reference shapes.

#include "reduced/potential.h"

#include <gtest/gtest.h>

#include "mechanics/core/explicit_multiplier.h"
#include "reduced/carlson_gravity.h"
#include "reduced/potentials.h"
#include "reduced/samples.h"
#include "support/differences.h"
#include "support/integrate.h"

namespace pseudorigid::testing {
namespace {

using reduced::Potential;
using reduced::ReferenceBody;

/// A ball, an ellipsoid, and a body with its inertia along no coordinate axis.
std::vector<ReferenceBody> reference_bodies() {
  return {ReferenceBody::unit_ball(), ReferenceBody::ellipsoid({1.4, 0.9, 0.7}),
          ReferenceBody::of_inertia(triaxial_inertia().E0, 4.5)};
}
/// Every law with all loads on every reference body.
template <class Check>
void for_each_potential(const Check& check) {
  for (const auto& reference : reference_bodies())
    for (const auto& [name, law] : laws(false)) {
      SCOPED_TRACE(name);
      check(Potential(law, reference,
                      {.gravity_constant = strong_gravity,
                       .quadratic = generic_quadratic(),
                       .nominal_traction = generic_traction(),
                       .pressure = 0.35}));
    }
}

/// Order 8 with h = 0.005: 1e-15 |V|/h = 1e-12 of round-off; semi-axes down to ½ make truncation as small.
TEST(Potential, GradientIsTheDerivativeOfTheEnergy) {
  std::mt19937 generator(1);
  for_each_potential([&](const Potential& V) {
    const Matrix3d Q = random_deformation(generator), H = random_matrix(generator), gradient = V.gradient(Q);
    const double h = 0.005, by_difference = first_difference([&](int k) { return V.energy(Q + k * h * H); }, h);
    EXPECT_NEAR(by_difference, mechanics::dot(gradient, H), 1e-10 * (1 + gradient.norm()));
  });
}

TEST(Potential, SecondDerivativeIsTheDerivativeOfTheGradient) {
  std::mt19937 generator(2);
  for_each_potential([&](const Potential& V) {
    const Matrix3d Q = random_deformation(generator), H = random_matrix(generator), D = V.second_derivative(Q, H);
    const double h = 0.005;
    const Matrix3d by_difference = first_difference([&](int k) { return V.gradient(Q + k * h * H); }, h);
    EXPECT_LT((by_difference - D).norm(), 1e-10 * (1 + D.norm()));
  });
}

TEST(Potential, SecondDerivativeIsSymmetric) {
  std::mt19937 generator(3);
  for_each_potential([&](const Potential& V) {
    const Matrix3d Q = random_deformation(generator), H = random_matrix(generator), K = random_matrix(generator);
    const Matrix3d DH = V.second_derivative(Q, H), DK = V.second_derivative(Q, K);
    EXPECT_NEAR(mechanics::dot(DH, K), mechanics::dot(DK, H), 1e-13 * (DH.norm() + DK.norm()) * 3);
  });
}

/// A dead traction P̄N pulls a body of any law to rest where P(Q) = P̄; it does the work Vol P̄:Q, on the ball
/// (4/3)πr³ P̄:Q, and is no part of the material's own stress.
TEST(Potential, DeadTractionIsAConstantStress) {
  const Matrix3d traction = generic_traction();
  std::mt19937 generator(9);
  for (const auto& reference : reference_bodies()) {
    const Potential V(Law{1, 3}, reference, {.nominal_traction = traction}), free(Law{1, 3}, reference);
    const Matrix3d Q = random_deformation(generator);
    EXPECT_NEAR(V.energies(Q).external, -reference.volume * mechanics::dot(traction, Q), 1e-13);
    EXPECT_LT((V.gradient(Q) - free.gradient(Q) + reference.volume * traction).norm(), 1e-12);
    EXPECT_EQ(V.material_stress(Q), free.material_stress(Q));
    EXPECT_TRUE(V.depends_on_direction() && !free.depends_on_direction());
  }
}

/// The body's force is −∂V/∂Q, and V per volume and its stress are what a body asks of a law.
TEST(Potential, ForceOfTheBodyIsMinusTheGradient) {
  std::mt19937 generator(4);
  for (const auto& reference : reference_bodies()) {
    const auto body = loaded_body<LoadedGl3>(Law{1, 3}, {strong_gravity, generic_quadratic(), reference});
    const Matrix3d Q = random_deformation(generator), gradient = body.energy_density().gradient(Q);
    LoadedGl3::Workspace w;
    Matrix3d f = body.make_vector();
    ASSERT_TRUE(body.force(0, Q, Matrix3d::Zero(), w, f));
    EXPECT_LT((f + gradient).norm(), 1e-15 * gradient.norm());
    EXPECT_NEAR(body.potential_energy(Q), reference.volume * body.energy_density().energy(materials::to_tensor(Q)),
                1e-14 * std::abs(body.potential_energy(Q)));
  }
}

TEST(Potential, IsTheSumOfItsPartsAndAPartNotNamedIsZero) {
  std::mt19937 generator(5);
  for (const auto& reference : reference_bodies()) {
    const Matrix3d Q = random_deformation(generator), T = generic_quadratic();
    const auto all = Potential(Law{1, 3}, reference, {.gravity_constant = strong_gravity, .quadratic = T}).energies(Q);
    const auto elastic = Potential(Law{1, 3}, reference).energies(Q);
    const auto gravity = Potential(materials::Fluid{}, reference, {.gravity_constant = strong_gravity}).energies(Q);
    const auto external = Potential(materials::Fluid{}, reference, {.quadratic = T}).energies(Q);
    EXPECT_EQ(all.elastic, elastic.elastic);
    EXPECT_EQ(all.gravitational, gravity.gravitational);
    EXPECT_EQ(all.external, external.external);
    for (const double part : {all.elastic, -all.gravitational, std::abs(all.external)}) EXPECT_GT(part, 1e-3);
    for (const double part : {elastic.gravitational, elastic.external, gravity.elastic, gravity.external,
                              external.elastic, external.gravitational})
      EXPECT_EQ(part, 0);
    EXPECT_DOUBLE_EQ(all.total(), all.elastic + all.gravitational + all.external);
    EXPECT_TRUE(
        Potential(Law{1, 3}, reference, {.gravity_constant = strong_gravity, .quadratic = T}).depends_on_direction());
    EXPECT_FALSE(Potential(Law{1, 3}, reference, {.gravity_constant = strong_gravity}).depends_on_direction());
  }
}

/// V = −(3/5)GM²/R of a sphere of radius R: a ball of that radius, and the unit ball and an ellipsoid made into one.
TEST(Potential, GravityOfASphere) {
  const double R = 1.7, volume = 4 * std::numbers::pi / 3;
  const auto energy = [](const ReferenceBody& reference, const Matrix3d& Q) {
    return Potential(materials::Fluid{}, reference, {.gravity_constant = strong_gravity}).energies(Q).gravitational;
  };
  const Matrix3d turn = rotation_z(0.3);
  const double of_ball = -0.6 * strong_gravity * std::pow(volume * R * R * R, 2) / R;
  EXPECT_NEAR(energy(ReferenceBody::ellipsoid({R, R, R}), turn), of_ball, 1e-14 * -of_ball);
  const double of_unit_mass = -0.6 * strong_gravity * volume * volume / R;
  EXPECT_NEAR(energy(ReferenceBody::unit_ball(), R * turn), of_unit_mass, 1e-14 * -of_unit_mass);
  const Vector3d a(2, 1, 0.25);
  const double of_ellipsoid = -0.6 * strong_gravity * std::pow(volume * a.prod(), 2) / R;
  const Matrix3d to_sphere = turn * Matrix3d((R * a.cwiseInverse()).asDiagonal());
  EXPECT_NEAR(energy(ReferenceBody::ellipsoid(a), to_sphere), of_ellipsoid, 1e-14 * -of_ellipsoid);
}

/// A reference ellipsoid SB has the gravity of the ellipsoid QSB: value and gradient by Carlson's integrals of another
/// library, ∂/∂Q = ∂/∂F Sᵀ.
TEST(Potential, GravityOfAReferenceEllipsoid) {
  std::mt19937 generator(6);
  for (const auto& reference : reference_bodies()) {
    const Matrix3d Q = random_deformation(generator), F = Q * reference.shape;
    const double factor = 0.6 * reference.mass * reference.mass / (4 * std::numbers::pi);  // k/(4πG)
    const Potential V(materials::Fluid{}, reference, {.gravity_constant = strong_gravity});
    const double energy = factor * self_gravity(F, strong_gravity);
    const Matrix3d gradient = factor * self_gravity_gradient(F, strong_gravity) * reference.shape.transpose();
    EXPECT_NEAR(V.energies(Q).gravitational, energy, 1e-14 * std::abs(energy));
    EXPECT_LT((V.gradient(Q) - gradient).norm(), 1e-13 * gradient.norm());
    EXPECT_LT((reference.shape * reference.shape.transpose() * reference.mass / 5 - reference.E0).norm(), 1e-14);
  }
}

/// ½∫ρ xᵀTx dV over the body x = QSY, Y in the unit ball.
TEST(Potential, QuadraticPotentialIsTheIntegralOverTheBody) {
  std::mt19937 generator(7);
  const auto reference = ReferenceBody::ellipsoid({1.4, 0.9, 0.7});
  const Matrix3d Q = random_deformation(generator), F = Q * reference.shape, T = generic_quadratic();
  const double integral = reference.shape.determinant() *
                          integral_over_ball(1, [&](const Vector3d& Y) { return 0.5 * (F * Y).dot(T * F * Y); });
  EXPECT_NEAR(Potential(Law{1, 3}, reference, {.quadratic = T}).energies(Q).external, integral, 1e-14);
}

/// PHYSICS section 0: λ = [tr((Q⁻¹Q̇)²) + tr(Q⁻¹∂V E₀⁻¹)]/tr(Q⁻¹Q⁻ᵀE₀⁻¹) with physical V, and Q̈E₀ = −∂V + λQ⁻ᵀ.
TEST(Potential, MultiplierOfAGeneralReferenceBody) {
  std::mt19937 generator(8);
  for (const auto& reference : reference_bodies()) {
    const auto body = elastic_sl3({strong_gravity, generic_quadratic(), reference});
    const auto s = random_unimodular_state(generator);
    const Matrix3d Q_inverse = s.q.inverse(), L = Q_inverse * s.v, E0_inverse = reference.E0.inverse();
    const Matrix3d dV = body.energy_density().gradient(s.q);
    const double lambda = ((L * L).trace() + (Q_inverse * dV * E0_inverse).trace()) /
                          (Q_inverse * Q_inverse.transpose() * E0_inverse).trace();
    EXPECT_NEAR(observed(body, s).multiplier * body.m_bar(), lambda, 1e-12 * (1 + std::abs(lambda)));
    EXPECT_NEAR(observed(body, s).central_pressure, 2.5 * lambda / reference.volume, 1e-12 * (1 + std::abs(lambda)));
    LoadedSl3::Workspace w;
    Matrix3d a = body.make_vector();
    ASSERT_TRUE(body.acceleration(0, s.q, s.v, w, a));
    const Matrix3d right_side = lambda * Q_inverse.transpose() - dV;
    EXPECT_LT((a * reference.E0 - right_side).norm(), 1e-12 * (1 + right_side.norm()));
  }
}

/// "Z is conserved only if E₀ ∝ Id", with gravity too: turns of the reference body are no symmetry of another E₀.
TEST(Potential, GravityKeepsCirculationOnlyWhereInertiaIsIsotropic) {
  for (const bool ball : {true, false}) {
    const auto body = elastic_sl3({strong_gravity, Matrix3d::Zero(), reference_bodies()[ball ? 0 : 1]});
    const auto states = integrate_samples(mechanics::ExplicitMultiplier(body), benchmark_state<LoadedSl3>(), 5, 20);
    const auto before = observed(body, states.front()), after = observed(body, states.back());
    EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), 1e-12) << "seen 1e-13, tolerance 1e-13";
    const double change = (after.circulation - before.circulation).norm();
    if (ball) {
      EXPECT_LT(change, 1e-12);
    } else {
      EXPECT_GT(change, 1e-2);
    }
  }
}

/// A fluid has no reference shape: the body SB at Q is the ball at QS (det S = 1), with the same motion x, energies,
/// angular momentum and pressure, under gravity and a tide.
TEST(Potential, AFluidDoesNotKnowItsReferenceShape) {
  const Vector3d a(1.3, 0.9, 1 / (1.3 * 0.9));
  const Matrix3d S = a.asDiagonal();
  const auto body = fluid_sl3({strong_gravity, generic_quadratic(), ReferenceBody::ellipsoid(a)});
  const auto ball = fluid_sl3({strong_gravity, generic_quadratic()});
  const auto start = benchmark_state<LoadedSl3>();
  const auto states = integrate_samples(mechanics::ExplicitMultiplier(body), start, 4, 20);
  const auto of_ball =
      integrate_samples(mechanics::ExplicitMultiplier(ball), moving<LoadedSl3>(start.q * S, start.v * S), 4, 20);
  ASSERT_EQ(states.size(), of_ball.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    EXPECT_LT((states[k].q * S - of_ball[k].q).norm(), 1e-10);
    const auto o = observed(body, states[k]), p = observed(ball, of_ball[k]);
    EXPECT_NEAR(o.energy(), p.energy(), 1e-10);
    EXPECT_LT((o.angular_momentum - p.angular_momentum).norm(), 1e-10);
    EXPECT_LT((o.semi_axes - p.semi_axes).norm(), 1e-10);
    EXPECT_NEAR(o.central_pressure, p.central_pressure, 1e-9);
  }
  EXPECT_GT((states.back().q - start.q).norm(), 0.5);
}

}  // namespace
}  // namespace pseudorigid::testing
