#pragma once
/// The eight parities of a displacement of the ball under the reflections of its coordinate planes, u(R_j X) =
/// s_j R_j u(X) with s_j = ±1 (parity_sector.h).

#include <array>
#include <string>

namespace pseudorigid::continuum {

struct Parity {
  std::array<int, 3> sign{1, 1, 1};

  /// Whether a component is 0 on the plane x_j = 0.
  bool holds(int component, int plane) const { return (component == plane) == (sign[plane] > 0); }
  /// "++-"
  std::string name() const {
    std::string name;
    for (const int s : sign) name += s > 0 ? '+' : '-';
    return name;
  }
};

/// Bits of the number are the negative signs: 0 is the symmetric motion.
inline Parity parity_of_sector(int number) {
  Parity parity;
  for (int j = 0; j < 3; ++j) parity.sign[j] = number >> j & 1 ? -1 : 1;
  return parity;
}

}  // namespace pseudorigid::continuum
