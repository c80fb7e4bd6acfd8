#pragma once
/// The eight possible parities of a displacement u of the ball under the reflections R_j in the coordinate planes. A
/// parity consists of three signs s_j = ±1, with u(R_j X) = s_j R_j u(X) (parity_sector.h).

#include <array>
#include <string>

namespace pseudorigid::continuum {

struct Parity {
  std::array<int, 3> sign{1, 1, 1};

  /// True if this parity requires u_component = 0 on the plane x_plane = 0.
  bool holds(int component, int plane) const { return (component == plane) == (sign[plane] > 0); }
  /// The signs as text, for example "++-".
  std::string name() const {
    std::string name;
    for (const int s : sign) name += s > 0 ? '+' : '-';
    return name;
  }
};

/// The parity with sign[j] = −1 if bit j of `number` is set, and otherwise 1. Number 0 is the parity of motions for
/// which all three planes are planes of symmetry.
inline Parity parity_of_sector(int number) {
  Parity parity;
  for (int j = 0; j < 3; ++j) parity.sign[j] = number >> j & 1 ? -1 : 1;
  return parity;
}

}  // namespace pseudorigid::continuum
