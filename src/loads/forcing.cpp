#include "loads/forcing.h"

#include <Eigen/Geometry>

namespace pseudorigid::loads {
namespace {

/// A rotation about the coordinate axis by an angle that no finite group of rotations contains.
Eigen::Matrix3d turn_about(int axis) { return Eigen::AngleAxisd(1, Eigen::Vector3d::Unit(axis)).toRotationMatrix(); }
bool is_equal(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B) { return (A - B).norm() <= 1e-12 * B.norm(); }

}  // namespace

Forcing& Forcing::operator+=(const Forcing& other) {
  visit_pairs(*this, other, [](auto& mine, const auto& its) { mine += its; });
  return *this;
}

bool Forcing::acts_at_constant_volume() const {
  Forcing others = *this;
  others.pressure = 0;
  return others.present();
}

bool Forcing::present() const {
  bool any = false;
  const Forcing none;
  visit_pairs(*this, none, [&](const auto& mine, const auto& zero) { any = any || mine != zero; });
  return any;
}

double Forcing::potential(const Eigen::Matrix3d& second_moment, const Eigen::Vector3d& first_moment,
                          const Eigen::Matrix3d& F_integral, double volume) const {
  const double energy = 0.5 * quadratic.cwiseProduct(second_moment).sum() - acceleration.dot(first_moment) -
                        nominal_traction.cwiseProduct(F_integral).sum();
  return pressure == 0 ? energy : energy + pressure * volume;
}

bool permits_rotation_of_space(const Forcing& forcing, int axis) {
  const Eigen::Matrix3d R = turn_about(axis), &P = forcing.nominal_traction, &T = forcing.quadratic;
  return is_equal(R * P, P) && is_equal(R * T * R.transpose(), T);
}

bool permits_rotation_of_body(const Forcing& forcing, int axis) {
  return is_equal(forcing.nominal_traction * turn_about(axis), forcing.nominal_traction);
}

bool permits_joint_rotation(const Forcing& forcing, int axis) {
  const Eigen::Matrix3d R = turn_about(axis);
  const auto is_kept = [&](const Eigen::Matrix3d& A) { return is_equal(R * A * R.transpose(), A); };
  return is_kept(forcing.nominal_traction) && is_kept(forcing.quadratic);
}

FreeMotions free_motions(const Forcing& f, const std::array<bool, 3>& reflect) {
  FreeMotions free;
  if (!f.quadratic.isZero(0) || !f.acceleration.isZero(0) || !f.planes.empty() || !f.companions.empty()) return free;
  for (int i = 0; i < 3; ++i) {
    if (!reflect[i]) free.translations.push_back(i);
    if (f.nominal_traction.isZero(0) && !reflect[(i + 1) % 3] && !reflect[(i + 2) % 3]) free.turns.push_back(i);
  }
  return free;
}

Eigen::Matrix3d to_eigen(const scene::Matrix3& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(i, j) = m[i][j];
  return result;
}

}  // namespace pseudorigid::loads
