#include "mechanics/equilibria/morse_count.h"

#include <algorithm>
#include <cstddef>

namespace pseudorigid::mechanics {

bool obeys_morse(const std::vector<int>& indices, int dimension, std::span<const int> betti) {
  long r = 0;
  for (int k = 0; k <= dimension; ++k) {
    const auto place = static_cast<std::size_t>(k);
    r = std::ranges::count(indices, k) - (place < betti.size() ? betti[place] : 0) - r;
    if (r < 0) return false;
  }
  return r == 0;
}

}  // namespace pseudorigid::mechanics
