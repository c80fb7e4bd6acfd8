/// Which build of the kernels runs.

#include "mechanics/core/kernel_builds.h"

#include <gtest/gtest.h>

namespace pseudorigid::testing {
namespace {

using mechanics::choose_build;
using Builds = std::vector<mechanics::KernelChoice>;

const Builds builds{{"x86-64-v4", false}, {"x86-64-v3", true}, {"x86-64-v2", true}};

std::string refusal(const Builds& of, std::string_view wanted) {
  try {
    choose_build(of, wanted);
  } catch (const mechanics::NoKernels& error) {
    return error.what();
  }
  return "none";
}

TEST(KernelBuilds, TheBestThatRunsHereIsTaken) { EXPECT_EQ(choose_build(builds, ""), 1u); }

TEST(KernelBuilds, TheOneThatIsWantedIsTaken) { EXPECT_EQ(choose_build(builds, "x86-64-v2"), 2u); }

TEST(KernelBuilds, WhatDoesNotRunHereIsRefused) {
  EXPECT_EQ(refusal(builds, "x86-64-v4"),
            "this processor does not have the instructions x86-64-v4 that PSEUDORIGID_INSTRUCTIONS asks for");
  EXPECT_EQ(refusal({{"x86-64-v4", false}}, ""),
            "this processor has none of the instructions that pseudorigid was built for (x86-64-v4)");
}

TEST(KernelBuilds, WhatIsNotBuiltIsRefusedWithWhatIs) {
  EXPECT_EQ(refusal(builds, "avx2"),
            "PSEUDORIGID_INSTRUCTIONS is \"avx2\"; pseudorigid was built for x86-64-v4, x86-64-v3, x86-64-v2");
}

}  // namespace
}  // namespace pseudorigid::testing
