#include "scene/stabilization.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

namespace pseudorigid::scene {
namespace {

/// The eigenvalues of the tidal matrix of the scene, in increasing order.
Eigen::Vector3d rates_of_confinement(const Scene& scene) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(loads::constant_forcing(scene.loads).quadratic,
                                                        Eigen::EigenvaluesOnly)
      .eigenvalues();
}

}  // namespace

bool is_confined(const Scene& scene) { return rates_of_confinement(scene)[0] > 0; }

double volumetric_stiffness(const Scene& scene) {
  if (!scene.body.incompressible) return 0;
  if (const auto& asked = scene.continuum.volumetric_stiffness) return *asked;
  const auto& [radius, density] = std::pair(scene.body.radius, scene.body.density);
  const double mass_by_length = density * radius * radius;
  const double gravity =
      2 * std::numbers::pi / 3 * loads::constant_forcing(scene.loads).gravity_constant * density * mass_by_length;
  const double confinement = is_confined(scene) ? mass_by_length * rates_of_confinement(scene)[2] / 2 : 0;
  return gravity + confinement;
}

}  // namespace pseudorigid::scene
