#pragma once
/// Version, compiler and flags with which this executable was built. A separate library (pseudorigid_build_info)
/// contains these data, because the hash of the commit changes often. After a new commit, only this library is compiled
/// again, and the executables are linked again.

#include <string_view>

namespace pseudorigid::io {

/// Texts from CMake. `compiler` is its name and version, and `flags` are its flags for the build type.
struct BuildInfo {
  std::string_view version;
  /// The hash of the commit, or "unknown" without a git checkout. The hash ends in "-dirty" if the sources or the files
  /// of CMake had uncommitted changes at build time.
  std::string_view git_hash;
  std::string_view compiler, flags, build_type;
};
BuildInfo build_info();

}  // namespace pseudorigid::io
