#pragma once
/// The memory that this process can still allocate.

#include <filesystem>

namespace pseudorigid::io {

/// Free bytes of the machine (MemAvailable), or less if a control group limits this process. The limit may belong to
/// the group of the process or to a group above, and to version 1 or 2 of control groups. Containers, systemd and batch
/// systems make such groups. Files that the kernel keeps in memory and can drop do not count as used. The result is
/// infinite if the system does not state a number. `root` is the folder that contains proc and sys.
double available_memory(const std::filesystem::path& root = "/");

}  // namespace pseudorigid::io
