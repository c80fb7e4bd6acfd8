#pragma once
/// Version, compiler and flags of this executable, fixed when it was built. They are in a library of their own (CMake
/// target build_info), because the commit changes often. A new commit then only links the executables again.

#include <string_view>

namespace pseudorigid::io {

struct BuildInfo {
  std::string_view version;
  std::string_view git_hash;  ///< "unknown" without a git checkout; ends in "-dirty" if the sources were changed
  std::string_view compiler, flags, build_type;
};
BuildInfo build_info();

}  // namespace pseudorigid::io
