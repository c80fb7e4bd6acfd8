// Eight bodies in lanes move as each of them does alone, with the same method and step.

#include "reduced/motions_in_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "materials/law_table.h"
#include "mechanics/core/field_of.h"
#include "reduced/potential.h"
#include "reduced/pseudo_rigid_body.h"

namespace pseudorigid {
namespace {

using Body = reduced::PseudoRigidBody<reduced::Potential, true>;
using State = mechanics::State<Body>;
constexpr int n = reduced::n_body_lanes;

struct Samples {
  std::vector<State>& states;
  long n_steps;

  template <class W>
  mechanics::Status sample(long, const State& state, const W&) {
    states.push_back(state);
    return {};
  }
  template <class W>
  long steps_per_interval(long, const State&, const W&) const {
    return n_steps;
  }
  template <class W>
  bool step_done(mechanics::Cursor, const State&, const W&) const {
    return true;
  }
};

/// Eight bodies of one law: balls, or ellipsoids of other axes each, that turn and stretch differently.
struct Eight {
  materials::AnyLaw law;
  std::vector<reduced::ReferenceBody> references;
  std::vector<State> states;
  reduced::InertiaInLanes inertia{};
  reduced::MatricesInLanes q{}, v{};

  Eight(const materials::AnyLaw& law, bool balls, double stretch = 1.3) : law(law) {
    Eigen::Matrix3d L;  // traceless
    L << 0.2, -0.8, 0.1, 0.6, -0.3, 0.2, 0, -0.1, 0.1;
    for (int i = 0; i < n; ++i) {
      references.push_back(balls ? reduced::ReferenceBody::unit_ball()
                                 : reduced::ReferenceBody::ellipsoid({1 + 0.05 * i, 1, 0.9 - 0.03 * i}));
      const double a = stretch - 0.04 * i;
      const Eigen::Matrix3d Q = Eigen::Vector3d(a, 1, 1 / a).asDiagonal();
      states.push_back({0, Q, (1 - 0.1 * i) * Q * L});
      inertia.volume[i] = references[i].volume;
      store(i, references[i].E0.inverse(), inertia.E0_inverse);
      store(i, states[i].q, q);
      store(i, states[i].v, v);
    }
    inertia.isotropic = balls;
  }

  static void store(int body, const Eigen::Matrix3d& A, reduced::MatricesInLanes& values) {
    for (int i = 0; i < 9; ++i) values[i * n + body] = A(i / 3, i % 3);
  }
  static Eigen::Matrix3d matrix(int body, const reduced::MatricesInLanes& values) {
    Eigen::Matrix3d A;
    for (int i = 0; i < 9; ++i) A(i / 3, i % 3) = values[i * n + body];
    return A;
  }

  reduced::MotionsInLanes move(mechanics::MethodId method, const mechanics::SampleTimes& times, long n_steps) const {
    return reduced::motions_in_lanes(law, inertia, q, v, method, times, n_steps);
  }

  std::vector<State> move_alone(int i, mechanics::MethodId method, const mechanics::SampleTimes& times,
                                long n_steps) const {
    std::vector<State> samples;
    const Body body(reduced::Potential(law, references[i], {}), references[i]);
    mechanics::with_method(method, [&]<class Method>(Method) {
      if constexpr (!Method::adaptive && mechanics::method_fits<Method, Body>()) {
        State state = states[i];
        typename Method::template Workspace<Body> workspace(body);
        mechanics::Cursor cursor;
        Samples hooks{samples, n_steps};
        const auto result = mechanics::run_time_loop<Method>(body, times, state, cursor, workspace, hooks);
        EXPECT_EQ(result.reason, "");
      }
    });
    return samples;
  }
};

/// Round-off of the constraint makes one of the multipliers, which the multistep methods carry on with weights of up to
/// 5 for order 8 and 62 for order 12 (symmetric_multistep.h). Measured over the cases below: 3e-14 at most, and 1.8e-12
/// for order 12.
double round_off_of(mechanics::MethodId method) {
  return method == mechanics::id_of<mechanics::Symmetric12> ? 2e-11 : 3e-13;
}

void expect_twins(const Eight& eight, mechanics::MethodId method) {
  const mechanics::SampleTimes times{20, 20};
  constexpr long n_steps = 40;
  const auto together = eight.move(method, times, n_steps);
  ASSERT_EQ(together.failure, "");
  ASSERT_EQ(together.q.size(), 21u);
  for (int i = 0; i < n; ++i) {
    const auto alone = eight.move_alone(i, method, times, n_steps);
    ASSERT_EQ(alone.size(), together.q.size());
    for (std::size_t k = 0; k < alone.size(); ++k) {
      EXPECT_LT((Eight::matrix(i, together.q[k]) - alone[k].q).cwiseAbs().maxCoeff(), round_off_of(method)) << i;
      EXPECT_LT((Eight::matrix(i, together.v[k]) - alone[k].v).cwiseAbs().maxCoeff(), round_off_of(method)) << i;
      // Round-off of det Q goes with |Q|³, and a free fluid stretches without end. Measured: a third of this.
      EXPECT_NEAR(Eight::matrix(i, together.q[k]).determinant(), 1, 4e-16 * std::pow(alone[k].q.norm(), 3));
    }
  }
}

std::vector<mechanics::MethodId> methods_in_lanes() {
  std::vector<mechanics::MethodId> ids;
  mechanics::for_each_method([&]<class Method>(Method) {
    if (reduced::moves_in_lanes(mechanics::id_of<Method>)) ids.push_back(mechanics::id_of<Method>);
  });
  return ids;
}

TEST(MotionsInLanes, AreThoseOfEachBodyAlone) {
  ASSERT_FALSE(methods_in_lanes().empty());
  for (const auto method : methods_in_lanes())
    for (const bool balls : {true, false}) {
      SCOPED_TRACE(std::string(mechanics::method_name(method)) + (balls ? ", balls" : ", ellipsoids"));
      expect_twins(Eight(materials::CiarletGeymonat{1, 0}, balls), method);
    }
}

TEST(MotionsInLanes, OfEveryLaw) {
  for (const materials::NamedLaw& law : materials::law_table) {
    SCOPED_TRACE(law.name);
    expect_twins(Eight(law.make({}), true, 1.2), mechanics::id_of<mechanics::Symmetric8>);
  }
}

TEST(MotionsInLanes, EndForAllWhereOneCannotGoOn) {
  Eight eight(materials::CiarletGeymonat{1, 0}, true);
  Eigen::Matrix3d inside_out = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  Eight::store(5, inside_out, eight.q);
  const auto motions = eight.move(mechanics::id_of<mechanics::Symmetric8>, {1, 1}, 40);
  EXPECT_NE(motions.failure, "");
}

TEST(MotionsInLanes, EndForAllBeyondTheLimitOfTheLaw) {
  const materials::AnyLaw law = materials::make_law("gent", {.gent_limit = 0.05});
  Eight eight(law, true, 1.5);  // I − 3 = 0.7
  const auto motions = eight.move(mechanics::id_of<mechanics::Symmetric8>, {1, 1}, 40);
  EXPECT_NE(motions.failure.find("admits no such deformation"), std::string::npos) << motions.failure;
}

}  // namespace
}  // namespace pseudorigid
