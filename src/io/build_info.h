#pragma once
/// Sources of this executable, fixed when it was built. A library of its own (CMake target build_info): it
/// changes with every commit, and only the executables should be linked again for that.

#include <string_view>

namespace pseudorigid::io {

struct BuildInfo {
  std::string_view version;
  std::string_view git_hash;  ///< "unknown" outside a git checkout; ends in "-dirty" if the sources were changed
  std::string_view compiler, flags, build_type;
};
BuildInfo build_info();

}  // namespace pseudorigid::io
