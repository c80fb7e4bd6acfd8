#pragma once
/// The memory and the addresses that this process can still allocate.

#include <filesystem>

namespace pseudorigid::io {

/// The bytes that are free on the machine (MemAvailable), or less if a control group limits this process. Containers,
/// systemd and batch systems create control groups. The limit may belong to the group of the process or to a group
/// above it, in version 1 or 2 of control groups. Files that the kernel keeps in memory and can drop do not count as
/// used. The result is infinite if the system reports neither the free memory nor a limit. `root` is the folder with
/// proc and sys; only tests pass another folder.
double available_memory(const std::filesystem::path& root = "/");

/// The bytes of address space that this process can still map: its limit (ulimit -v) less the addresses in use, and at
/// least 0. The result is infinite if there is no limit or if the limit cannot be read.
double available_addresses();

}  // namespace pseudorigid::io
