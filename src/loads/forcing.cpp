#include "loads/forcing.h"

namespace pseudorigid::loads {

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

Eigen::Matrix3d to_eigen(const scene::Matrix3& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(i, j) = m[i][j];
  return result;
}

}  // namespace pseudorigid::loads
