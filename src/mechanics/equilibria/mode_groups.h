#pragma once
/// Groups of modes of a ball at rest with the same frequency. In a sphere a mode of one kind and degree n occurs 2n + 1
/// times. The 2n + 1 lowest modes of one kind and degree are the copies of the fundamental. The next 2n + 1 modes are
/// the copies of its first overtone, and so on. The caller measures kind and degree of each mode. The group of a mode
/// depends only on kind, degree and the order of ω², without a threshold.

#include <cstddef>
#include <vector>

namespace pseudorigid::mechanics {

struct ClassifiedMode {
  double omega_squared;
  bool spheroidal;  ///< false: toroidal
  int degree;
  int n_copies = 1;  ///< number of modes with the same frequency that this one represents
};

/// One frequency with the copies that have been found, perhaps not all. The sign of ω is the sign of ω²: −ω > 0 is a
/// growth rate.
struct ModeGroup {
  bool spheroidal;
  int degree, overtone;            ///< overtone 0: the fundamental
  std::vector<std::size_t> modes;  ///< indices of the copies in the list, by increasing ω²
  double omega;                    ///< mean of the copies
  double least, largest;           ///< least and largest ω of the copies

  bool complete() const { return modes.size() == 2 * static_cast<std::size_t>(degree) + 1; }
};

/// The groups of the modes, in the order of their lowest copies.
std::vector<ModeGroup> group_modes(const std::vector<ClassifiedMode>& modes);

}  // namespace pseudorigid::mechanics
