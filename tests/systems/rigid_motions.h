#pragma once
/// Bodies, states and motions that the tests of the statements of Oliva 5.6 share.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <utility>
#include <vector>

#include "mechanics/methods/methods.h"
#include "support/dense.h"
#include "support/runs.h"
#include "systems/conservative_checks.h"
#include "systems/mass_distribution.h"
#include "systems/sample_systems.h"

namespace pseudorigid::testing {

using Eigen::Matrix3d, Eigen::Vector3d;
using mechanics::axial_vector, mechanics::cross_matrix, mechanics::State;
using systems::FixedPointBody, systems::FreeBody, systems::MassDistribution, systems::WeightedPoint;

inline const Vector3d some_X(0.4, -1.3, 0.7), some_Y(1.1, 0.2, -0.6), some_Omega(0.6, -0.9, 1.1);

inline FreeBody loaded_free_body() { return FreeBody({tilted_E0(), generic_loads_about_the_center()}); }
inline State<FreeBody> free_start() {
  return systems::turning(generic_rotation(), some_Omega, {0.3, 0.1, -0.2}, {0.5, -0.4, 0.2});
}
/// A state in the middle of the motion of a loaded free body, by RATTLE of order 8.
inline State<FreeBody> state_on_the_way() {
  const auto r = run<mechanics::Rattle8>(loaded_free_body(), free_start(), 3, 1, 60);
  EXPECT_TRUE(r.finished()) << r.result.reason;
  return r.last();
}
inline Vector3d axial_of_skew(const Matrix3d& W) { return -0.5 * axial_vector(W); }

/// A body of mass points without symmetry.
inline std::vector<WeightedPoint> body_points() {
  return {{{0.3, -0.2, 0.9}, 1.2}, {{-0.7, 0.5, 0.1}, 0.8}, {{0.4, 1.0, -0.6}, 1.5}, {{-0.2, -0.9, -0.4}, 0.7}};
}

/// Smallest singular value of the differential of (K, p) : T SO(3) → R⁴ at a state with the angular velocity Ω, by
/// differences in the six directions of T T SO(3) (turns of R with Ω held, and changes of Ω).
inline double smallest_singular_value(const FixedPointBody& body, const Vector3d& Omega) {
  Eigen::Matrix<double, 4, 6> D;
  for (int i = 0; i < 6; ++i)
    D.col(i) = derivative([&, Omega](double t) -> Eigen::Vector4d {
      const Vector3d e = Vector3d::Unit(i % 3);
      const Matrix3d turn = Eigen::AngleAxisd(i < 3 ? t : 0, e).toRotationMatrix();
      const auto s = systems::turning(generic_rotation() * turn, i < 3 ? Omega : Vector3d(Omega + t * e));
      Eigen::Vector4d K_p;
      K_p << body.kinetic_energy(s.v), body.angular_momentum(s.q, s.v);
      return K_p;
    });
  return singular_values(D)(3);
}

}  // namespace pseudorigid::testing
