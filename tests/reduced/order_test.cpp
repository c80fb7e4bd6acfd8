/// Declared orders on SL(3) and GL⁺(3), full state.

#include "support/order_test.h"

#include "reduced/bodies.h"
#include "support/method_lists.h"

namespace pseudorigid::testing {

/// The motion of benchmark_state over a little more than one period.
template <class Body>
struct BodyFactory {
  using System = Body;
  Body body{Law{1, std::is_same_v<Body, Sl3> ? 0.0 : 1.0}, reduced::ReferenceBody::unit_ball()};
  const System& system() const { return body; }
  State<Body> initial() const { return benchmark_state<Body>(); }
  double end() const { return 3; }
  std::vector<long> step_counts(int order) const {
    if (order == 2) return {200, 400, 800, 1600, 3200};
    if (order == 4) return {40, 57, 80, 113, 160, 226, 320};
    if (order == 6) return {34, 40, 48, 57, 67, 80, 95, 113};
    return {40, 44, 48, 52, 57, 62, 67};
  }
  long n_reference_steps() const { return 240; }
};

template <class Method>
using Sl3Case = OrderCase<BodyFactory<Sl3>, Method>;
template <class Method>
using Gl3Case = OrderCase<BodyFactory<Gl3>, Method>;
using Sl3Cases = CasesOf<Sl3Case, Symplectic>;
using Gl3Cases = CasesOf<Gl3Case, Symplectic>;
INSTANTIATE_TYPED_TEST_SUITE_P(Sl3, MethodOrder, Sl3Cases);
INSTANTIATE_TYPED_TEST_SUITE_P(Gl3, MethodOrder, Gl3Cases);

}  // namespace pseudorigid::testing
