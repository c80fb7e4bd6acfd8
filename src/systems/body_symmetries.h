#pragma once
/// One-parameter groups of symmetries of a rigid body under loads. The groups do not change the kinetic and the
/// potential energy, and therefore give conserved momenta (Noether's theorem):
///
///   translations of space    perpendicular to the weight, if there are no springs and no fixed point
///   rotations of space       about an axis through the origin that is parallel to the weight and contains every
///                            anchor of a spring
///
/// Rotations of the body, R ↦ RO with a rotation O, are not included. With the constraints g of rigid_body.h, such
/// rotations map the set g = 0 to itself, but change the values of g outside this set.

#include "systems/body_loads.h"
#include "systems/invariant_axes.h"

namespace pseudorigid::systems {

/// Directions of the translations, and axes of the rotations of space, which pass through the origin of space.
struct BodySymmetries {
  Directions translations, turns_of_space;
};

/// The symmetries of a body under the loads. A body with a fixed point or with springs has no translations.
inline BodySymmetries body_symmetries(const BodyLoads& loads, bool has_fixed_point) {
  Directions in_space{loads.gravity};
  for (const BodySpring& spring : loads.springs) in_space.push_back(spring.anchor);
  BodySymmetries symmetries{{}, turns_that_fix(in_space)};
  if (!has_fixed_point && loads.springs.empty()) symmetries.translations = translations_across(loads.gravity);
  return symmetries;
}

}  // namespace pseudorigid::systems
