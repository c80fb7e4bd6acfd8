#include "scene/sector.h"

#include <fmt/format.h>

#include <type_traits>
#include <utility>
#include <vector>

#include "entries/about.h"
#include "entries/entry_kinds.h"

namespace pseudorigid::scene {
namespace {

constexpr const char* excluded = "motions that would break the symmetry are excluded";

std::string planes_in_words(const std::array<bool, 3>& reflect) {
  std::string names;
  for (std::size_t i = 0; i < 3; ++i)
    if (reflect[i]) names += std::string(names.empty() ? "" : ", ") + axis_names[i];
  return names;
}

/// True if a load has a function `breaks_plane`, which replaces the check of the entries of the load.
template <class Load>
inline constexpr bool judges_planes = requires(const Load& load) {
  load.breaks_plane(0);
};

/// The paths and values of all entries of type Value in the loads without a function `breaks_plane`.
template <class Value>
std::vector<std::pair<std::string_view, const Value*>> of_loads(const Scene& scene) {
  std::vector<std::pair<std::string_view, const Value*>> found;
  const auto note = [&](const auto& member, const auto&, const About& about) {
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, Value>) found.emplace_back(about.path, &member);
  };
  scene.loads.for_each([&]<class Load>(const Load& load) {
    if constexpr (!judges_planes<Load>) Load::visit_entries(load, note);
  });
  return found;
}

/// Describes the first entry of a matrix that breaks the symmetry about the plane with the normal e_i. The result is
/// empty if there is no such entry. The matrices are those of the initial state, the inertia and the loads, except
/// loads with a function `breaks_plane`. Vectors affect the centre of mass but not the deformation, and are not
/// checked.
std::optional<std::string> matrix_breaks_plane(const Scene& scene, int i) {
  std::vector<std::pair<std::string_view, const Matrix3*>> matrices{
      {"Initial state/Deformation", &scene.initial_state.deformation},
      {"Initial state/Velocity", &scene.initial_state.velocity},
      {"Body/Inertia", scene.body.inertia ? &*scene.body.inertia : nullptr}};
  const auto of_load = of_loads<Matrix3>(scene);
  matrices.insert(matrices.end(), of_load.begin(), of_load.end());
  for (const auto& [path, matrix] : matrices)
    for (int j = 0; matrix && j < 3; ++j)
      for (const auto& [row, column] : {std::pair{i, j}, std::pair{j, i}})
        if (const double entry = (*matrix)[row][column]; row != column && entry != 0)
          return fmt::format("entry ({},{}) of {} is {} and not 0", row + 1, column + 1, path, print_number(entry));
  return std::nullopt;
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

std::optional<std::string> breaks_plane(const Scene& scene, int i) {
  if (auto reason = matrix_breaks_plane(scene, i)) return reason;
  const auto& initial = scene.initial_state;
  std::vector<std::pair<std::string_view, const std::vector<double>*>> vectors{
      {"Initial state/Center", &initial.center}, {"Initial state/Center velocity", &initial.center_velocity}};
  const auto of_load = of_loads<std::vector<double>>(scene);
  vectors.insert(vectors.end(), of_load.begin(), of_load.end());
  for (const auto& [path, vector] : vectors)
    if (const double entry = (*vector)[i]; entry != 0)
      return fmt::format("entry {} of {} is {} and not 0", i + 1, path, print_number(entry));
  std::optional<std::string> reason;
  scene.loads.for_each([&]<class Load>(const Load& load) {
    if constexpr (judges_planes<Load>)
      if (!reason) reason = load.breaks_plane(i);
  });
  return reason;
}

bool keeps_diagonal(const Scene& scene) {
  for (int i = 0; i < 3; ++i)
    if (matrix_breaks_plane(scene, i)) return false;
  return true;
}

Sector sector(const Scene& scene) {
  Sector sector;
  if (has_mesh_file(scene)) {
    sector.reason = "a mesh from a file is the whole body";
    return sector;
  }
  const bool automatic = scene.continuum.symmetry == Symmetry::automatic;
  if (automatic) {
    // A small motion is found when the run starts. Before, its symmetry is not known.
    for (int i = 0; i < 3; ++i) sector.reflect[i] = scene.initial_state.mode == 0 && !breaks_plane(scene, i);
  } else {
    sector.reflect = planes_of(scene.continuum.symmetry);
  }
  if (sector.n_planes() == 0) {
    sector.reason =
        automatic ? "initial state and loads admit no symmetry plane" : "Continuum/Symmetry asks for the full ball";
  } else {
    sector.reason = automatic ? "the smallest sector that initial state and loads admit" : "as Continuum/Symmetry asks";
    sector.reason += std::string("; ") + excluded;
  }
  return sector;
}

}  // namespace pseudorigid::scene
