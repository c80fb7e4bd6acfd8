/// Counts of what ranks send one another.

#include "continuum/parallel/gather.h"

#include <gtest/gtest.h>

namespace pseudorigid::testing {
namespace {

TEST(Gather, CountsAreThoseOfMpi) {
  const continuum::Counts counts({3, 0, 4});
  EXPECT_EQ(counts.sizes, (std::vector{3, 0, 4}));
  EXPECT_EQ(counts.offsets, (std::vector{0, 3, 3, 7}));
}

TEST(Gather, MoreThanAnIntHoldsIsRefused) {
  constexpr long most = std::numeric_limits<int>::max();
  EXPECT_NO_THROW(continuum::Counts({most - 1, 1}));
  EXPECT_THROW(continuum::Counts({most, 1}), std::length_error);
  EXPECT_THROW(continuum::Counts({most + 1}), std::length_error);
}

}  // namespace
}  // namespace pseudorigid::testing
