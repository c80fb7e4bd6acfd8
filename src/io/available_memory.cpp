#include "io/available_memory.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

namespace pseudorigid::io {
namespace {

namespace fs = std::filesystem;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Names of the files with the limit and the use of memory of a control group. In a group without a limit, the file
/// `limit` of version 1 contains a number larger than any memory. The file of version 2 contains the word "max", and
/// left_in_group treats this word as an infinite limit.
struct Names {
  const char *limit, *used;
  /// Entries of memory.stat: the bytes of cached files that the kernel can remove, in the group and in all groups below
  /// it.
  const char *inactive, *active;
};
constexpr Names version_1{"memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file", "total_active_file"};
constexpr Names version_2{"memory.max", "memory.current", "inactive_file", "active_file"};

/// The number at the beginning of a file. If the file cannot be read or does not begin with a number, the result is
/// `otherwise`.
double number_in(const fs::path& path, double otherwise) {
  std::ifstream file(path);
  double number;
  return file >> number ? number : otherwise;
}

/// The number after the word `wanted` in a file. If the file does not contain this word with a number, the result is
/// `otherwise`.
double number_named(const fs::path& path, std::string_view wanted, double otherwise) {
  std::ifstream file(path);
  double number;
  for (std::string name; file >> name;)
    if (name == wanted && file >> number) return number;
  return otherwise;
}

/// The limit of a group minus the memory in use, in bytes, and at least 0. It is infinite if the file of the limit is
/// missing or does not begin with a number. Cached files that the kernel can remove do not count as used.
double left_in_group(const fs::path& group, const Names& names) {
  const double limit = number_in(group / names.limit, infinite), used = number_in(group / names.used, 0);
  const fs::path parts = group / "memory.stat";
  const double droppable = number_named(parts, names.inactive, 0) + number_named(parts, names.active, 0);
  return std::max(0.0, limit - std::max(0.0, used - droppable));
}

/// The least memory, in bytes, that is left in the group `path` below the folder `mount` and in the groups above it. A
/// group without a file for its limit counts as unlimited. Such groups occur in a container: `path` may name groups of
/// the machine, but `mount` may contain only the group of the container.
double left_in_groups(const fs::path& mount, const std::string& path, const Names& names) {
  double left = infinite;
  for (fs::path group = fs::path(path).lexically_normal();; group = group.parent_path()) {
    left = std::min(left, left_in_group(mount / group.relative_path(), names));
    if (!group.has_relative_path()) return left;
  }
}

}  // namespace

double available_memory(const fs::path& root) {
  constexpr double kilobyte = 1024;
  double available = kilobyte * number_named(root / "proc/meminfo", "MemAvailable:", infinite);
  const fs::path mounts = root / "sys/fs/cgroup";
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {  // a line has the form number:controllers:path
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == line.npos) continue;
    const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1)),
                      path = line.substr(second + 1);
    if (controllers == ",,")
      for (const fs::path& mount : {mounts, mounts / "unified"})
        available = std::min(available, left_in_groups(mount, path, version_2));
    else if (controllers.find(",memory,") != controllers.npos)
      available = std::min(available, left_in_groups(mounts / "memory", path, version_1));
  }
  return available;
}

double available_addresses() {
  constexpr double kilobyte = 1024;
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return infinite;
  return std::max(0., static_cast<double>(limit.rlim_cur) - kilobyte * number_named("/proc/self/status", "VmSize:", 0));
}

}  // namespace pseudorigid::io
