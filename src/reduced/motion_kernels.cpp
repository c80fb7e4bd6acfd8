#include "reduced/motion_kernels.h"

#include <algorithm>
#include <concepts>
#include <span>

#include "reduced/eight_bodies.h"
#include "reduced/gauss_body_kernels.h"

namespace pseudorigid::reduced {
namespace {

using mechanics::Status;

/// True for a multistep method, whose struct has the member `formula`.
template <class Method>
concept Multistep = requires {
  Method::formula;
};

/// Hooks for the time loop: they store q and v at the samples, and set n_steps steps between two samples.
struct KeepSamples {
  MotionsInLanes& motions;
  long n_steps;

  template <class W>
  Status sample(long, const mechanics::State<EightBodies>& state, const W&) {
    keep(state.q, motions.q);
    keep(state.v, motions.v);
    return {};
  }
  template <class W>
  long steps_per_interval(long, const mechanics::State<EightBodies>&, const W&) const {
    return n_steps;
  }
  template <class W>
  bool step_done(mechanics::Cursor, const mechanics::State<EightBodies>&, const W&) const {
    return true;
  }

  static void keep(const EightMatrices& x, std::vector<MatricesInLanes>& samples) {
    std::copy_n(x.data(), EightMatrices::size(), samples.emplace_back().data());
  }
};

EightMatrices matrices(const MatricesInLanes& values) {
  EightMatrices x;
  std::ranges::copy(values, x.data());
  return x;
}

bool can_move_eight(mechanics::MethodId method) {
  return mechanics::with_method(method, []<class Method>(Method) { return Multistep<Method>; });
}

MotionsInLanes move_eight(const materials::AnyLaw& law, const InertiaInLanes& inertia, const MatricesInLanes& q,
                          const MatricesInLanes& v, mechanics::MethodId method, const mechanics::SampleTimes& times,
                          long n_steps) {
  MotionsInLanes motions;
  mechanics::with_method(method, [&]<class Method>(Method) {
    if constexpr (Multistep<Method>) {
      const EightBodies bodies(law, inertia);
      typename Method::template Workspace<EightBodies> workspace(bodies);
      mechanics::State<EightBodies> state{0, matrices(q), matrices(v)};
      mechanics::Cursor cursor;
      KeepSamples hooks{motions, n_steps};
      motions.q.reserve(static_cast<std::size_t>(times.n_samples + 1));
      motions.v.reserve(static_cast<std::size_t>(times.n_samples + 1));
      auto result = mechanics::run_time_loop<Method>(bodies, times, state, cursor, workspace, hooks);
      motions.failure = std::move(result.reason);
      motions.t = result.t;
      motions.counters = workspace.counters;
    }
  });
  return motions;
}

}  // namespace
}  // namespace pseudorigid::reduced

extern const pseudorigid::reduced::MotionKernels PSEUDORIGID_KERNEL_TABLE{
    .moves = pseudorigid::reduced::can_move_eight,
    .motions = pseudorigid::reduced::move_eight,
    .solve_stages = pseudorigid::reduced::solve_stages_in_lanes};
