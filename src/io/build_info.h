#pragma once
/// Version, compiler and flags of this executable, fixed when it was built. A separate library (pseudorigid_build_info)
/// contains these data, because the hash of the commit changes often. After a new commit, only this library is
/// compiled, and the executables are linked again.

#include <string_view>

namespace pseudorigid::io {

/// The texts come from CMake. `flags` are the flags of the compiler for this type of build.
struct BuildInfo {
  std::string_view version;
  std::string_view git_hash;  ///< "unknown" without a git checkout; ends in "-dirty" if the sources were changed
  std::string_view compiler, flags, build_type;
};
BuildInfo build_info();

}  // namespace pseudorigid::io
