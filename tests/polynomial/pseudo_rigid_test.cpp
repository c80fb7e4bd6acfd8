/// A polynomial body of degree 1 is the pseudo-rigid body with its centre of mass, to round-off: forces, multipliers
/// and accounts of energy at random states, and whole motions with the same steps, for every law, every load and both
/// groups. Self-gravity of bodies on GL⁺(3) is not offered.

#include <gtest/gtest.h>

#include <limits>

#include "mechanics/core/constrained_system.h"
#include "polynomial/samples.h"
#include "reduced/dissipative_body.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid::testing {
namespace {

using reduced::ReferenceBody;

template <bool keeps_volume>
struct Group {
  static constexpr bool incompressible = keeps_volume;
  using Polynomial = std::conditional_t<keeps_volume, IncompressibleBody, CompressibleBody>;
  using PseudoRigid = reduced::DissipativeBody<reduced::PseudoRigidBody<reduced::Potential, keeps_volume>>;
};

/// The same body twice.
template <class GroupType>
struct Twins {
  typename GroupType::Polynomial polynomial;
  typename GroupType::PseudoRigid reduced;

  static Twins make(const materials::AnyLaw& law, const loads::Loads& loads, const Planes& planes,
                    const Vector3d& semi_axes = Vector3d::Ones()) {
    const loads::Loads felt = GroupType::incompressible ? loads::at_constant_volume(loads) : loads;
    const loads::Forcing forcing = loads::constant_forcing(felt);
    const ReferenceBody reference = ReferenceBody::ellipsoid(semi_axes);
    return {typename GroupType::Polynomial(
                BodySetup{.degree = 1, .reflect = planes, .semi_axes = semi_axes, .law = law, .loads = loads}),
            {{reduced::Potential(law, reference, forcing), reference}, reduced::Dissipation::of(forcing), felt}};
  }
};

/// det A = 1 and tr(A⁻¹Ȧ) = 0 on SL(3).
struct AffineState {
  Matrix3d A, velocity;
};
template <class GroupType>
AffineState random_state(const Planes& planes, double size, std::mt19937& generator) {
  AffineState s;
  s.A = Matrix3d::Identity() + size * admitted(planes, random_matrix(generator));
  Matrix3d L = size * admitted(planes, random_matrix(generator));
  if (GroupType::incompressible) {
    s.A /= std::cbrt(s.A.determinant());
    L -= L.trace() / 3 * Matrix3d::Identity();
  }
  s.velocity = s.A * L;
  return s;
}
/// [Q | rest]
Eigen::Matrix<double, 3, 4> extended(const Matrix3d& Q) {
  Eigen::Matrix<double, 3, 4> q = Eigen::Matrix<double, 3, 4>::Zero();
  q.leftCols<3>() = Q;
  return q;
}

template <class GroupType>
class DegreeOne : public ::testing::Test {
 protected:
  static constexpr double time = 0.7;

  /// Calls visitor(law, loads, planes) for every law and load.
  template <class Visitor>
  static void for_each_law_and_load(const Planes& planes, Visitor&& visitor) {
    std::vector<NamedLoads> cases = single_loads(GroupType::incompressible, planes);
    cases.push_back(rising_loads(planes));
    for (const auto& named : materials::law_table)
      for (const auto& [name, loads] : cases) {
        SCOPED_TRACE(std::string(named.name) + ", " + name);
        visitor(named, loads);
      }
  }

