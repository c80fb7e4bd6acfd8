/// Time of the self-gravity of an ellipsoid against Boost.Math, by Google Benchmark: the three integrals d_i of random
/// triaxial bodies, and energy, force and second derivative of such bodies in general position (axes and integrals
/// included). Each call waits for the one before, as in an integrator.

#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <boost/math/special_functions/ellint_rd.hpp>
#include <random>
#include <vector>

#include "gravity/ellipsoid_gravity.h"

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace pseudorigid::gravity;

constexpr size_t n_bodies = 256;  // more than branch predictors learn by heart

/// log a_i normal with deviation ½
std::vector<Vector3d> semi_axes() {
  std::mt19937 generator(1);
  std::normal_distribution<double> exponent(0, 0.5);
  std::vector<Vector3d> list(n_bodies);
  for (auto& a : list) a = Vector3d::NullaryExpr([&] { return std::exp(exponent(generator)); });
  return list;
}

std::vector<Matrix3d> bodies() {
  std::mt19937 generator(2);
  std::normal_distribution<double> number;
  const auto rotation = [&] {
    return Eigen::Quaterniond(Eigen::Vector4d::NullaryExpr([&] { return number(generator); })).normalized();
  };
  std::vector<Matrix3d> list;
  for (const auto& a : semi_axes()) list.push_back(rotation() * Matrix3d(a.asDiagonal()) * rotation());
  return list;
}

/// Calls f of one sample after the other, the next made to depend on the result of the last by 10⁻³⁰ of it.
template <class Sample, class Function>
void in_turn(benchmark::State& loop, const std::vector<Sample>& samples, const Function& f) {
  double last = 0;
  size_t i = 0;
  for (auto _ : loop) {
    Sample sample = samples[i++ % n_bodies];
    sample(0) += 1e-30 * last;
    last = f(sample);
    benchmark::DoNotOptimize(last);
  }
}

template <class Policy>
double boost_integrals(const Vector3d& a, const Policy& policy) {
  using boost::math::ellint_rd;
  const Vector3d x = a.cwiseAbs2();
  return ellint_rd(x[1], x[2], x[0], policy) + ellint_rd(x[2], x[0], x[1], policy) +
         ellint_rd(x[0], x[1], x[2], policy);
}

const EllipsoidGravity ellipsoid{1};

void boost_as_it_is(benchmark::State& loop) {
  in_turn(loop, semi_axes(), [](const Vector3d& a) { return boost_integrals(a, boost::math::policies::policy<>()); });
}
void boost_without_long_double(benchmark::State& loop) {
  using namespace boost::math::policies;
  in_turn(loop, semi_axes(), [](const Vector3d& a) { return boost_integrals(a, policy<promote_double<false>>()); });
}
void integrals(benchmark::State& loop) {
  in_turn(loop, semi_axes(), [](const Vector3d& a) { return ellipsoid_integrals<false>(a).d.sum(); });
}
void axes(benchmark::State& loop) {
  in_turn(loop, bodies(), [](const Matrix3d& F) { return pseudorigid::mechanics::principal_axes(F).a.sum(); });
}
void energy(benchmark::State& loop) {
  in_turn(loop, bodies(), [](const Matrix3d& F) { return ellipsoid.energy(F); });
}
void force(benchmark::State& loop) {
  in_turn(loop, bodies(), [](const Matrix3d& F) { return ellipsoid.gradient(F).sum(); });
}
void force_of_a_diagonal_body(benchmark::State& loop) {
  in_turn(loop, semi_axes(), [](const Vector3d& a) { return ellipsoid.gradient(a.asDiagonal()).sum(); });
}
void second_derivative(benchmark::State& loop) {
  const Matrix3d H = bodies().front();
  in_turn(loop, bodies(), [&](const Matrix3d& F) { return ellipsoid.second_derivative(F, H).sum(); });
}

BENCHMARK(boost_as_it_is)->Name("3 R_D by boost::math::ellint_rd");
BENCHMARK(boost_without_long_double)->Name("3 R_D by boost::math::ellint_rd, promote_double<false>");
BENCHMARK(integrals)->Name("3 R_D together");
BENCHMARK(axes)->Name("principal axes");
BENCHMARK(energy)->Name("energy, whole");
BENCHMARK(force)->Name("force, whole");
BENCHMARK(force_of_a_diagonal_body)->Name("force of a diagonal body");
BENCHMARK(second_derivative)->Name("second derivative, whole");

}  // namespace

BENCHMARK_MAIN();
