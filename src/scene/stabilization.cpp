#include "scene/stabilization.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <variant>

#include "materials/rest_moduli.h"
#include "mechanics/core/dense_algebra.h"
#include "scene/scales.h"

namespace pseudorigid::scene {
namespace {

/// The eigenvalues of the tidal matrix of the scene in 1/time², in increasing order. A rising load counts with its full
/// value.
Eigen::Vector3d rates_of_confinement(const Scene& scene) {
  return mechanics::symmetric_spectrum(loads::full_forcing(scene.loads).quadratic).values;
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

double violence_of_start(const Scene& scene) {
  if (is_fluid(scene)) return 0;
  const auto& [radius, density] = std::pair(scene.body.radius, scene.body.density);
  const materials::AnyLaw law = law_of(scene);
  const double mu = materials::moduli_at_rest(law, scene.body.incompressible).shear;
  const Scene::InitialState& start = scene.initial_state;
  const bool disturbs = starts_from_own_figure(scene) && start.origin;
  const Eigen::Matrix3d Q = loads::to_eigen(disturbs ? start.origin->deformation : start.deformation),
                        L = loads::to_eigen(disturbs ? start.origin->velocity : start.velocity) * Q.inverse(),
                        DQ = 0.5 * (L + L.transpose()) * Q;
  const auto energy = [&](const Eigen::Matrix3d& F) {
    materials::Tensor<double> f;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) f(i, j) = F(i, j);
    return std::visit([&](const auto& known) { return known.energy(f); }, law);
  };
  return (energy(Q) - energy(Eigen::Matrix3d::Identity())) / mu +
         density * radius * radius * DQ.squaredNorm() / (10 * mu);
}

bool starts_violently(const Scene& scene) {
  constexpr double violent = 0.06;
  return violence_of_start(scene) > violent;
}

double volumetric_stiffness_of_elements(const Scene& scene) {
  constexpr double of_shear_modulus = 3;
  const double kappa = volumetric_stiffness(scene);
  const bool chooses =
      scene.body.incompressible && !scene.continuum.volumetric_stiffness && scene.analysis == Analysis::motion;
  if (!chooses || !starts_violently(scene)) return kappa;
  const auto law = law_of(scene);
  return kappa + of_shear_modulus * materials::moduli_at_rest(law, true).shear;
}

}  // namespace pseudorigid::scene
