#include "continuum/body/companion_sums.h"

#include <array>

#include "continuum/parallel/ranks.h"

namespace pseudorigid::continuum {
namespace {

/// Calls use(m_n, y_n, entry) for each node n of this rank, with its mass m_n and its position y_n relative to
/// `center`. The argument `entry` is the local index of the first component of the node in vectors.
template <class Use>
void for_each_node(const BallSpace& space, const Vector& x, const Eigen::Vector3d& center, const Use& use) {
  for (unsigned int i = 0; i < 3 * space.n_nodes(); i += 3) {
    const Eigen::Vector3d y(x.local_element(i), x.local_element(i + 1), x.local_element(i + 2));
    use(space.mass().local_element(i), Eigen::Vector3d(y - center), i);
  }
}

/// The factors ±1 of the three coordinates in each mirror image of the sector. The first image is the sector itself.
std::vector<Eigen::Vector3d> signs_of_images(const Sector& sector) {
  std::vector<Eigen::Vector3d> signs{Eigen::Vector3d::Ones()};
  for (int c = 0; c < 3; ++c)
    for (std::size_t k = 0, n = signs.size(); sector.reflect[c] && k < n; ++k) {
      signs.push_back(signs[k]);
      signs.back()[c] = -1;
    }
  return signs;
}

/// The force Gm (r − y)/|r − y|³ of a companion at r on a node at y, per mass of the node. `Gm` is the gravitational
/// constant times the mass of the companion.
Eigen::Vector3d pull(double Gm, const Eigen::Vector3d& r, const Eigen::Vector3d& y) {
  const Eigen::Vector3d apart = r - y;
  const double square = apart.squaredNorm();
  return Gm / (square * std::sqrt(square)) * apart;
}

}  // namespace

CompanionSums companion_sums(const mechanics::Orbit& orbit, const BallSpace& space, const Vector& x,
                             const Eigen::Vector3d& center, const mechanics::Orbit::Columns& r) {
  const auto signs = signs_of_images(space.mesh().sector());
  std::array<double, 1 + 3 * (1 + mechanics::Orbit::most_companions)> sums{};
  double& energy = sums[0];
  Eigen::Map<Eigen::Vector3d> torque(&sums[1]);
  Eigen::Map<Eigen::Matrix3Xd> on_companions(&sums[4], 3, orbit.n());
  for_each_node(space, x, center, [&](double mass, const Eigen::Vector3d& y, unsigned int) {
    for (const Eigen::Vector3d& image : signs)
      for (int i = 0; i < orbit.n(); ++i) {
        const double Gm = orbit.gravity_constant() * orbit.mass(i);
        const Eigen::Vector3d at = image.cwiseProduct(y), force = mass * pull(Gm, r.col(i), at);
        energy -= Gm * mass / (r.col(i) - at).norm();
        on_companions.col(i) -= force;
        torque += at.cross(force);
      }
  });
  sums = sum_over_ranks(sums, space.communicator());
  return {energy, on_companions, torque};
}

void add_companion_forces(const mechanics::Orbit& orbit, const BallSpace& space, const Vector& x,
                          const Eigen::Vector3d& center, const mechanics::Orbit::Columns& r, const CompanionSums& sums,
                          double mass, Vector& f) {
  const Eigen::Vector3d of_frame = sums.on_companions.rowwise().sum() / mass;
  for_each_node(space, x, center, [&](double of_node, const Eigen::Vector3d& y, unsigned int entry) {
    Eigen::Vector3d acceleration = of_frame;
    for (int i = 0; i < orbit.n(); ++i) acceleration += pull(orbit.gravity_constant() * orbit.mass(i), r.col(i), y);
    for (int c = 0; c < 3; ++c) f.local_element(entry + c) += of_node * acceleration[c];
  });
}

}  // namespace pseudorigid::continuum
