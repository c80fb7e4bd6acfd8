#pragma once
/// The one-parameter groups that leave a loaded rigid body's energies unchanged (Noether):
///
///   translations of space    no spring, across the weight
///   turns of space           about an axis that fixes the weight and every anchor
///   turns of the body        about an axis that fixes E₀, the centre of mass (if it has weight) and every point of
///                            attachment

#include <Eigen/Dense>
#include <limits>

#include "systems/body_loads.h"
#include "systems/invariant_axes.h"

namespace pseudorigid::systems {

struct BodySymmetries {
  Directions translations, turns_of_space, turns_of_body;
};

/// Axes of the turns that leave E₀ and the given vectors of K unchanged; E₀ with three different eigenvalues has none.
inline Directions turns_that_fix(const Eigen::Matrix3d& E0, Directions vectors) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(E0);
  const Eigen::Vector3d& e = solver.eigenvalues();
  const double round_off = 64 * std::numeric_limits<double>::epsilon() * e(2);
  const bool lower_two_agree = e(1) - e(0) <= round_off, upper_two_agree = e(2) - e(1) <= round_off;
  if (!lower_two_agree && !upper_two_agree) return {};
  if (!(lower_two_agree && upper_two_agree)) vectors.push_back(solver.eigenvectors().col(lower_two_agree ? 2 : 0));
  return turns_that_fix(vectors);
}

inline BodySymmetries body_symmetries(const Eigen::Matrix3d& E0, const BodyLoads& loads, bool has_fixed_point) {
  Directions in_space{loads.gravity}, in_body;
  if (!loads.gravity.isZero(0)) in_body.push_back(loads.center);
  for (const BodySpring& spring : loads.springs) {
    in_space.push_back(spring.anchor);
    in_body.push_back(spring.xi);
  }
  BodySymmetries symmetries{{}, turns_that_fix(in_space), turns_that_fix(E0, in_body)};
  if (!has_fixed_point && loads.springs.empty()) symmetries.translations = translations_across(loads.gravity);
  return symmetries;
}

}  // namespace pseudorigid::systems
