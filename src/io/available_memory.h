#pragma once
/// The memory and the address space that this process can still allocate.

#include <filesystem>

namespace pseudorigid::io {

/// The memory in bytes that is available on the machine (MemAvailable), or less if a control group limits this process.
/// Containers, systemd and batch systems create control groups. The limit may belong to the group of the process or to
/// a group above it, in version 1 or 2 of control groups. Cached files that the kernel can remove from memory do not
/// count as used. The result is infinite if the system reports neither the available memory nor a limit. `root` is the
/// folder with proc and sys; only tests pass a folder other than "/".
double available_memory(const std::filesystem::path& root = "/");

/// The address space in bytes that this process can still map: its limit (ulimit -v) minus the size in use, and at
/// least 0. The result is infinite if there is no limit or if the limit cannot be read.
double available_addresses();

}  // namespace pseudorigid::io
