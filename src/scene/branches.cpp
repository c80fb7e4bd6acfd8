#include "scene/branches.h"

#include <fmt/format.h>

#include "scene/scene.h"

namespace pseudorigid::scene {

std::optional<Refusal> refuses_branches(const Scene& scene) {
  const auto& load = scene.loads.get<loads::Viscoelasticity>();
  const std::size_t n = load.moduli.size(), most = loads::Viscoelasticity::most_branches;
  if (n > most) return Refusal{"Material/Branch moduli", fmt::format("expected at most {} branches, got {}", most, n)};
  if (load.times.size() != n)
    return Refusal{"Material/Branch times", fmt::format("expected a time for each of Material/Branch moduli, got {} "
                                                        "for {}",
                                                        load.times.size(), n)};
  if (load.relaxed && n == 0)
    return Refusal{"Material/Branches relaxed", "the scene has no branches; give Material/Branch moduli"};
  return {};
}

}  // namespace pseudorigid::scene
