#pragma once
/// Modes of a ball at rest, put together to frequencies. A mode of one kind and degree n of the sphere comes 2n + 1
/// times: the 2n + 1 lowest of a class are the copies of its fundamental, the next those of its first overtone, and so
/// on. Kind and degree of each mode are measured by the caller; the group of a mode is decided by them and by the
/// order of ω² alone, without a threshold.

#include <cstddef>
#include <vector>

namespace pseudorigid::mechanics {

struct ClassifiedMode {
  double omega_squared;
  bool spheroidal;  ///< otherwise toroidal
  int degree;
  int n_copies = 1;  ///< modes of the same frequency for which this one stands
};

/// One frequency with its copies, perhaps not with all of them. Roots of ω² have its sign: −ω is a rate of growth.
struct ModeGroup {
  bool spheroidal;
  int degree, overtone;            ///< overtone 0: the fundamental
  std::vector<std::size_t> modes;  ///< places of the copies in the list, by rising ω²
  double omega;                    ///< mean of the copies
  double least, largest;           ///< of the copies

  bool complete() const { return modes.size() == 2 * static_cast<std::size_t>(degree) + 1; }
};

/// By their lowest copies.
std::vector<ModeGroup> group_modes(const std::vector<ClassifiedMode>& modes);

}  // namespace pseudorigid::mechanics
