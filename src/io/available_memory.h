#pragma once
/// How much memory this process can still have.

#include <filesystem>

namespace pseudorigid::io {

/// Free bytes of the machine (MemAvailable), or less if a control group that contains this process has a limit: its own
/// or one above it, as containers, systemd and batch systems make them (versions 1 and 2). Files that the kernel keeps
/// in memory and can drop do not count as used. Infinite if the system does not tell. `root`: the folder that has proc
/// and sys.
double available_memory(const std::filesystem::path& root = "/");

}  // namespace pseudorigid::io
