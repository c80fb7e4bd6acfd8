#include "app/run/orbit_of_run.h"

#include <Eigen/Dense>
#include <optional>
#include <utility>

#include "gravity/ellipsoid_gravity.h"
#include "mechanics/core/orbit.h"
#include "mechanics/core/status.h"

namespace pseudorigid::app {

Eigen::MatrixXd with_companions(const Eigen::Matrix3d& Q, const mechanics::Orbit& orbit,
                                const mechanics::Orbit::Columns& s) {
  Eigen::MatrixXd columns(3, 3 + orbit.n());
  const mechanics::Orbit::Columns at_start = orbit.relative(orbit.position());
  columns << Q, orbit.relative(s) * at_start.colwise().norm().cwiseInverse().asDiagonal();
  return columns;
}

double own_energy(const mechanics::Orbit& orbit, const Eigen::Matrix3d& S, const Eigen::Matrix3d& Q,
                  const Eigen::Matrix3d& Qdot) {
  const Eigen::Matrix3d L = Qdot * Q.inverse();
  const double M = orbit.body_mass();
  const Eigen::Matrix3d shape = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(5 / M * S).operatorSqrt();
  const gravity::EllipsoidGravity gravity{0.6 * orbit.gravity_constant() * M * M};
  return 0.5 * (L * S * L.transpose()).trace() + gravity.energy(shape);
}

}  // namespace pseudorigid::app
