#pragma once
/// The system to which an entry belongs. A scene must not set entries of another system.

#include <string_view>

#include "scene/catalogue.h"
#include "scene/entries.h"
#include "scene/scene.h"

namespace pseudorigid::scene {

/// Returns "ball" or the name of another system. Returns "" for an entry that every system uses.
inline std::string_view owner_of(const Catalogue& catalogue, std::string_view path) {
  const std::string_view section = path.substr(0, path.find('/'));
  for (const SystemDescription& system : catalogue.systems)
    if (section == system.section) return system.name;
  for (const std::string_view of_ball :
       {"Models", "Body", "Material", "Gravity", "Loads", "Companions", "Initial state", "Equilibrium", "Modes",
        "Love numbers", "Polynomial", "Continuum"})
    if (section == of_ball) return ball;
  for (const std::string_view of_ball :
       {"Output/Quantities", "Output/Graphics", "Output/Frames", "Output/Fields", "Output/Cells"})
    if (path == of_ball) return ball;
  return "";
}

/// Returns true if the entry has an effect for the system of the scene.
inline bool concerns(const Scene& scene, std::string_view path) {
  const std::string_view owner = owner_of(catalogue_of(scene), path);
  return owner.empty() || owner == scene.system;
}

}  // namespace pseudorigid::scene
