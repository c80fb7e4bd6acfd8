/// Times of single calls by Google Benchmark: right-hand sides and substeps. Right-hand sides are timed as throughput
/// (independent calls) and as latency (each call waits for the one before, as in an integrator).

#include <benchmark/benchmark.h>

#include "mechanics/methods/composition.h"
#include "mechanics/methods/dormand_prince_8.h"
#include "mechanics/methods/symmetric_multistep.h"
#include "problems.h"

namespace {

using namespace pseudorigid;
using namespace pseudorigid::benchmarks;

Sl3 body_with(const Eigen::Vector3d& inertia) {
  auto reference = reduced::ReferenceBody::unit_ball();
  reference.E0 = (reference.E0 * inertia.asDiagonal()).eval();
  return {{1, 0}, reference};
}

template <class System>
void throughput(benchmark::State& loop, const System& system, const State<System>& s) {
  auto w = system.make_workspace();
  auto a = system.make_vector();
  for (auto _ : loop) {
    benchmark::DoNotOptimize(system.acceleration(0, s.q, s.v, w, a).ok());
    benchmark::DoNotOptimize(a);
    benchmark::ClobberMemory();
  }
}

/// q ← q₀ + 10⁻³⁰ a: the next call needs the result, and the state stays what it is. Holds the cost of that sum.
template <class System>
void latency(benchmark::State& loop, const System& system, const State<System>& s) {
  auto w = system.make_workspace();
  auto a = system.make_vector();
  auto q = s.q;
  for (auto _ : loop) {
    benchmark::DoNotOptimize(system.acceleration(0, q, s.v, w, a).ok());
    q = s.q + 1e-30 * a;
    benchmark::DoNotOptimize(q);
  }
}

template <class System>
void force(benchmark::State& loop, const System& system, const State<System>& s) {
  auto w = system.make_workspace();
  auto f = system.make_vector();
  for (auto _ : loop) {
    benchmark::DoNotOptimize(system.force(0, s.q, s.v, w, f).ok());
    benchmark::DoNotOptimize(f);
    benchmark::ClobberMemory();
  }
}

/// Steps of size h along the motion; counts substeps (one force each).
template <class Method, class System>
void substep(benchmark::State& loop, const System& system, State<System> s, double h = 0.05) {
  typename Method::template Workspace<System> w(system);
  for (auto _ : loop)
    if (!Method::advance(system, h, s, w)) return loop.SkipWithError("the motion ended");
  loop.counters["per_substep"] = benchmark::Counter(static_cast<double>(w.counters.n_substeps),
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  loop.counters["iterations_per_substep"] =
      static_cast<double>(w.counters.n_position_iterations) / static_cast<double>(w.counters.n_substeps);
}

template <class Field>
void adaptive_step(benchmark::State& loop, const Field& field, const State<Field>& start) {
  mechanics::DormandPrince8Workspace<Field> w(field, 1e-12);
  State<Field> s = start;
  for (auto _ : loop)
    if (!mechanics::DormandPrince8::step(field, 1e9, s, w)) return loop.SkipWithError("the motion ended");
  loop.counters["per_evaluation"] = benchmark::Counter(static_cast<double>(w.counters.n_force),
                                                       benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

}  // namespace

int main(int argc, char** argv) {
  const auto form = sl3_form();
  const Sl3 body = form.system, general = body_with({1.2, 1, 0.8});
  const mechanics::ExplicitMultiplier field(body);
  const auto state = form.initial;
  const auto top = euler_form();
  const auto pendulum = pendulum_form();
  const mechanics::ExplicitMultiplier pendulum_field(pendulum.system);
  const auto angles = lagrange_form();
  using benchmark::RegisterBenchmark;
  RegisterBenchmark("sl3/right_hand_side/throughput", [&](auto& l) { throughput(l, body, state); });
  RegisterBenchmark("sl3/right_hand_side/latency", [&](auto& l) { latency(l, body, state); });
  RegisterBenchmark("sl3_general_inertia/right_hand_side/throughput", [&](auto& l) { throughput(l, general, state); });
  RegisterBenchmark("sl3_general_inertia/right_hand_side/latency", [&](auto& l) { latency(l, general, state); });
  RegisterBenchmark("sl3/force", [&](auto& l) { force(l, body, state); });
  RegisterBenchmark("euler_top/right_hand_side/throughput", [&](auto& l) { throughput(l, top.system, top.initial); });
  RegisterBenchmark("double_pendulum/right_hand_side/throughput",
                    [&](auto& l) { throughput(l, pendulum_field, pendulum.initial); });
  RegisterBenchmark("double_pendulum_angles/right_hand_side/throughput",
                    [&](auto& l) { throughput(l, angles.system, angles.initial); });
  RegisterBenchmark("sl3/rattle", [&](auto& l) { substep<mechanics::Rattle>(l, body, state); });
  RegisterBenchmark("sl3/rattle-8", [&](auto& l) { substep<mechanics::Rattle8>(l, body, state); });
  RegisterBenchmark("sl3/symmetric-8", [&](auto& l) { substep<mechanics::Symmetric8>(l, body, state, 0.015); });
  RegisterBenchmark("sl3/symmetric-12", [&](auto& l) { substep<mechanics::Symmetric12>(l, body, state, 0.015); });
  RegisterBenchmark("double_pendulum/rattle-8",
                    [&](auto& l) { substep<mechanics::Rattle8>(l, pendulum.system, pendulum.initial); });
  RegisterBenchmark("sl3/explicit-8", [&](auto& l) { adaptive_step(l, field, state); });
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
