#include "mechanics/equilibria/mode_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pseudorigid::mechanics {
namespace {

double signed_root(double square) { return std::copysign(std::sqrt(std::abs(square)), square); }

ModeGroup group_of(const std::vector<ClassifiedMode>& modes, std::vector<std::size_t> copies, int overtone) {
  const auto omega = [&](std::size_t mode) { return signed_root(modes[mode].omega_squared); };
  const ClassifiedMode& first = modes[copies.front()];
  ModeGroup group{first.spheroidal, first.degree, overtone, {}, 0, omega(copies.front()), omega(copies.back())};
  for (const std::size_t mode : copies) group.omega += omega(mode) / static_cast<double>(copies.size());
  group.modes = std::move(copies);
  return group;
}

}  // namespace

std::vector<ModeGroup> group_modes(const std::vector<ClassifiedMode>& modes) {
  std::map<std::pair<bool, int>, std::vector<std::size_t>> classes;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    auto& members = classes[{modes[i].spheroidal, modes[i].degree}];
    members.insert(members.end(), static_cast<std::size_t>(modes[i].n_copies), i);
  }
  std::vector<ModeGroup> groups;
  for (auto& [key, members] : classes) {
    std::ranges::stable_sort(members, {}, [&](std::size_t mode) { return modes[mode].omega_squared; });
    const std::size_t n_copies = 2 * static_cast<std::size_t>(key.second) + 1;
    for (std::size_t first = 0; first < members.size(); first += n_copies) {
      const std::size_t last = std::min(first + n_copies, members.size());
      groups.push_back(group_of(
          modes,
          {members.begin() + static_cast<std::ptrdiff_t>(first), members.begin() + static_cast<std::ptrdiff_t>(last)},
          static_cast<int>(first / n_copies)));
    }
  }
  std::ranges::stable_sort(groups, {}, &ModeGroup::least);
  return groups;
}

}  // namespace pseudorigid::mechanics
