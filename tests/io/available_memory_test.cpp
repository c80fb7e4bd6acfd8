#include "io/available_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>

#include "scratch.h"

namespace pseudorigid::io::test {
namespace {

namespace fs = std::filesystem;

constexpr double machine = 8192.0 * 1024;

/// A folder with proc and sys as the system has them: a machine of 8 MiB, and the process in these groups.
class FakeSystem {
 public:
  explicit FakeSystem(const std::string& groups) {
    write("proc/meminfo", "MemTotal: 16384 kB\nMemAvailable: 8192 kB\n");
    write("proc/self/cgroup", groups);
  }
  void write(const std::string& name, const std::string& text) const {
    const fs::path path = scratch_ / name;
    fs::create_directories(path.parent_path());
    put(path, text);
  }
  double available() const { return available_memory(scratch_ / ""); }

 private:
  ScratchDirectory scratch_;
};

TEST(AvailableMemory, WithoutLimitIsThatOfTheMachine) {
  EXPECT_EQ(FakeSystem("").available(), machine);
  EXPECT_EQ(FakeSystem("0::/user\n").available(), machine);
}

TEST(AvailableMemory, OfVersion2IsTheLeastOfAGroupAndThoseAbove) {
  const FakeSystem system("0::/slice/job\n");
  system.write("sys/fs/cgroup/slice/job/memory.max", "max\n");
  system.write("sys/fs/cgroup/slice/job/memory.current", "1000000\n");
  system.write("sys/fs/cgroup/slice/memory.max", "3000000\n");
  system.write("sys/fs/cgroup/slice/memory.current", "1000000\n");
  EXPECT_EQ(system.available(), 2000000);
}

TEST(AvailableMemory, DoesNotCountFilesThatTheKernelCanDrop) {
  const FakeSystem system("0::/job\n");
  system.write("sys/fs/cgroup/job/memory.max", "3000000\n");
  system.write("sys/fs/cgroup/job/memory.current", "2900000\n");
  system.write("sys/fs/cgroup/job/memory.stat", "anon 400000\ninactive_file 2000000\nactive_file 500000\n");
  EXPECT_EQ(system.available(), 2600000);
}

TEST(AvailableMemory, ReadsVersion1) {
  const FakeSystem system("9:name=systemd:/\n4:cpu,memory:/batch/job\n");
  system.write("sys/fs/cgroup/memory/batch/job/memory.limit_in_bytes", "9223372036854771712\n");
  system.write("sys/fs/cgroup/memory/batch/memory.limit_in_bytes", "5000000\n");
  system.write("sys/fs/cgroup/memory/batch/memory.usage_in_bytes", "4500000\n");
  system.write("sys/fs/cgroup/memory/batch/memory.stat", "inactive_file 7\ntotal_inactive_file 1500000\n");
  EXPECT_EQ(system.available(), 2000000);
}

TEST(AvailableMemory, IsNeverNegative) {
  const FakeSystem system("0::/\n");
  system.write("sys/fs/cgroup/memory.max", "1000\n");
  system.write("sys/fs/cgroup/memory.current", "5000\n");
  EXPECT_EQ(system.available(), 0);
}

TEST(AvailableAddresses, AreTheLimitLessTheUsed) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  if (before.rlim_cur != RLIM_INFINITY) {  // of the shell; the test cannot raise it
    EXPECT_LT(available_addresses(), double(before.rlim_cur));
    return;
  }
  EXPECT_TRUE(std::isinf(available_addresses()));
  const auto left_below = [&](rlim_t bytes) {
    const rlimit limit{bytes, before.rlim_max};
    EXPECT_EQ(::setrlimit(RLIMIT_AS, &limit), 0);
    const double left = available_addresses();
    EXPECT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
    return left;
  };
  constexpr rlim_t limit = rlim_t{1} << 46;  // above the addresses that a sanitizer reserves
  const double left = left_below(limit);
  EXPECT_GT(left, 0);
  EXPECT_LT(left, double(limit));
  EXPECT_NEAR(left_below(2 * limit) - left, double(limit), 1e7);
}

}  // namespace
}  // namespace pseudorigid::io::test
