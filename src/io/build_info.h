#pragma once
/// Version, compiler and flags with which this executable was built. A separate library (pseudorigid_build_info)
/// contains these data, because the hash of the commit changes often. After a new commit, only this library is compiled
/// again, and the executables are linked again.

#include <string_view>

namespace pseudorigid::io {

/// Texts from CMake. `flags` contains the flags of the compiler for the build type.
struct BuildInfo {
  std::string_view version;
  std::string_view git_hash;  ///< "unknown" without a git checkout; ends in "-dirty" if there were uncommitted changes
  std::string_view compiler, flags, build_type;
};
BuildInfo build_info();

}  // namespace pseudorigid::io
