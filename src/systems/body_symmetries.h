#pragma once
/// The one-parameter groups that leave a loaded rigid body's energies unchanged (Noether):
///
///   translations of space    no spring, across the weight
///   turns of space           about an axis that fixes the weight and every anchor
///
/// Turns of the body, R ↦ RO, are not among them: they map the rotations, g = 0, to rotations, but change the functions
/// g.

#include "systems/body_loads.h"
#include "systems/invariant_axes.h"

namespace pseudorigid::systems {

struct BodySymmetries {
  Directions translations, turns_of_space;
};

inline BodySymmetries body_symmetries(const BodyLoads& loads, bool has_fixed_point) {
  Directions in_space{loads.gravity};
  for (const BodySpring& spring : loads.springs) in_space.push_back(spring.anchor);
  BodySymmetries symmetries{{}, turns_that_fix(in_space)};
  if (!has_fixed_point && loads.springs.empty()) symmetries.translations = translations_across(loads.gravity);
  return symmetries;
}

}  // namespace pseudorigid::systems