  static void compare_forces(const Twins<GroupType>& twins, const loads::Loads& loads, const AffineState& s,
                             const Vector3d& c, const Vector3d& c_rate) {
    const auto& [polynomial, reduced] = twins;
    const auto& space = polynomial.space();
    auto workspace = polynomial.make_workspace();
    VectorXd f = polynomial.make_vector();
    ASSERT_TRUE(polynomial.force(time, polynomial.affine(s.A, c), polynomial.affine(s.velocity, c_rate), workspace, f));
    typename GroupType::PseudoRigid::Workspace reduced_workspace{};
    Eigen::Matrix<double, 3, 4> a;
    ASSERT_TRUE(reduced.force(time, extended(s.A), extended(s.velocity), reduced_workspace, a));
    reduced.apply_inverse_mass(a, a);
    loads::Forcing forcing = loads::constant_forcing(loads), rate = loads::driving_rate(loads, time);
    Matrix3d expected = a.leftCols<3>();
    if (forcing.gravity_constant != 0) {  // the gauge of its energy, V_g (det A)^{1/3}, is a pressure
      const double V = reduced.body().potential_energies(s.A).gravitational;
      expected -= V / 3 * s.A.inverse().transpose() * space.inertia().cwiseInverse().asDiagonal();
    }
    // Stresses of a few times μ + λ cancel in part, and are multiplied by Vol/m̄ = 5.
    EXPECT_LT((space.affine_part(f) - expected).norm(), 1e-13 * (1 + expected.norm()));

    forcing += loads::driving(loads, time);
    const Vector3d of_center = forcing.acceleration - forcing.quadratic * c - forcing.drag * c_rate;
    EXPECT_LT((space.mean(f) - of_center).norm(), 2e-15);
    if (f.size() == space.n_unknowns()) return;
    const double taken = a(0, 3) + space.volume() * forcing.drag * c_rate.squaredNorm();
    const double given = a(1, 3) + space.volume() * (c.dot(rate.quadratic * c) / 2 - rate.acceleration.dot(c));
    EXPECT_NEAR(f[space.n_unknowns()], taken, 2e-14 * (1 + taken));
    EXPECT_NEAR(f[space.n_unknowns() + 1], given, 2e-15);
  }

  static void compare_multipliers(const Twins<GroupType>& twins, const AffineState& s) {
    const auto& [polynomial, reduced] = twins;
    State<typename GroupType::Polynomial> p{time, polynomial.affine(s.A), polynomial.affine(s.velocity)};
    State<typename GroupType::PseudoRigid> r{time, extended(s.A), extended(s.velocity)};
    auto of_p = polynomial.make_workspace();
    auto of_r = reduced.make_workspace();
    auto lambda = polynomial.make_multiplier();
    auto Lambda = reduced.make_multiplier();
    ASSERT_TRUE(mechanics::multiplier_of_motion(polynomial, p, of_p, lambda));
    ASSERT_TRUE(mechanics::multiplier_of_motion(reduced, r, of_r, Lambda));
    if constexpr (GroupType::incompressible) {
      const double expected = Lambda / reduced.body().m_bar();
      // A sum of stresses, times Vol/m̄ = 5, over a Gram matrix: some hundred units in the last place of 1.
      EXPECT_NEAR(polynomial.mean_multiplier(p.q, lambda), expected, 6e-14 * (1 + std::abs(expected)));
    }
  }

  using Polynomial = typename GroupType::Polynomial;
  using PseudoRigid = typename GroupType::PseudoRigid;
  static constexpr double end = 200;  // a period is 2π/√10 r/c (PHYSICS section 3)
  static constexpr long n_samples = 10, n_steps = 200;

  static RecordedRun<Polynomial> motion(const Polynomial& body, const AffineState& s) {
    return run<mechanics::Rattle>(body, {0, body.affine(s.A), body.affine(s.velocity)}, end, n_samples, n_steps);
  }
  static RecordedRun<PseudoRigid> motion(const PseudoRigid& body, const AffineState& s) {
    return run<mechanics::Rattle>(body, {0, extended(s.A), extended(s.velocity)}, end, n_samples, n_steps);
  }
  /// The greatest difference of Q at the samples that both have.
  template <class A, class B, class OfA, class OfB>
  static double difference(const RecordedRun<A>& a, const RecordedRun<B>& b, const OfA& Q_of_a, const OfB& Q_of_b) {
    double largest = 0;
    for (std::size_t k = 0; k < std::min(a.states.size(), b.states.size()); ++k)
      largest = std::max(largest, (Q_of_a(a.states[k].q) - Q_of_b(b.states[k].q)).cwiseAbs().maxCoeff());
    return largest;
  }

