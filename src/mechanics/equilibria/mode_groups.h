#pragma once
/// Groups of vibration modes with the same frequency, for a ball at rest. In a ball, each frequency of one kind
/// (spheroidal or toroidal) and degree n has 2n + 1 modes, called copies. The 2n + 1 lowest modes of one kind and
/// degree are the copies of the fundamental. The next 2n + 1 modes are the copies of its first overtone, and so on. The
/// caller determines kind and degree of each mode. The modes of one kind and degree are grouped by the order of their
/// squared frequencies ω² alone. Differences of frequencies are not compared with a threshold.

#include <cstddef>
#include <vector>

namespace pseudorigid::mechanics {

struct ClassifiedMode {
  double omega_squared;
  bool spheroidal;  ///< true for a spheroidal mode, false for a toroidal mode
  int degree;
  int n_copies = 1;  ///< number of modes with this frequency that this entry stands for
};

/// A group: one frequency ω with its copies in the list of modes. The highest group of a kind and degree may have fewer
/// than 2n + 1 copies. ω has the sign of ω². A negative ω means growth at the rate −ω.
struct ModeGroup {
  bool spheroidal;
  int degree, overtone;            ///< degree n; overtone 0 is the fundamental
  std::vector<std::size_t> modes;  ///< indices in the list by increasing ω²; an entry with several copies is repeated
  double omega;                    ///< mean ω of the copies
  double least, largest;           ///< least and largest ω of the copies

  /// Returns true if all 2n + 1 copies are in the list.
  bool complete() const { return modes.size() == 2 * static_cast<std::size_t>(degree) + 1; }
};

/// Returns the groups of the modes in the list `modes`, ordered by the least ω of each group.
std::vector<ModeGroup> group_modes(const std::vector<ClassifiedMode>& modes);

}  // namespace pseudorigid::mechanics
