/// Declared orders on the finite-element ball, full state (every node), by the suite that the small systems pass.

#include "support/order_test.h"

#include "continuum/balls.h"
#include "mechanics/core/field_of.h"

namespace pseudorigid::testing {

/// An octant that pulsates at finite amplitude.
template <int degree>
struct BallFactory {
  using System = ElasticBall;
  ElasticBall ball{octant, degree, 0, neo_hookean};
  const System& system() const { return ball; }
  State<ElasticBall> initial() const {
    return affine_state(ball, diagonal(1.1, 1, 1 / 1.1), diagonal(0.11, 0, -0.1 / 1.1));
  }
  double end() const { return 1; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {80, 160, 320, 640};
    return {113, 160, 226, 320};
  }
  long n_reference_steps() const { return 400; }
};

/// Those of higher order cost minutes here.
struct TakesTheBall {
  template <class Method>
  static constexpr bool has = mechanics::takes_any_vector<Method> && !Method::adaptive && Method::order <= 4;
};
using CasesOfDegree2 = OrderCases<BallFactory<2>, TakesTheBall>;
using CasesOfDegree3 = OrderCases<BallFactory<3>, TakesTheBall>;
INSTANTIATE_TYPED_TEST_SUITE_P(BallOfDegree2, MethodOrder, CasesOfDegree2);
INSTANTIATE_TYPED_TEST_SUITE_P(BallOfDegree3, MethodOrder, CasesOfDegree3);

}  // namespace pseudorigid::testing
