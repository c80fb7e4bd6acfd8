#include "reduced/steady_curve.h"

#include "mechanics/core/dense_algebra.h"

namespace pseudorigid::reduced {

NullDirections null_directions(const PlaneMatrix& DF) {
  const auto [U, values, V] = mechanics::singular_value_decomposition(DF.topRows<7>());
  return {V.col(7), V.col(6), values[6] / values[0]};
}

}  // namespace pseudorigid::reduced
