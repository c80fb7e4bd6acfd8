#include "mechanics/core/kepler_motion.h"

#include <cmath>

namespace pseudorigid::mechanics {

KeplerIncrements kepler_increments(double k, const Eigen::Vector3d& s, const Eigen::Vector3d& sdot, double h) {
  constexpr int most_iterations = 200;
  const double r = s.norm(), eta = s.dot(sdot), beta = 2 * k / r - sdot.squaredNorm();
  double X = h / r, low = -HUGE_VAL, high = HUGE_VAL;
  UniversalFunctions G(beta, X);
  double end = r;  // the distance r(X) at the end
  for (int i = 0; i < most_iterations; ++i) {
    G = UniversalFunctions(beta, X);
    end = r + eta * G.G1 + (k - beta * r) * G.G2;
    const double residual = r * G.G1 + eta * G.G2 + k * G.G3 - h;
    (residual < 0 ? low : high) = X;
    double next = X - residual / end;
    if (!(std::abs(next - X) > 4e-16 * std::abs(X))) break;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    X = next;
  }
  return {-(k * G.G2 / r) * s + (h - k * G.G3) * sdot, -(k * G.G1 / (r * end)) * s - (k * G.G2 / end) * sdot};
}

}  // namespace pseudorigid::mechanics
