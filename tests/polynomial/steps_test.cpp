/// Steps of small polynomial bodies allocate nothing, and bodies in several threads do not disturb one another.

#include <gtest/gtest.h>

#include <thread>

#include "polynomial/allocations.h"
#include "polynomial/motions.h"

namespace pseudorigid::testing {
namespace {

using mechanics::Rattle;

/// The first steps reserve what the others use.
TEST(Steps, OfDegreeThreeAllocateNothing) {
  if (!allocations_are_counted) GTEST_SKIP() << "a sanitizer has a malloc of its own";
  for (const Planes& planes : {all_planes, no_planes}) {
    const auto body = elastic_body<IncompressibleBody>(planes);
    auto state = pulsating(body);
    Rattle::Workspace<IncompressibleBody> workspace(body);
    for (int k = 0; k < 10; ++k) ASSERT_TRUE(Rattle::advance(body, 0.02, state, workspace));
    const long before = n_allocations, factorizations = workspace.system.gram.n_factorizations();
    for (int k = 0; k < 50; ++k) ASSERT_TRUE(Rattle::advance(body, 0.02, state, workspace));
    EXPECT_EQ(n_allocations, before);
    EXPECT_GT(workspace.system.gram.n_factorizations(), factorizations) << "a factorisation is among them";
  }
}

TEST(Steps, OfCompressibleBodiesAllocateNothing) {
  if (!allocations_are_counted) GTEST_SKIP() << "a sanitizer has a malloc of its own";
  const auto body = elastic_body<CompressibleBody>(no_planes);
  auto state = pulsating(body);
  Rattle::Workspace<CompressibleBody> workspace(body);
  for (int k = 0; k < 5; ++k) ASSERT_TRUE(Rattle::advance(body, 0.02, state, workspace));
  const long before = n_allocations;
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(Rattle::advance(body, 0.02, state, workspace));
  EXPECT_EQ(n_allocations, before);
}

/// The counter sees those of the library and those of Eigen.
TEST(Steps, AllocationsAreSeen) {
  if (!allocations_are_counted) GTEST_SKIP() << "a sanitizer has a malloc of its own";
  const long before = n_allocations;
  ::operator delete(::operator new(100));
  EXPECT_EQ(n_allocations, before + 1);
  const VectorXd vector = VectorXd::Constant(static_cast<Eigen::Index>(before), 1.0);
  EXPECT_EQ(n_allocations, before + 2) << vector.sum();
}

/// Threads share a body, and have scratch arrays of their own.
TEST(Threads, FindTheSameNumbers) {
  const auto body = elastic_body<IncompressibleBody>(all_planes, 5);
  constexpr int n_threads = 4;
  std::vector<VectorXd> ends(n_threads);
  const auto integrate = [&](int k) {
    const auto of_another_size = elastic_body<IncompressibleBody>(no_planes, 1 + k);  // other sizes of scratch arrays
    const auto other = run<Rattle>(of_another_size, pulsating(of_another_size), 0.1, 1, 5);
    const auto r = run<Rattle>(body, pulsating(body), 1, 1, 100);
    if (other.finished() && r.finished()) ends[k] = r.last().q;
  };
  std::vector<std::thread> threads;
  for (int k = 0; k < n_threads; ++k) threads.emplace_back(integrate, k);
  for (std::thread& thread : threads) thread.join();
  integrate(0);
  ASSERT_GT(ends[0].size(), 0);
  for (const VectorXd& q : ends) EXPECT_EQ(q, ends[0]);
}

}  // namespace
}  // namespace pseudorigid::testing
