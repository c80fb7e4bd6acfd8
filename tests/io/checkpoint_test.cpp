#include "io/checkpoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "io/files.h"
#include "largest_allocation.h"
#include "scene/user_error.h"
#include "scratch.h"
#include "support/mutants.h"

namespace pseudorigid::io::test {
namespace {

using pseudorigid::testing::damaged_bytes;

constexpr std::size_t header_size = 32;

Checkpoint sample() {
  Checkpoint checkpoint;
  std::vector<double> state(60);
  for (std::size_t i = 0; i < state.size(); ++i) state[i] = std::sin(1. + i);
  checkpoint.set("state", state);
  checkpoint.set("empty", std::vector<double>{});
  checkpoint.set("special", std::vector<double>{-0., std::numeric_limits<double>::denorm_min(), NAN, -INFINITY});
  checkpoint.set("time", 0.1);
  checkpoint.set("n_steps", 123456789012345);
  checkpoint.set("n_rows", std::size_t{17});
  checkpoint.set("minus", -1);
  checkpoint.set("scene", "Body/Radius = 1\nBody/Density = 2\n");
  checkpoint.set("", std::string());
  return checkpoint;
}

std::string sample_bytes(const ScratchDirectory& scratch) {
  sample().save(scratch / "good.bin");
  return contents(scratch / "good.bin");
}

/// Makes size and checksum of the header agree with the payload, so that a mutant reaches the parser.
std::string forged(std::string bytes) {
  const std::uint64_t size = bytes.size() - header_size, sum = checksum(std::string_view(bytes).substr(header_size));
  std::memcpy(bytes.data() + 16, &size, 8);
  std::memcpy(bytes.data() + 24, &sum, 8);
  return bytes;
}

TEST(Checkpoint, GivesBackWhatWasSet) {
  const ScratchDirectory scratch;
  sample().save(scratch / "c.bin");
  const Checkpoint loaded = Checkpoint::load(scratch / "c.bin");
  EXPECT_EQ(loaded.get_doubles("state").size(), 60u);
  EXPECT_EQ(loaded.get_doubles("state", 60)[3], std::sin(4.));
  EXPECT_TRUE(loaded.get_doubles("empty").empty());
  EXPECT_EQ(loaded.get_double("time"), 0.1);
  EXPECT_EQ(loaded.get_integer("n_steps"), 123456789012345);
  EXPECT_EQ(loaded.get_integer("n_rows"), 17);
  EXPECT_EQ(loaded.get_integer("minus"), -1);
  EXPECT_EQ(loaded.get_string("scene"), "Body/Radius = 1\nBody/Density = 2\n");
  EXPECT_TRUE(loaded.has(""));
  const auto& special = loaded.get_doubles("special", 4);
  EXPECT_TRUE(std::signbit(special[0]) && special[0] == 0);
  EXPECT_EQ(special[1], std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(std::isnan(special[2]) && std::isinf(special[3]));
}

TEST(Checkpoint, SavingTwiceGivesTheSameBytes) {
  const ScratchDirectory scratch;
  sample().save(scratch / "a.bin");
  Checkpoint::load(scratch / "a.bin").save(scratch / "b.bin");
  EXPECT_EQ(contents(scratch / "a.bin"), contents(scratch / "b.bin"));
}

TEST(Checkpoint, WrongEntriesAreNamed) {
  const ScratchDirectory scratch;
  sample().save(scratch / "c.bin");
  const Checkpoint loaded = Checkpoint::load(scratch / "c.bin");
  const auto complaint = [&](auto&& action) { return message_of<UserError>(action); };
  EXPECT_NE(complaint([&] { loaded.get_integer("nothing"); }).find("c.bin' cannot be used: it has no entry 'nothing'"),
            std::string::npos);
  EXPECT_NE(complaint([&] { loaded.get_integer("state"); }).find("'state' is not an integer"), std::string::npos);
  EXPECT_NE(complaint([&] { loaded.get_doubles("state", 9); }).find("has 60 numbers, expected 9"), std::string::npos);
  EXPECT_THROW(loaded.get_string("time"), UserError);
}

TEST(Checkpoint, ForeignFilesAreRefusedWithASentence) {
  const ScratchDirectory scratch;
  const std::string good = sample_bytes(scratch);
  const auto complaint = [&](const std::string& bytes) {
    put(scratch / "c.bin", bytes);
    return message_of<UserError>([&] { Checkpoint::load(scratch / "c.bin"); });
  };
  std::string swapped = good, newer = good;
  std::reverse(swapped.begin() + 8, swapped.begin() + 12);
  newer[12] = 2;
  EXPECT_NE(complaint("").find("too short"), std::string::npos);
  EXPECT_NE(complaint(std::string(1000, 'x')).find("another kind of file"), std::string::npos);
  EXPECT_NE(complaint(swapped).find("another byte order"), std::string::npos);
  EXPECT_NE(complaint(newer).find("format version 2, this program reads 1"), std::string::npos);
  EXPECT_NE(complaint(good.substr(0, good.size() - 1)).find("incomplete"), std::string::npos);
  EXPECT_NE(complaint(good + "x").find("extended"), std::string::npos);
  std::string damaged = good;
  damaged[good.size() / 2] ^= 1;
  EXPECT_NE(complaint(damaged).find("damaged"), std::string::npos);
  EXPECT_EQ(complaint(good), "");
  EXPECT_THROW(Checkpoint::load(scratch / "none.bin"), UserError);
  EXPECT_THROW(Checkpoint::load(scratch.path()), UserError);
  EXPECT_THROW(Checkpoint::load("/dev/zero"), UserError);
}

TEST(Checkpoint, EveryMutantIsAUserError) {
  const ScratchDirectory scratch;
  const std::string good = sample_bytes(scratch);
  std::mt19937_64 random(2);
  for (int i = 0; i < 5000; ++i) {
    const std::string bytes = damaged_bytes(good, 0, random);
    if (bytes == good) continue;
    put(scratch / "mutant.bin", bytes);
    ASSERT_THROW(Checkpoint::load(scratch / "mutant.bin"), UserError) << "mutant " << i;
  }
}

TEST(Checkpoint, EveryTruncationAndEveryFlippedBitIsAUserError) {
  const ScratchDirectory scratch;
  const std::string good = sample_bytes(scratch);
  for (std::size_t n = 0; n < good.size(); ++n) {
    put(scratch / "mutant.bin", good.substr(0, n));
    ASSERT_THROW(Checkpoint::load(scratch / "mutant.bin"), UserError) << "length " << n;
    std::string flipped = good;
    flipped[n] ^= static_cast<char>(1 << n % 8);
    put(scratch / "mutant.bin", flipped);
    ASSERT_THROW(Checkpoint::load(scratch / "mutant.bin"), UserError) << "byte " << n;
  }
}

TEST(Checkpoint, AForgedChecksumNeitherCrashesNorAllocates) {
  const ScratchDirectory scratch;
  const std::string good = sample_bytes(scratch);
  std::mt19937_64 random(3);
  int n_refused = 0;
  for (int i = 0; i < 5000; ++i) {
    put(scratch / "mutant.bin", forged(damaged_bytes(good, header_size, random)));
    largest_allocation = 0;
    try {
      Checkpoint::load(scratch / "mutant.bin");
    } catch (const UserError&) {
      ++n_refused;
    }
    ASSERT_LT(largest_allocation, 100000u) << "mutant " << i;
  }
  EXPECT_GT(n_refused, 1000);
}

TEST(Checkpoint, AFullDiskLeavesTheOldCheckpoint) {
  const ScratchDirectory scratch;
  const auto path = scratch / "c.bin";
  sample().save(path);
  const std::string before = contents(path);
  Checkpoint larger = sample();
  larger.set("more", std::vector<double>(100));
  {
    const FileSizeLimit full(before.size());
    EXPECT_THROW(larger.save(path), WriteError);
  }
  EXPECT_EQ(contents(path), before);
  EXPECT_FALSE(std::filesystem::exists(scratch / "c.bin.partial"));
  larger.save(path);
  EXPECT_EQ(Checkpoint::load(path).get_doubles("more").size(), 100u);
}

}  // namespace
}  // namespace pseudorigid::io::test
