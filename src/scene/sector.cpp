#include "scene/sector.h"

namespace pseudorigid::scene {
namespace {

constexpr const char* excluded = "motions that would break the symmetry are excluded";

std::string planes_in_words(const std::array<bool, 3>& reflect) {
  std::string names;
  for (std::size_t i = 0; i < 3; ++i)
    if (reflect[i]) names += std::string(names.empty() ? "" : ", ") + axis_names[i];
  return names;
}

}  // namespace

std::string Sector::name() const {
  switch (n_planes()) {
    case 3:
      return "octant";
    case 2:
      return "quarter (planes " + planes_in_words(reflect) + ")";
    case 1:
      return "half (plane " + planes_in_words(reflect) + ")";
    default:
      return "full ball";
  }
}

std::array<bool, 3> planes_of(Symmetry symmetry) {
  switch (symmetry) {
    case Symmetry::automatic:
    case Symmetry::none:
      return {false, false, false};
    case Symmetry::x:
      return {true, false, false};
    case Symmetry::y:
      return {false, true, false};
    case Symmetry::z:
      return {false, false, true};
    case Symmetry::xy:
      return {true, true, false};
    case Symmetry::xz:
      return {true, false, true};
    case Symmetry::yz:
      return {false, true, true};
    case Symmetry::octant:
      return {true, true, true};
  }
  return {};
}

std::optional<BrokenPlane> breaks_plane(const Scene::InitialState& state, int i) {
  for (const bool in_velocity : {false, true}) {
    const Matrix3& matrix = in_velocity ? state.velocity : state.deformation;
    for (int j = 0; j < 3; ++j) {
      if (j == i) continue;
      if (matrix[i][j] != 0) return BrokenPlane{i, j, in_velocity};
      if (matrix[j][i] != 0) return BrokenPlane{j, i, in_velocity};
    }
  }
  return std::nullopt;
}

Sector sector(const Scene& scene) {
  Sector sector;
  const bool automatic = scene.continuum.symmetry == Symmetry::automatic;
  if (automatic) {
    for (int i = 0; i < 3; ++i) sector.reflect[i] = !breaks_plane(scene.initial_state, i);
  } else {
    sector.reflect = planes_of(scene.continuum.symmetry);
  }
  if (sector.n_planes() == 0) {
    sector.reason =
        automatic ? "the initial state admits no symmetry plane" : "Continuum/Symmetry asks for the full ball";
  } else {
    sector.reason = automatic ? "the smallest sector that the initial state admits" : "as Continuum/Symmetry asks";
    sector.reason += std::string("; ") + excluded;
  }
  return sector;
}

}  // namespace pseudorigid::scene