  /// The sum of the weights and the constants of the basis have relative errors of a few units in the last place, ε,
  /// which are the same in every step: each turns the phase of the slowest pulsation by √10 ε · end = 1.4e-13. Five are
  /// admitted. Round-off of a force that is not the same in every step, 2e-15, adds up to 2e-15 √(h end) = 1e-14 in the
  /// velocity; what that makes of Q depends on the motion, and is measured by a change of the first velocity.
  static void compare_motions(const Twins<GroupType>& twins, const AffineState& s, const Matrix3d& direction) {
    const auto of_twin = [&](const VectorXd& q) { return twins.polynomial.space().affine_part(q); };
    const auto of_reduced = [](const auto& q) { return Matrix3d(q.template leftCols<3>()); };
    const auto p = motion(twins.polynomial, s);
    const auto r = motion(twins.reduced, s);
    EXPECT_EQ(p.result.outcome, r.result.outcome);
    ASSERT_EQ(p.states.size(), r.states.size()) << "laws that are unstable fail at the same time";
    constexpr double change = 1e-10;
    const auto changed = motion(twins.reduced, {s.A, s.velocity + change * s.A * direction});
    const double sensitivity = difference(changed, r, of_reduced, of_reduced) / change;
    const double d = difference(p, r, of_twin, of_reduced);
    const double of_phase = 5 * std::sqrt(10.0) * end * std::numeric_limits<double>::epsilon();
    EXPECT_LT(d, std::max(of_phase, 1e-14 * sensitivity));
  }
};
using Groups = ::testing::Types<Group<true>, Group<false>>;
TYPED_TEST_SUITE(DegreeOne, Groups);

TYPED_TEST(DegreeOne, HasTheForceOfThePseudoRigidBodyForEveryLawAndLoad) {
  std::mt19937 generator(1);
  for (const Planes& planes : {no_planes, Planes{false, true, false}, all_planes})
    this->for_each_law_and_load(planes, [&](const auto& named, const loads::Loads& loads) {
      const auto twins =
          Twins<TypeParam>::make(generic(named, TypeParam::incompressible), loads, planes, {1.2, 0.9, 1});
      for (int i = 0; i < 5; ++i) {
        Vector3d c = random_matrix(generator).col(0), c_rate = random_matrix(generator).col(0);
        for (int k = 0; k < 3; ++k)
          if (planes[k]) c[k] = c_rate[k] = 0;
        this->compare_forces(twins, loads, random_state<TypeParam>(planes, 0.3, generator), c, c_rate);
      }
    });
}

TYPED_TEST(DegreeOne, HasTheMultiplierOfThePseudoRigidBody) {
  std::mt19937 generator(2);
  for (const Planes& planes : {no_planes, all_planes})
    this->for_each_law_and_load(planes, [&](const auto& named, const loads::Loads& loads) {
      const auto twins =
          Twins<TypeParam>::make(generic(named, TypeParam::incompressible), loads, planes, {1.2, 0.9, 1});
      this->compare_multipliers(twins, random_state<TypeParam>(planes, 0.3, generator));
    });
}

TYPED_TEST(DegreeOne, MovesAsThePseudoRigidBodyOverAHundredPeriods) {
  std::mt19937 generator(3);
  const auto compare = [&](const Planes& planes, const materials::NamedLaw& named, const loads::Loads& loads) {
    // A fluid runs away but for its gravity.
    if (named.name == "none" && loads::constant_forcing(loads).gravity_constant == 0) return;
    const auto twins = Twins<TypeParam>::make(generic(named, TypeParam::incompressible), loads, planes);
    const auto s = random_state<TypeParam>(planes, 0.1, generator);
    const auto other = random_state<TypeParam>(planes, 1, generator);
    this->compare_motions(twins, s, other.A.inverse() * other.velocity);
  };
  this->for_each_law_and_load(no_planes,
                              [&](const auto& named, const loads::Loads& loads) { compare(no_planes, named, loads); });
  for (const auto& [name, loads] : single_loads(TypeParam::incompressible, all_planes))
    compare(all_planes, materials::law_table[0], loads);
}

}  // namespace
}  // namespace pseudorigid::testing
